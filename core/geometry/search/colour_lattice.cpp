#include "geometry/search/colour_lattice.h"

#include <Eigen/Geometry>

#include "base/buckets.h"
#include "geometry/search/cube_grid.h"

namespace voxtet {
namespace {

constexpr double kMostCubes = 1U << 20U;

double side_for(const Eigen::Vector3d& sizes, double side_mm) {
  const auto count = [&] { return ((sizes / side_mm).array() + 1).prod(); };
  while (count() > kMostCubes) side_mm *= 2;
  return side_mm;
}

/// Of the cube at these steps. A bound between two zones of a colour is the same number for both.
CubeZone zone_of(const Eigen::Vector3d& low, double side, const std::array<int, 3>& steps) {
  const Eigen::Array3d first(2 * steps[0] - 1, 2 * steps[1] - 1, 2 * steps[2] - 1);
  return {low.array() + first * (side / 2), low.array() + (first + 4) * (side / 2)};
}

}  // namespace

ColourLattice::ColourLattice(std::span<const Eigen::Vector3d> points, double side_mm) {
  if (points.empty()) return;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points) box.extend(p);
  const double side = side_for(box.sizes(), side_mm);
  const CubeGrid grid(box.min(), box.max(), side);
  Buckets<std::uint32_t> buckets(grid.count());
  for (const Eigen::Vector3d& p : points) buckets.count(grid.number(grid.steps_to(p)));
  buckets.allocate();
  for (std::uint32_t i = 0; i < points.size(); ++i) buckets.add(grid.number(grid.steps_to(points[i])), i);

  items_.reserve(points.size());
  const std::array<int, 3> end = grid.steps_to(box.max());
  for (int colour = 0; colour < static_cast<int>(kColours); ++colour) {
    first_[static_cast<std::size_t>(colour)] = cubes_.size();
    for (int k = colour >> 2; k <= end[2]; k += 2)
      for (int j = colour >> 1 & 1; j <= end[1]; j += 2)
        for (int i = colour & 1; i <= end[0]; i += 2) {
          const std::span<const std::uint32_t> here = buckets.at(grid.number({i, j, k}));
          if (here.empty()) continue;
          items_.insert(items_.end(), here.begin(), here.end());
          cubes_.push_back({zone_of(box.min(), side, {i, j, k}), std::span(items_).last(here.size())});
        }
  }
  first_[kColours] = cubes_.size();
}

}  // namespace voxtet
