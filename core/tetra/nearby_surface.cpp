#include "tetra/nearby_surface.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace voxtet::tetra {
namespace {

/// Cells of a grid along its longest axis, at most.
constexpr double kMostCells = 128;

/// A grid over the places, with those cells marked that are near one.
class CellMarks {
 public:
  CellMarks(std::span<const BoundaryPlace> places, double reach_mm) {
    Eigen::AlignedBox3d box;
    for (const BoundaryPlace& place : places) box.extend(place.at);
    cell_ = std::max(reach_mm, box.sizes().maxCoeff() / kMostCells);
    low_ = box.min().array() - 2 * cell_;
    for (Eigen::Index d = 0; d < 3; ++d)
      size_[static_cast<std::size_t>(d)] = static_cast<int>(box.sizes()[d] / cell_) + 5;
    marked_.assign(static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) *
                       static_cast<std::size_t>(size_[2]),
                   0);
    for (const BoundaryPlace& place : places)
      for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j)
          for (int k = -1; k <= 1; ++k)
            marked_[static_cast<std::size_t>(cell_at(place.at + cell_ * Eigen::Vector3d(i, j, k)))] = 1;
  }

  bool near(const Eigen::Vector3d& point) const {
    const std::ptrdiff_t cell = cell_at(point);
    return cell >= 0 && marked_[static_cast<std::size_t>(cell)];
  }

 private:
  /// -1 outside of the grid.
  std::ptrdiff_t cell_at(const Eigen::Vector3d& point) const {
    std::ptrdiff_t cell = 0;
    for (std::size_t d = 3; d-- > 0;) {
      const double x = (point[static_cast<Eigen::Index>(d)] - low_[static_cast<Eigen::Index>(d)]) / cell_;
      if (!(x >= 0 && x < size_[d])) return -1;
      cell = cell * size_[d] + static_cast<int>(x);
    }
    return cell;
  }

  double cell_ = 1;
  Eigen::Vector3d low_;
  std::array<int, 3> size_{};
  std::vector<std::uint8_t> marked_;
};

}  // namespace

NearbySurface::NearbySurface(const SurfaceMesh& surface, std::span<const BoundaryPlace> places,
                             double reach_mm) {
  if (places.empty()) return;
  const CellMarks marks(places, reach_mm);
  std::vector<std::uint8_t> near(surface.points.size());
  std::transform(surface.points.begin(), surface.points.end(), near.begin(),
                 [&](const Eigen::Vector3d& point) { return marks.near(point); });
  std::map<Sides, std::vector<Triangle>> triangles;
  for (const BoundaryPlace& place : places) triangles[place.sides];
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    if (!near[a] && !near[b] && !near[c]) continue;
    if (const auto group = triangles.find(surface.sides[t]); group != triangles.end())
      group->second.push_back(surface.triangles[t]);
  }
  for (const auto& [sides, group] : triangles)
    if (!group.empty()) trees_.try_emplace(sides, surface.points, group);
}

const ClosestPointTree* NearbySurface::between(const Sides& sides) const {
  const auto found = trees_.find(sides);
  return found == trees_.end() ? nullptr : &found->second;
}

}  // namespace voxtet::tetra
