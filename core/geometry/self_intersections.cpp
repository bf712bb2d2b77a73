#include "geometry/self_intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>

namespace voxtet {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;

class Tester {
 public:
  explicit Tester(const SurfaceMesh& surface) : surface_(surface) {}

  bool intersect(std::uint32_t t, std::uint32_t s) const {
    Triangle a = surface_.triangles[t], b = surface_.triangles[s];
    const int shared = move_shared_to_front(a, b);
    if (shared == 3) return true;
    if (shared == 2) {
      const Point p = point(a[0]), q = point(a[1]), r = point(a[2]), other = point(b[2]);
      return CGAL::coplanar(p, q, r, other) && CGAL::coplanar_orientation(p, q, r, other) == CGAL::POSITIVE;
    }
    if (shared == 1)
      return CGAL::do_intersect(triangle(a), Kernel::Segment_3(point(b[1]), point(b[2]))) ||
             CGAL::do_intersect(triangle(b), Kernel::Segment_3(point(a[1]), point(a[2])));
    return CGAL::do_intersect(triangle(a), triangle(b));
  }

 private:
  static int move_shared_to_front(Triangle& a, Triangle& b) {
    int shared = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = shared; j < 3; ++j)
        if (a[i] == b[j]) {
          std::swap(a[i], a[shared]);
          std::swap(b[j], b[shared]);
          ++shared;
          break;
        }
    return shared;
  }
  Point point(std::uint32_t v) const {
    const Eigen::Vector3d& p = surface_.points[v];
    return {p.x(), p.y(), p.z()};
  }
  Kernel::Triangle_3 triangle(const Triangle& t) const { return {point(t[0]), point(t[1]), point(t[2])}; }

  const SurfaceMesh& surface_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 2>> find_self_intersections(const SurfaceMesh& surface,
                                                                  std::size_t max_pairs) {
  std::vector<Box> boxes;
  boxes.reserve(surface.triangles.size());
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    CGAL::Bbox_3 bounds;
    for (const std::uint32_t v : surface.triangles[t]) {
      const Eigen::Vector3d& p = surface.points[v];
      bounds += CGAL::Bbox_3(p.x(), p.y(), p.z(), p.x(), p.y(), p.z());
    }
    boxes.emplace_back(bounds, t);
  }
  std::vector<std::array<std::uint32_t, 2>> pairs;
  const Tester tester(surface);
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    if (pairs.size() < max_pairs && tester.intersect(a.info(), b.info()))
      pairs.push_back({std::min(a.info(), b.info()), std::max(a.info(), b.info())});
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace voxtet
