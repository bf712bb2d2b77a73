#include "io/mesh/write/write_carp.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "io/bytes/byte_writer.h"
#include "io/mesh/shared/mesh_groups.h"

namespace voxtet {
namespace {

Bytes write_points(const TetMesh& mesh, PatientSpace space) {
  ByteWriter out(64 * mesh.points.size() + 64);
  out.text(std::to_string(mesh.points.size()) + "\n");
  for (const Eigen::Vector3d& ras : mesh.points) {
    const Eigen::Vector3d p = kUmPerMm * in_space(ras, space);
    for (int d = 0; d < 3; ++d) {
      out.real(p[d]);
      out.text(d < 2 ? " " : "\n");
    }
  }
  return out.take();
}

Bytes write_elements(const TetMesh& mesh) {
  ByteWriter out(40 * mesh.tets.size() + 64);
  out.text(std::to_string(mesh.tets.size()) + "\n");
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    out.text("Tt ");
    for (const std::uint32_t corner : mesh.tets[t]) {
      out.integer(corner);
      out.text(" ");
    }
    out.integer(mesh.labels[t]);
    out.text("\n");
  }
  return out.take();
}

/// One or two directions an element. Elements without any have zeros: openCARP takes them for passive ones,
/// outside of the muscle.
Bytes write_fibres(const std::vector<const Field*>& fields, PatientSpace space) {
  std::vector<std::vector<float>> directions;
  directions.reserve(fields.size());
  for (const Field* field : fields) directions.push_back(in_space(*field, space));
  const std::size_t tets = directions[0].size() / 3;
  ByteWriter out(40 * directions.size() * tets + 64);
  out.text(std::to_string(directions.size()) + "\n");
  for (std::size_t t = 0; t < tets; ++t) {
    const char* separator = "";
    for (const std::vector<float>& direction : directions)
      for (std::size_t d = 0; d < 3; ++d) {
        out.text(separator);
        out.real(direction[3 * t + d]);
        separator = " ";
      }
    out.text("\n");
  }
  return out.take();
}

Bytes write_note() {
  ByteWriter out(kNoFibres.size() + 1);
  out.text(kNoFibres);
  out.text("\n");
  return out.take();
}

/// A line for each element. NaN, which is no number to openCARP, is -1 there: not activated.
Bytes write_values(const Field& data, PatientSpace space) {
  const std::vector<float> values = in_space(data, space);
  const auto components = static_cast<std::size_t>(data.components);
  ByteWriter out(12 * values.size() + 64);
  for (std::size_t i = 0; i < values.size(); ++i) {
    out.real(std::isnan(values[i]) ? -1 : values[i]);
    out.text((i + 1) % components == 0 ? "\n" : " ");
  }
  return out.take();
}

Bytes write_triangles(const TetMesh& mesh, const NamedSet& set) {
  ByteWriter out(32 * set.members.size() + 64);
  out.text(std::to_string(set.members.size()) + "\n");
  for (const std::uint32_t face : set.members) {
    out.text("Tr");
    for (const std::uint32_t corner : mesh.faces[face]) {
      out.text(" ");
      out.integer(corner);
    }
    out.text("\n");
  }
  return out.take();
}

/// "extra": the points are numbered as in the whole mesh.
Bytes write_vertices(const TetMesh& mesh, const NamedSet& set) {
  std::vector<std::uint32_t> points;
  for (const std::uint32_t face : set.members)
    points.insert(points.end(), mesh.faces[face].begin(), mesh.faces[face].end());
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  ByteWriter out(12 * points.size() + 64);
  out.text(std::to_string(points.size()) + "\nextra\n");
  for (const std::uint32_t point : points) {
    out.integer(point);
    out.text("\n");
  }
  return out.take();
}

/// The fields of directions for .lon; none without fibres.
std::vector<const Field*> directions_of(const std::vector<Field>& cell_data) {
  std::vector<const Field*> directions;
  if (!has_fibres(cell_data)) return directions;
  for (const std::string_view name : {kFibreField, kSheetField})
    if (const Field* found = find_field(cell_data, name); found && found->components == 3)
      directions.push_back(found);
  return directions;
}

}  // namespace

std::vector<OutputFile> write_carp(const TetMesh& mesh, const WriteMeshOptions& options) {
  std::vector<OutputFile> files{{".pts", write_points(mesh, options.space)}, {".elem", write_elements(mesh)}};
  const std::vector<const Field*> directions = directions_of(options.cell_data);
  if (directions.empty())
    files.push_back({".lon.txt", write_note()});
  else
    files.push_back({".lon", write_fibres(directions, options.space)});
  for (const auto* fields : {&options.cell_data, &options.point_data})
    for (const Field& data : *fields)
      if (std::find(directions.begin(), directions.end(), &data) == directions.end())
        files.push_back({"." + data.name + ".dat", write_values(data, options.space)});
  for (const NamedSet& set : options.surfaces) {
    files.push_back({"." + set.name + ".surf", write_triangles(mesh, set)});
    files.push_back({"." + set.name + ".surf.vtx", write_vertices(mesh, set)});
  }
  return files;
}

}  // namespace voxtet
