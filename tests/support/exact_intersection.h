// Oracle for triangles_intersect: constructs the intersection of two triangles exactly and compares it with
// what they share. CGAL is asked for points and segments here, not for a yes or no.
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <vector>

#include "types/surface_mesh.h"

namespace voxtet::test {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;

inline ExactKernel::Point_3 exact_point(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

inline ExactKernel::Triangle_3 exact_triangle(const std::vector<Eigen::Vector3d>& points, const Triangle& t) {
  return {exact_point(points[t[0]]), exact_point(points[t[1]]), exact_point(points[t[2]])};
}

inline bool has_area(const std::vector<Eigen::Vector3d>& points, const Triangle& t) {
  return !exact_triangle(points, t).is_degenerate();
}

/// True if the triangles have more in common than their corners of equal index and the edge between them.
inline bool meet_beyond_shared(const std::vector<Eigen::Vector3d>& points, const Triangle& a,
                               const Triangle& b) {
  std::vector<ExactKernel::Point_3> shared;
  for (const std::uint32_t v : a)
    if (std::find(b.begin(), b.end(), v) != b.end()) shared.push_back(exact_point(points[v]));
  const auto common = CGAL::intersection(exact_triangle(points, a), exact_triangle(points, b));
  if (!common) return false;
  if (const auto* point = boost::get<ExactKernel::Point_3>(&*common))
    return std::find(shared.begin(), shared.end(), *point) == shared.end();
  if (const auto* segment = boost::get<ExactKernel::Segment_3>(&*common))
    return shared.size() != 2 || !((segment->source() == shared[0] && segment->target() == shared[1]) ||
                                   (segment->source() == shared[1] && segment->target() == shared[0]));
  return true;
}

}  // namespace voxtet::test
