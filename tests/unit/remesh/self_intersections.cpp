#include "self_intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>

namespace voxtet::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;

class PairTest {
 public:
  explicit PairTest(const SurfaceMesh& surface) : surface_(surface) {
    for (const Eigen::Vector3d& p : surface.points) points_.emplace_back(p.x(), p.y(), p.z());
  }

  bool intersect(std::uint32_t s, std::uint32_t t) const {
    Triangle a = surface_.triangles[s], b = surface_.triangles[t];
    int shared = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = shared; j < 3; ++j)
        if (a[i] == b[j]) {
          std::swap(a[shared], a[i]);
          std::swap(b[shared], b[j]);
          ++shared;
          break;
        }
    if (shared == 3) return true;
    if (shared == 2) return folded(a, b);
    if (shared == 1) {
      return CGAL::do_intersect(triangle(a), Kernel::Segment_3(points_[b[1]], points_[b[2]])) ||
             CGAL::do_intersect(triangle(b), Kernel::Segment_3(points_[a[1]], points_[a[2]]));
    }
    return CGAL::do_intersect(triangle(a), triangle(b));
  }

  Box box(std::uint32_t t) const {
    CGAL::Bbox_3 bounds;
    for (const std::uint32_t c : surface_.triangles[t]) bounds += points_[c].bbox();
    return Box(bounds, t);
  }

 private:
  Kernel::Triangle_3 triangle(const Triangle& t) const {
    return {points_[t[0]], points_[t[1]], points_[t[2]]};
  }

  /// Two triangles on one edge overlap if they are coplanar and on the same side of it.
  bool folded(const Triangle& a, const Triangle& b) const {
    const Kernel::Point_3 &p = points_[a[0]], &q = points_[a[1]], &r = points_[a[2]], &s = points_[b[2]];
    return CGAL::coplanar(p, q, r, s) && CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
  }

  const SurfaceMesh& surface_;
  std::vector<Kernel::Point_3> points_;
};

}  // namespace

std::size_t count_self_intersections(const SurfaceMesh& surface) {
  const PairTest test(surface);
  std::vector<Box> boxes;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) boxes.push_back(test.box(t));
  std::vector<const Box*> pointers;
  for (const Box& box : boxes) pointers.push_back(&box);
  std::size_t count = 0;
  CGAL::box_self_intersection_d(pointers.begin(), pointers.end(), [&](const Box* a, const Box* b) {
    count += test.intersect(a->info(), b->info());
  });
  return count;
}

}  // namespace voxtet::test
