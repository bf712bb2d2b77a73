#include "io/mesh/write/write_carp.h"

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

Bytes write_note() {
  ByteWriter out(kNoFibres.size() + 1);
  out.text(kNoFibres);
  out.text("\n");
  return out.take();
}

/// NaN, which is no number to openCARP, is -1 there: not activated.
Bytes write_values(const std::vector<float>& values) {
  ByteWriter out(12 * values.size() + 64);
  for (const float value : values) {
    out.real(std::isnan(value) ? -1 : value);
    out.text("\n");
  }
  return out.take();
}

}  // namespace

std::vector<OutputFile> write_carp(const TetMesh& mesh, const WriteMeshOptions& options) {
  std::vector<OutputFile> files{{".pts", write_points(mesh, options.space)},
                                {".elem", write_elements(mesh)},
                                {".lon.txt", write_note()}};
  for (const auto* fields : {&options.cell_data, &options.point_data})
    for (const Field& data : *fields) files.push_back({"." + data.name + ".dat", write_values(data.values)});
  return files;
}

}  // namespace voxtet
