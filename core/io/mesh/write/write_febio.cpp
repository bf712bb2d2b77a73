#include "io/mesh/write/write_febio.h"

#include <string>

#include "io/bytes/byte_writer.h"
#include "io/mesh/shared/element_nodes.h"
#include "io/mesh/shared/mesh_groups.h"

namespace voxtet {
namespace {

/// The tetrahedra of one label.
struct Part {
  std::string name;
  std::vector<std::uint32_t> tets;
};

std::vector<Part> parts_of(const TetMesh& mesh, const std::vector<LabelInfo>& infos) {
  const LabelGroups groups = group_tets(mesh.labels);
  auto members = group_members(groups.of_tet, groups.labels.size());
  std::vector<Part> parts;
  for (std::size_t i = 0; i < members.size(); ++i)
    parts.push_back({word_name(groups.labels[i], infos), std::move(members[i])});
  return parts;
}

constexpr const char* kSoftTissue =
    "type=\"neo-Hookean\">\n<density>1.06e-6</density>\n<E>10</E>\n<v>0.45</v>\n";

/// The vector of a tetrahedron.
Eigen::Vector3f vector_of(const Field& field, std::uint32_t tet) {
  return Eigen::Map<const Eigen::Vector3f>(field.values.data() + 3 * std::size_t{tet});
}

bool has_fibres(const Part& part, const FebioAnalysis* analysis) {
  return analysis && !vector_of(*analysis->fibre, part.tets.front()).isZero(0);
}

void write_head(ByteWriter& out, const std::vector<Part>& parts, PatientSpace space,
                const FebioAnalysis* analysis) {
  out.text("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<febio_spec version=\"4.0\">\n<!-- voxtet mesh, " +
           coordinates_note(space) + " -->\n<Module type=\"solid\">\n<units>mm-kg-s</units>\n</Module>\n");
  if (analysis) out.text(analysis->control);
  out.text(
      "<Material>\n"
      "<!-- values to begin with, not measured: stiffness in kPa, density in kg/mm^3 -->\n");
  for (std::size_t i = 0; i < parts.size(); ++i) {
    out.text("<material id=\"" + std::to_string(i + 1) + "\" name=\"" + parts[i].name + "\" ");
    if (!analysis)
      out.text(kSoftTissue);
    else
      out.text(has_fibres(parts[i], analysis) ? analysis->muscle : analysis->passive);
    out.text("</material>\n");
  }
  out.text("</Material>\n");
}

/// <tag id="7">1,2,3</tag> with one more than each node.
void write_cell(ByteWriter& out, const std::string& tag, std::size_t id, const ElementNodes& nodes) {
  out.text("<");
  out.text(tag);
  out.text(" id=\"");
  out.integer(static_cast<std::int64_t>(id));
  const char* separator = "\">";
  for (const std::uint32_t node : nodes) {
    out.text(separator);
    out.integer(std::int64_t{node} + 1);
    separator = ",";
  }
  out.text("</");
  out.text(tag);
  out.text(">\n");
}

void write_febio_nodes(ByteWriter& out, const TetMesh& mesh, PatientSpace space) {
  out.text("<Nodes name=\"nodes\">\n");
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    out.text("<node id=\"");
    out.integer(static_cast<std::int64_t>(p + 1));
    const Eigen::Vector3d point = in_space(mesh.points[p], space);
    for (int d = 0; d < 3; ++d) {
      out.text(d == 0 ? "\">" : ",");
      out.real(point[d]);
    }
    out.text("</node>\n");
  }
  out.text("</Nodes>\n");
}

void write_surface(ByteWriter& out, const TetMesh& mesh, const std::string& name,
                   const std::vector<std::uint32_t>& faces, const WriteMeshOptions& options) {
  const std::string tag = "tri" + std::to_string(nodes_per_face(options));
  out.text("<Surface name=\"" + name + "\">\n");
  for (std::size_t f = 0; f < faces.size(); ++f)
    write_cell(out, tag, f + 1, nodes_of_face(mesh.faces, faces[f], mesh.points.size(), options));
  out.text("</Surface>\n");
}

void write_surfaces(ByteWriter& out, const TetMesh& mesh, const WriteMeshOptions& options) {
  const FaceGroups groups = group_faces(mesh.face_sides);
  const auto members = group_members(groups.of_face, groups.pairs.size());
  for (std::size_t i = 0; i < members.size(); ++i)
    write_surface(out, mesh, word_name(groups.pairs[i], options.infos), members[i], options);
  for (const NamedSet& set : options.surfaces) write_surface(out, mesh, set.name, set.members, options);
}

void write_cell_data(ByteWriter& out, const std::vector<Part>& parts, const Field& data) {
  for (const Part& part : parts) {
    out.text("<ElementData name=\"" + data.name + "\" elem_set=\"" + part.name + "\">\n");
    for (std::size_t i = 0; i < part.tets.size(); ++i) {
      out.text("<e lid=\"");
      out.integer(static_cast<std::int64_t>(i + 1));
      out.text("\">");
      out.real(data.values[part.tets[i]]);
      out.text("</e>\n");
    }
    out.text("</ElementData>\n");
  }
}

void write_vector(ByteWriter& out, const char* tag, const Field& field, std::uint32_t tet,
                  PatientSpace space) {
  const Eigen::Vector3d v = in_space(vector_of(field, tet).cast<double>().normalized(), space);
  out.text(tag);
  for (int d = 0; d < 3; ++d) {
    out.text(d == 0 ? "" : ",");
    out.real(v[d]);
  }
}

void write_axes(ByteWriter& out, const Part& part, const FebioAnalysis& analysis, PatientSpace space) {
  out.text("<ElementData type=\"mat_axis\" name=\"axes_" + part.name + "\" elem_set=\"" + part.name +
           "\">\n");
  for (std::size_t i = 0; i < part.tets.size(); ++i) {
    out.text("<elem lid=\"");
    out.integer(static_cast<std::int64_t>(i + 1));
    write_vector(out, "\"><a>", *analysis.fibre, part.tets[i], space);
    write_vector(out, "</a><d>", *analysis.sheet, part.tets[i], space);
    out.text("</d></elem>\n");
  }
  out.text("</ElementData>\n");
}

void write_mesh_data(ByteWriter& out, const std::vector<Part>& parts, const WriteMeshOptions& options,
                     const FebioAnalysis* analysis) {
  out.text("<MeshData>\n");
  if (analysis) {
    for (const Part& part : parts)
      if (has_fibres(part, analysis)) write_axes(out, part, *analysis, options.space);
  } else {
    for (const Field& data : options.cell_data) write_cell_data(out, parts, data);
  }
  out.text("</MeshData>\n");
}

Bytes write_all(const TetMesh& mesh, const WriteMeshOptions& options, const FebioAnalysis* analysis) {
  const std::vector<Part> parts = parts_of(mesh, options.infos);
  ByteWriter out(88 * mesh.points.size() + (54 + 40 * options.cell_data.size()) * mesh.tets.size() +
                 92 * mesh.faces.size() + 4096);
  write_head(out, parts, options.space, analysis);
  out.text("<Mesh>\n");
  write_febio_nodes(out, mesh, options.space);
  for (const Part& part : parts) {
    out.text("<Elements type=\"tet" + std::to_string(nodes_per_tet(options)) + "\" name=\"" + part.name +
             "\">\n");
    for (const std::uint32_t tet : part.tets)
      write_cell(out, "elem", std::size_t{tet} + 1, nodes_of_tet(mesh, tet, options));
    out.text("</Elements>\n");
  }
  write_surfaces(out, mesh, options);
  out.text("</Mesh>\n<MeshDomains>\n");
  for (const Part& part : parts)
    out.text("<SolidDomain name=\"" + part.name + "\" mat=\"" + part.name + "\"" +
             (analysis ? " " + analysis->domain : "") + "/>\n");
  out.text("</MeshDomains>\n");
  if (analysis || !options.cell_data.empty()) write_mesh_data(out, parts, options, analysis);
  if (analysis) out.text(analysis->end);
  out.text("</febio_spec>\n");
  return out.take();
}

}  // namespace

Bytes write_febio(const TetMesh& mesh, const WriteMeshOptions& options) {
  return write_all(mesh, options, nullptr);
}

Bytes write_febio(const TetMesh& mesh, const WriteMeshOptions& options, const FebioAnalysis& analysis) {
  return write_all(mesh, options, &analysis);
}

}  // namespace voxtet
