#include "io/mesh/write/text/write_msh22.h"

#include <algorithm>
#include <string>
#include <utility>

#include "io/bytes/byte_writer.h"
#include "io/mesh/shared/element_nodes.h"
#include "io/mesh/shared/facet_tags.h"
#include "io/mesh/shared/mesh_groups.h"
#include "io/mesh/write/text/numbered_points.h"

namespace voxtet {
namespace {

constexpr const char* kMsh22Format = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";

void write_msh22_names(ByteWriter& out, const TetMesh& mesh, const FacetTags& facets,
                       const std::vector<LabelInfo>& infos) {
  const std::vector<Label> labels = group_tets(mesh.labels).labels;
  const std::vector<std::string> names = group_names(labels, infos);
  out.text("$PhysicalNames\n" + std::to_string(facets.names.size() + labels.size()) + "\n");
  for (std::size_t i = 0; i < facets.names.size(); ++i)
    out.text("2 " + std::to_string(i + 1) + " \"" + facets.names[i] + "\"\n");
  for (std::size_t i = 0; i < labels.size(); ++i)
    out.text("3 " + std::to_string(labels[i]) + " \"" + names[i] + "\"\n");
  out.text("$EndPhysicalNames\n");
}

void write_msh22_nodes(ByteWriter& out, const TetMesh& mesh, PatientSpace space) {
  out.text("$Nodes\n" + std::to_string(mesh.points.size()) + "\n");
  write_numbered_points(out, mesh.points, space);
  out.text("$EndNodes\n");
}

/// Number, type, two tags, and one more than each node.
void write_msh22_element(ByteWriter& out, std::size_t number, const char* type, std::int64_t group,
                         std::int64_t entity, const ElementNodes& nodes) {
  out.integer(static_cast<std::int64_t>(number));
  out.text(type);
  out.integer(group);
  out.text(" ");
  out.integer(entity);
  for (const std::uint32_t node : nodes) {
    out.text(" ");
    out.integer(std::int64_t{node} + 1);
  }
  out.text("\n");
}

/// The rank, from 1, of each face's sides and tag among all that differ.
std::vector<std::int64_t> elementary_tags(const TetMesh& mesh, const FacetTags& facets) {
  std::vector<std::pair<Sides, std::int32_t>> of_face, distinct;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    of_face.emplace_back(mesh.face_sides[f], facets.of_face[f]);
  distinct = of_face;
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  std::vector<std::int64_t> tags;
  for (const auto& one : of_face)
    tags.push_back(1 + (std::lower_bound(distinct.begin(), distinct.end(), one) - distinct.begin()));
  return tags;
}

void write_msh22_elements(ByteWriter& out, const TetMesh& mesh, const FacetTags& facets,
                          const WriteMeshOptions& options) {
  const char* tetrahedron = options.midside ? " 11 2 " : " 4 2 ";
  const char* triangle = options.midside ? " 9 2 " : " 2 2 ";
  const std::vector<std::int64_t> entities = elementary_tags(mesh, facets);
  out.text("$Elements\n" + std::to_string(mesh.tets.size() + mesh.faces.size()) + "\n");
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    write_msh22_element(out, t + 1, tetrahedron, mesh.labels[t], mesh.labels[t],
                        gmsh_nodes_of_tet(mesh, t, options));
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    write_msh22_element(out, mesh.tets.size() + f + 1, triangle, facets.of_face[f], entities[f],
                        nodes_of_face(mesh.faces, f, mesh.points.size(), options));
  out.text("$EndElements\n");
}

Bytes write_msh22_data(const std::vector<Field>& cell_data, std::size_t tets, PatientSpace space) {
  ByteWriter out(cell_data.size() * (24 * tets + 128) + 64);
  out.text(kMsh22Format);
  for (const Field& data : cell_data) {
    const auto components = static_cast<std::size_t>(data.components);
    out.text("$ElementData\n1\n\"" + data.name + "\"\n1\n0\n3\n0\n" + std::to_string(components) + "\n" +
             std::to_string(tets) + "\n");
    const std::vector<float> values = in_space(data, space);
    for (std::size_t t = 0; t < tets; ++t) {
      out.integer(static_cast<std::int64_t>(t + 1));
      for (std::size_t c = 0; c < components; ++c) {
        out.text(" ");
        out.real(values[components * t + c]);
      }
      out.text("\n");
    }
    out.text("$EndElementData\n");
  }
  return out.take();
}

}  // namespace

std::vector<OutputFile> write_msh22(const TetMesh& mesh, const WriteMeshOptions& options) {
  const FacetTags facets = facet_tags(mesh, options);
  ByteWriter out(72 * mesh.points.size() + 44 * mesh.tets.size() + 40 * mesh.faces.size() + 4096);
  out.text(kMsh22Format);
  out.text(std::string("$Comments\nspace ") + to_string(options.space) + "\nunit mm\n$EndComments\n");
  write_msh22_names(out, mesh, facets, options.infos);
  write_msh22_nodes(out, mesh, options.space);
  write_msh22_elements(out, mesh, facets, options);
  std::vector<OutputFile> files{{".msh", out.take()}};
  if (!options.cell_data.empty())
    files.push_back({"_data.msh", write_msh22_data(options.cell_data, mesh.tets.size(), options.space)});
  return files;
}

}  // namespace voxtet
