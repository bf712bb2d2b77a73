#include "tetra/interfaces/nearby_surface.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>

#include "tetra/mesh/edge_groups.h"

namespace voxtet::tetra {
namespace {

/// Cells of a grid along its longest axis, at most.
constexpr double kMostCells = 256;

/// A grid over the places, with those cells marked that are near one.
class CellMarks {
 public:
  CellMarks(std::span<const BoundaryPlace> places, double reach_mm) {
    Eigen::AlignedBox3d box;
    for (const BoundaryPlace& place : places) box.extend(place.at);
    cell_ = std::max(reach_mm, box.sizes().maxCoeff() / kMostCells);
    low_ = box.min().array() - 2 * cell_;
    size_ = (box.sizes() / cell_).cast<int>().array() + 5;
    marked_.assign(static_cast<std::size_t>(size_.cast<std::ptrdiff_t>().prod()), 0);
    for (const BoundaryPlace& place : places) {
      const Eigen::Array3i middle = cell_of(place.at);
      for_cells(middle - 1, middle + 1, [this](std::size_t cell) {
        marked_[cell] = 1;
        return false;
      });
    }
  }

  /// Whether a triangle's box reaches into a marked cell.
  bool near(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) const {
    const Eigen::Array3i low = cell_of(a.cwiseMin(b).cwiseMin(c)), high = cell_of(a.cwiseMax(b).cwiseMax(c));
    return for_cells(low, high, [this](std::size_t cell) { return marked_[cell] != 0; });
  }

 private:
  /// Points outside of the grid have the nearest cell, which is never marked: the outermost ones are not.
  Eigen::Array3i cell_of(const Eigen::Vector3d& point) const {
    const Eigen::Array3d x = (point - low_).array() / cell_;
    return x.max(0.0).min(size_.cast<double>() - 1).cast<int>();
  }
  /// Calls until one gives true; whether one did.
  template <class Visit>
  bool for_cells(const Eigen::Array3i& low, const Eigen::Array3i& high, const Visit& visit) const {
    for (int k = low[2]; k <= high[2]; ++k)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int i = low[0]; i <= high[0]; ++i)
          if (visit(static_cast<std::size_t>(i) +
                    static_cast<std::size_t>(size_[0]) *
                        (static_cast<std::size_t>(j) +
                         static_cast<std::size_t>(size_[1]) * static_cast<std::size_t>(k))))
            return true;
    return false;
  }

  double cell_ = 1;
  Eigen::Vector3d low_;
  Eigen::Array3i size_;
  std::vector<std::uint8_t> marked_;
};

/// Adds the edges of curves of the kinds that are asked for.
void add_curves(const SurfaceMesh& surface, std::map<BoundaryKind, std::vector<Triangle>>& asked) {
  const EdgeGroups edges(surface);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges[e].size() < 3) continue;
    BoundaryKind kind;
    for (const TriangleUse& use : edges[e]) kind.push_back(surface.sides[use.triangle]);
    if (const auto group = asked.find(ascending(std::move(kind))); group != asked.end())
      group->second.push_back({edges[e][0].low, edges[e][0].high, edges[e][0].high});
  }
}

}  // namespace

BoundaryKind ascending(BoundaryKind kind) {
  std::sort(kind.begin(), kind.end());
  kind.erase(std::unique(kind.begin(), kind.end()), kind.end());
  return kind;
}

NearbySurface::NearbySurface(const SurfaceMesh& surface, std::span<const BoundaryPlace> places,
                             double reach_mm) {
  if (places.empty()) return;
  const CellMarks marks(places, reach_mm);
  std::map<BoundaryKind, std::vector<Triangle>> asked;
  SurfaceMesh at_curves;
  std::set<Sides> meeting;
  for (const BoundaryPlace& place : places) {
    asked[place.kind];
    if (place.kind.size() > 1) meeting.insert(place.kind.begin(), place.kind.end());
  }
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    if (!marks.near(surface.points[a], surface.points[b], surface.points[c])) continue;
    if (const auto group = asked.find({surface.sides[t]}); group != asked.end())
      group->second.push_back(surface.triangles[t]);
    if (meeting.count(surface.sides[t]) == 0) continue;
    at_curves.triangles.push_back(surface.triangles[t]);
    at_curves.sides.push_back(surface.sides[t]);
  }
  if (!at_curves.triangles.empty()) {
    at_curves.points = surface.points;
    add_curves(at_curves, asked);
  }
  for (const auto& [kind, group] : asked)
    if (!group.empty()) trees_.try_emplace(kind, surface.points, group);
}

const ClosestPointTree* NearbySurface::of(const BoundaryKind& kind) const {
  const auto found = trees_.find(kind);
  return found == trees_.end() ? nullptr : &found->second;
}

}  // namespace voxtet::tetra
