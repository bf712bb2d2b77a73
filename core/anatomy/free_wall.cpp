#include "anatomy/name_faces.h"
#include "anatomy/nearest_faces.h"

namespace voxtet::anatomy {

std::vector<double> free_wall_mm(const Points& points, const WallSurface& surface, const FaceKinds& kinds,
                                 std::size_t count, int threads) {
  std::vector<double> mean_mm(count, 0);
  const std::vector<Triangle> outer =
      triangles_of(surface, kinds, [](std::uint8_t kind) { return kind == wall::kOuter; });
  if (outer.empty()) return mean_mm;
  const ClosestPointTree outside(points, outer);
  for (std::size_t space = 0; space < count; ++space) {
    const auto own = [&](std::uint8_t kind) { return kind == wall::kInner + space; };
    const auto other = [&](std::uint8_t kind) { return kind >= wall::kInner && !own(kind); };
    const auto to_outside = closest_to_faces(outside, surface, kinds, threads, own);
    const std::vector<Triangle> others = triangles_of(surface, kinds, other);
    std::vector<ClosestPointTree::Hit> to_others;
    if (!others.empty()) to_others = closest_to_faces({points, others}, surface, kinds, threads, own);
    double area = 0;
    for (std::size_t f = 0; f < kinds.size(); ++f) {
      const double distance = to_outside[f].distance_mm;
      if (!own(kinds[f]) || (!others.empty() && to_others[f].distance_mm <= distance)) continue;
      area += surface.faces[f].area_mm2;
      mean_mm[space] += surface.faces[f].area_mm2 * distance;
    }
    if (area > 0) mean_mm[space] /= area;
  }
  return mean_mm;
}

}  // namespace voxtet::anatomy
