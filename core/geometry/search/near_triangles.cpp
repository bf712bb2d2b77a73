#include "geometry/search/near_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>

#include "base/buckets.h"
#include "geometry/search/closest_point.h"
#include "geometry/search/cube_grid.h"

namespace voxtet {
namespace {

using Eigen::Vector3d;

/// About as many cubes as there are points on a surface that fills their box.
CubeGrid cubes_around(std::span<const NearQuery> queries) {
  constexpr double kCubesPerPoint = 1.5, kMostOnAxis = 256;
  Vector3d low = queries[0].point, high = low;
  for (const NearQuery& query : queries) {
    low = low.cwiseMin(query.point);
    high = high.cwiseMax(query.point);
  }
  const Vector3d extent = high - low;
  const double cube = std::cbrt(extent.prod() / (kCubesPerPoint * static_cast<double>(queries.size())));
  return {low, high, std::max({cube, extent.maxCoeff() / kMostOnAxis, std::numeric_limits<double>::min()})};
}

/// Those within the limits.
void find_within(std::span<const NearQuery> queries, const std::vector<Vector3d>& corners,
                 const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& kinds,
                 std::vector<NearTriangle>& found) {
  const CubeGrid cubes = cubes_around(queries);
  std::vector<std::uint32_t> cube_of;
  cube_of.reserve(queries.size());
  Buckets<std::uint32_t> numbers(cubes.count());
  double reach_mm = 0;
  for (const NearQuery& query : queries) {
    cube_of.push_back(cubes.number(cubes.steps_to(query.point)));
    numbers.count(cube_of.back());
    reach_mm = std::max(reach_mm, query.limit_mm);
  }
  numbers.allocate();
  for (std::uint32_t i = 0; i < queries.size(); ++i) numbers.add(cube_of[i], i);

  reach_mm *= 1 + 1e-9;  // for the rounding of bounds
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const Vector3d &a = corners[triangles[t][0]], &b = corners[triangles[t][1]],
                   &c = corners[triangles[t][2]];
    const Vector3d low = a.cwiseMin(b).cwiseMin(c).array() - reach_mm;
    const Vector3d high = a.cwiseMax(b).cwiseMax(c).array() + reach_mm;
    const std::array<int, 3> first = cubes.steps_to(low), last = cubes.steps_to(high);
    const auto is_within = [&](const NearQuery& query) {
      const Vector3d& p = query.point;
      return query.kind == kinds[t] && (p.array() >= low.array()).all() &&
             (p.array() <= high.array()).all() &&
             (closest_on_triangle(p, a, b, c) - p).norm() <= query.limit_mm;
    };
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j)
        for (const std::uint32_t i :
             numbers.between(cubes.number({first[0], j, k}), cubes.number({last[0], j, k})))
          if (!found[i].within && is_within(queries[i])) found[i] = {t, true};
  }
}

/// The triangles of one kind.
struct KindTree {
  std::vector<std::uint32_t> ids;
  std::optional<ClosestPointTree> tree = {};
  std::uint32_t hint = 0;
};

/// The closest ones where none is within the limit.
void find_closest(std::span<const NearQuery> queries, const std::vector<Vector3d>& corners,
                  const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& kinds,
                  std::vector<NearTriangle>& found) {
  std::map<std::uint32_t, KindTree> trees;
  for (std::size_t i = 0; i < queries.size(); ++i)
    if (!found[i].within) trees[queries[i].kind];
  if (trees.empty()) return;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    if (const auto tree = trees.find(kinds[t]); tree != trees.end()) tree->second.ids.push_back(t);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    if (found[i].within) continue;
    auto& [ids, tree, hint] = trees[queries[i].kind];
    if (ids.empty()) continue;
    if (!tree) {
      std::vector<Triangle> own;
      for (const std::uint32_t t : ids) own.push_back(triangles[t]);
      tree.emplace(corners, own);
    }
    hint = tree->closest(queries[i].point, hint).triangle;
    found[i].triangle = ids[hint];
  }
}

}  // namespace

std::vector<NearTriangle> near_triangles(std::span<const NearQuery> queries,
                                         const std::vector<Vector3d>& corners,
                                         const std::vector<Triangle>& triangles,
                                         const std::vector<std::uint32_t>& kinds) {
  std::vector<NearTriangle> found(queries.size());
  if (queries.empty()) return found;
  find_within(queries, corners, triangles, kinds, found);
  find_closest(queries, corners, triangles, kinds, found);
  return found;
}

}  // namespace voxtet
