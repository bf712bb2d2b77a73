#include <algorithm>
#include <cmath>
#include <limits>

#include "anatomy/name_faces.h"
#include "anatomy/nearest_faces.h"
#include "anatomy/surface_parts.h"
#include "types/grid_corners.h"
#include "walls/wall_potential.h"

namespace voxtet::anatomy {
namespace {

constexpr std::uint8_t kLeft = wall::kInner, kRight = wall::kInner + 1;
constexpr int kRimSteps = 5;  ///< half voxels

/// Outer voxels in front of the base become kSide.
void close_base(const Points& points, const WallSurface& surface, const FaceKinds& kinds,
                const SearchableGrid& search, wall::WallGrid& grid) {
  const double step_mm = grid.smallest_spacing_mm() / 2;
  for (std::size_t f = 0; f < kinds.size(); ++f) {
    if (kinds[f] != wall::kSide) continue;
    const WallFace& face = surface.faces[f];
    const auto& [a, b, c] = face.corners;
    const Eigen::Vector3d &p = points[a], u = points[b] - p, v = points[c] - p;
    const int n = 1 + static_cast<int>(std::sqrt(std::max(u.squaredNorm(), v.squaredNorm())) / step_mm);
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j)
        for (int k = -1; k <= kRimSteps; ++k) {
          const Eigen::Vector3d at = p + (i * u + j * v) / n + k * step_mm * face.normal;
          const Eigen::Vector3d index = (search.to_index(at).array() + 0.5).floor();
          const Eigen::Vector3i voxel = index.cast<int>();
          if (!grid.contains(voxel[0], voxel[1], voxel[2])) continue;
          std::uint8_t& kind = grid.kind[grid.offset(voxel)];
          if (kind == wall::kOuter) kind = wall::kSide;
        }
  }
}

/// The potential of the wall's voxels; not a number elsewhere.
std::vector<float> left_to_outside(wall::WallGrid grid, int threads) {
  for (std::uint8_t& kind : grid.kind)
    if (kind == kRight) kind = wall::kSide;
  grid.distance_mm.assign(grid.kind.size(), 1.F);  // everywhere the same: surfaces lie halfway
  const wall::WallGraph graph = wall::wall_graph(grid, kLeft, threads);
  const std::vector<float> solved = wall::wall_potential(grid, graph, threads);
  std::vector<float> potential(grid.kind.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t n = 0; n < solved.size(); ++n) potential[graph.voxel[n]] = solved[n];
  return potential;
}

}  // namespace

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

std::vector<bool> find_septum(const Points& points, const WallSurface& surface, const FaceKinds& kinds,
                              wall::WallGrid grid, int threads) {
  SearchableGrid search;
  static_cast<Grid&>(search) = grid;
  search.invert();
  close_base(points, surface, kinds, search, grid);
  const std::vector<float> potential = left_to_outside(grid, threads);

  // Behind the face, where the eight voxels around are of the wall.
  const double step_mm = grid.smallest_spacing_mm() / 2;
  enum Name : std::uint8_t { kElsewhere, kFree, kSeptum };
  std::vector<std::uint8_t> names(kinds.size(), kElsewhere);
  for (std::size_t f = 0; f < kinds.size(); ++f) {
    if (kinds[f] != kRight) continue;
    double sum = 0, weights = 0;
    for (int step = 1; step <= 4; ++step) {
      const Eigen::Vector3d at = surface.faces[f].centre - step * step_mm * surface.faces[f].normal;
      for_grid_corners(grid.size, search.to_index(at), [&](std::size_t voxel, double weight) {
        if (std::isnan(potential[voxel])) return;
        sum += weight * potential[voxel];
        weights += weight;
      });
    }
    names[f] = 2 * sum < weights ? kSeptum : kFree;
  }
  const SurfaceParts parts = surface_parts(surface, names);
  std::vector<Fate> fates = largest_stay(parts);
  for (std::size_t part = 0; part < fates.size(); ++part)
    if (parts.name[part] == kElsewhere) fates[part] = Fate::kApart;
  give_away(surface, parts, fates, kFree, names);
  std::vector<bool> septum;
  septum.reserve(names.size());
  for (const std::uint8_t name : names) septum.push_back(name == kSeptum);
  return septum;
}

}  // namespace voxtet::anatomy
