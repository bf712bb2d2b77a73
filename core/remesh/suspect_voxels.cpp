#include "remesh/suspect_voxels.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "geometry/surface_measures.h"
#include "geometry/triangle_measures.h"
#include "remesh/kuhn_neighbours.h"

namespace voxtet::remesh {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr int kReach = 1;  ///< voxels around a suspect one

Vector3i to_neighbour(std::size_t neighbour) {
  const auto [i, j, k] = step_to(neighbour);
  return {i, j, k};
}

/// Where the segment from `a` along `way` meets a triangle, as a share of it (Möller and Trumbore 1997).
std::optional<double> meets(const Vector3d& a, const Vector3d& way, const TriangleCorners& p) {
  const Vector3d e1 = p[1] - p[0], e2 = p[2] - p[0], h = way.cross(e2);
  const double det = e1.dot(h);
  if (det == 0) return std::nullopt;
  const Vector3d s = a - p[0], q = s.cross(e1);
  const double u = s.dot(h) / det, v = way.dot(q) / det, at = e2.dot(q) / det;
  if (!(u >= 0 && v >= 0 && u + v <= 1 && at >= 0 && at <= 1)) return std::nullopt;
  return at;
}

bool is_one_of(Label label, const std::vector<Label>& labels) {
  return std::binary_search(labels.begin(), labels.end(), label);
}

}  // namespace

SuspectVoxels::SuspectVoxels(const SurfaceMesh& reference, const LabelField& field) : field_(field) {
  for (const Crossing& crossing : crossings(reference))
    if (crossing.way < kUp) reference_ways_.push_back(crossing.voxel * kUp + crossing.way);
  std::sort(reference_ways_.begin(), reference_ways_.end());
}

std::vector<SuspectVoxels::Crossing> SuspectVoxels::crossings(const SurfaceMesh& surface) const {
  std::array<Vector3d, kUp> ways_mm;
  for (std::size_t way = 0; way < kUp; ++way)
    ways_mm[way] = field_.to_mm(to_neighbour(way).cast<double>()) - field_.to_mm(Vector3d::Zero());
  std::vector<Crossing> out;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    TriangleCorners p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = field_.to_index(surface.points[surface.triangles[t][k]]);
    const Vector3i low = p[0].cwiseMin(p[1]).cwiseMin(p[2]).array().floor().cast<int>();
    const Vector3i high = p[0].cwiseMax(p[1]).cwiseMax(p[2]).array().floor().cast<int>();
    const Vector3d cross =
        triangle_cross(surface.points[surface.triangles[t][0]], surface.points[surface.triangles[t][1]],
                       surface.points[surface.triangles[t][2]]);
    const auto& [behind, front] = surface.sides[t];
    for (int k = low[2]; k <= high[2]; ++k)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int i = low[0]; i <= high[0]; ++i)
          for (std::uint8_t way = 0; way < kUp; ++way) {
            const Vector3i from(i, j, k), to = from + to_neighbour(way);
            if (!inside(from) || !inside(to)) continue;
            const std::optional<double> at = meets(from.cast<double>(), to_neighbour(way).cast<double>(), p);
            if (!at) continue;
            const bool outwards = cross.dot(ways_mm[way]) > 0;
            const auto backwards = static_cast<std::uint8_t>(way + kUp);
            out.push_back({field_.offset(from), *at, t, way, outwards ? behind : front});
            out.push_back({field_.offset(to), 1 - *at, t, backwards, outwards ? front : behind});
          }
  }
  std::sort(out.begin(), out.end(), [](const Crossing& a, const Crossing& b) {
    return std::tie(a.voxel, a.at, a.triangle, a.way) < std::tie(b.voxel, b.at, b.triangle, b.way);
  });
  return out;
}

std::vector<bool> SuspectVoxels::of(const SurfaceMesh& surface, const std::vector<Label>& labels) const {
  const std::vector<Label>& centres = field_.centre_labels();
  const std::vector<Crossing> all = crossings(surface);
  // The nearest crossing tells on which side of the surface a centre is.
  std::vector<std::pair<std::uint64_t, Label>> moved;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i > 0 && all[i].voxel == all[i - 1].voxel) continue;
    if (all[i].label != centres[all[i].voxel]) moved.emplace_back(all[i].voxel, all[i].label);
  }
  const auto label_by_surface = [&](std::uint64_t voxel) {
    const auto at = std::lower_bound(moved.begin(), moved.end(), std::pair{voxel, Label{0}});
    return at != moved.end() && at->first == voxel ? at->second : centres[voxel];
  };
  std::vector<bool> marked;
  for (const auto& [voxel, label] : moved) {
    const Vector3i middle = voxel_of(voxel);
    bool simple = true;
    for (const Label other : {label, centres[voxel]}) {
      if (!is_one_of(other, labels)) continue;
      std::uint32_t before = 0, after = 0;
      for (std::size_t n = 0; n < kNeighbours; ++n) {
        const Vector3i next = middle + to_neighbour(n);
        const bool known = inside(next);
        if ((known ? centres[field_.offset(next)] : kBackground) == other) before |= 1U << n;
        if ((known ? label_by_surface(field_.offset(next)) : kBackground) == other) after |= 1U << n;
      }
      simple = simple && is_simple(before) && is_simple(after);
    }
    if (!simple) mark_around(voxel, marked);
  }
  for (const Crossing& crossing : all) {
    if (crossing.way >= kUp) continue;
    const Sides& sides = surface.sides[crossing.triangle];
    if (!is_one_of(sides[0], labels) && !is_one_of(sides[1], labels)) continue;
    const std::uint64_t end = field_.offset(voxel_of(crossing.voxel) + to_neighbour(crossing.way));
    const Label label = centres[crossing.voxel];
    if (centres[end] != label || label_by_surface(crossing.voxel) != label || label_by_surface(end) != label)
      continue;
    if (std::binary_search(reference_ways_.begin(), reference_ways_.end(),
                           crossing.voxel * kUp + crossing.way))
      continue;
    mark_around(crossing.voxel, marked);
    mark_around(end, marked);
  }
  return marked;
}

Vector3i SuspectVoxels::voxel_of(std::uint64_t offset) const {
  const auto nx = static_cast<std::uint64_t>(field_.size()[0]),
             ny = static_cast<std::uint64_t>(field_.size()[1]);
  return {static_cast<int>(offset % nx), static_cast<int>(offset / nx % ny),
          static_cast<int>(offset / nx / ny)};
}

bool SuspectVoxels::inside(const Vector3i& voxel) const {
  for (int d = 0; d < 3; ++d)
    if (voxel[d] < 0 || voxel[d] >= field_.size()[static_cast<std::size_t>(d)]) return false;
  return true;
}

void SuspectVoxels::mark_around(std::uint64_t voxel, std::vector<bool>& marked) const {
  marked.resize(field_.centre_labels().size(), false);
  const Vector3i middle = voxel_of(voxel);
  for (int k = -kReach; k <= kReach; ++k)
    for (int j = -kReach; j <= kReach; ++j)
      for (int i = -kReach; i <= kReach; ++i)
        if (const Vector3i next = middle + Vector3i(i, j, k); inside(next))
          marked[field_.offset(next)] = true;
}

}  // namespace voxtet::remesh
