#include "geometry/topology/unused_points.h"

#include <cstdint>
#include <vector>

namespace voxtet {
namespace {

template <class Elements>
std::size_t drop_points(std::vector<Eigen::Vector3d>& points, Elements& elements) {
  constexpr std::uint32_t kUnused = 0xffffffffU;
  std::vector<std::uint32_t> place(points.size(), kUnused);
  for (const auto& element : elements)
    for (const std::uint32_t p : element) place[p] = 0;
  std::uint32_t used = 0;
  for (std::size_t p = 0; p < place.size(); ++p) {
    if (place[p] == kUnused) continue;
    points[used] = points[p];
    place[p] = used++;
  }
  const std::size_t dropped = points.size() - used;
  points.resize(used);
  for (auto& element : elements)
    for (std::uint32_t& p : element) p = place[p];
  return dropped;
}

}  // namespace

void drop_unused_points(SurfaceMesh& surface) {
  drop_points(surface.points, surface.triangles);
}

std::size_t drop_unused_points(TetMesh& mesh) {
  const std::size_t dropped = drop_points(mesh.points, mesh.tets);
  if (dropped > 0) {
    mesh.faces.clear();
    mesh.face_sides.clear();
  }
  return dropped;
}

}  // namespace voxtet
