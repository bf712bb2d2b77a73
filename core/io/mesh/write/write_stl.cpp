#include "io/mesh/write/write_stl.h"

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <string>
#include <utility>

#include "io/bytes/byte_writer.h"
#include "io/mesh/shared/mesh_groups.h"

namespace voxtet {

Bytes write_stl(const SurfaceMesh& surface, const WriteMeshOptions& options) {
  ByteWriter out(84 + 50 * surface.triangles.size());
  // A header that began with "solid" would be taken for ASCII.
  std::string header = std::string("binary STL by voxtet, space ") + to_string(options.space) + ", unit mm";
  header.resize(80, ' ');
  out.text(header);
  out.raw(static_cast<std::uint32_t>(surface.triangles.size()));
  for (const Triangle& triangle : surface.triangles) {
    std::array<Eigen::Vector3d, 3> p;
    for (std::size_t c = 0; c < 3; ++c) p[c] = in_space(surface.points[triangle[c]], options.space);
    const Eigen::Vector3d cross = (p[1] - p[0]).cross(p[2] - p[0]);
    const double length = cross.norm();
    const Eigen::Vector3d normal = length > 0 ? Eigen::Vector3d(cross / length) : Eigen::Vector3d::Zero();
    for (int d = 0; d < 3; ++d) out.raw(static_cast<float>(normal[d]));
    for (const Eigen::Vector3d& corner : p)
      for (int d = 0; d < 3; ++d) out.raw(static_cast<float>(corner[d]));
    out.raw(std::uint16_t{0});
  }
  return out.take();
}

std::vector<OutputFile> write_label_stls(const SurfaceMesh& surface, const WriteMeshOptions& options) {
  std::map<Label, std::vector<Triangle>> outward;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    const auto& [behind, front] = surface.sides[t];
    if (behind != kBackground) outward[behind].push_back({a, b, c});
    if (front != kBackground) outward[front].push_back({a, c, b});
  }
  std::vector<OutputFile> files;
  for (auto& [label, triangles] : outward)
    files.push_back({"." + word_name(label, options.infos) + ".stl",
                     write_stl({surface.points, std::move(triangles), {}}, options)});
  return files;
}

}  // namespace voxtet
