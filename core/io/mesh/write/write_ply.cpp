#include "io/mesh/write/write_ply.h"

#include <algorithm>
#include <string>

#include "io/bytes/byte_writer.h"
#include "io/mesh/shared/mesh_groups.h"

namespace voxtet {
namespace {

std::string label_comments(const SurfaceMesh& surface, const std::vector<LabelInfo>& infos) {
  std::vector<Label> labels;
  for (const Sides& pair : group_faces(surface.sides).pairs)
    for (const Label label : pair)
      if (label != kBackground) labels.push_back(label);
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  const std::vector<std::string> names = group_names(labels, infos);
  std::string text;
  for (std::size_t i = 0; i < labels.size(); ++i)
    text += "comment label " + std::to_string(labels[i]) + " " + names[i] + "\n";
  return text;
}

}  // namespace

Bytes write_ply(const SurfaceMesh& surface, const WriteMeshOptions& options) {
  const std::string header =
      std::string("ply\nformat binary_little_endian 1.0\ncomment space ") + to_string(options.space) +
      "\ncomment unit mm\n" + label_comments(surface, options.infos) + "element vertex " +
      std::to_string(surface.points.size()) +
      "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
      std::to_string(surface.triangles.size()) +
      "\nproperty list uchar int vertex_indices\nproperty ushort label_behind\nproperty ushort label_front\n"
      "end_header\n";
  ByteWriter out(header.size() + 24 * surface.points.size() + 17 * surface.triangles.size());
  out.text(header);
  for (const Eigen::Vector3d& ras : surface.points) {
    const Eigen::Vector3d p = in_space(ras, options.space);
    for (int d = 0; d < 3; ++d) out.raw(p[d]);
  }
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    out.raw(std::uint8_t{3});
    for (const std::uint32_t corner : surface.triangles[t]) out.raw(static_cast<std::int32_t>(corner));
    for (const Label side : surface.sides[t]) out.raw(side);
  }
  return out.take();
}

}  // namespace voxtet
