// Exact contact tests against CGAL's, mostly on points that lie in one plane or line.
#include "remesh/triangle_contact.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include "support/label_bodies.h"

namespace voxtet::remesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 to_cgal(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}
Kernel::Triangle_3 to_cgal(const Corners& t) {
  return {to_cgal(t[0]), to_cgal(t[1]), to_cgal(t[2])};
}

TEST(TriangleContact, AgreesWithCgalOnDegeneratePositions) {
  test::TestRandom random(3);
  int met = 0, apart = 0;
  for (int round = 0; round < 6000; ++round) {
    // Few values a coordinate; tenths are not exact in binary, so that differences have rounding errors.
    const int values = round % 3 == 0 ? 3 : round % 3 == 1 ? 5 : 1000;
    const double unit = round % 3 == 0 ? 0.5 : round % 3 == 1 ? 0.1 : 1e-3;
    const auto point = [&] {
      Eigen::Vector3d p;
      for (int d = 0; d < 3; ++d) p[d] = 0.3 + unit * random.below(values);
      if (round % 6 >= 3) p[2] = 0.7;
      return p;
    };
    Corners a, b;
    for (Eigen::Vector3d& p : a) p = point();
    for (Eigen::Vector3d& p : b) p = point();
    ASSERT_EQ(
        orientation(a[0], a[1], a[2], b[0]),
        -static_cast<int>(CGAL::orientation(to_cgal(a[0]), to_cgal(a[1]), to_cgal(a[2]), to_cgal(b[0]))));
    if (to_cgal(a).is_degenerate() || to_cgal(b).is_degenerate()) continue;
    const bool meet = CGAL::do_intersect(to_cgal(a), to_cgal(b));
    (meet ? met : apart) += 1;
    ASSERT_EQ(triangles_meet(a, b), meet) << "round " << round;
    ASSERT_EQ(segment_meets_triangle(b[0], b[1], a),
              CGAL::do_intersect(Kernel::Segment_3(to_cgal(b[0]), to_cgal(b[1])), to_cgal(a)))
        << "round " << round;
  }
  EXPECT_GT(met, 1000);
  EXPECT_GT(apart, 1000);
}

TEST(TriangleContact, SeesTrianglesMeetBeyondACommonCorner) {
  const Corners flat{Eigen::Vector3d(0, 0, 0), {2, 0, 0}, {0, 2, 0}};
  EXPECT_TRUE(triangles_meet_beyond_corner(flat, {Eigen::Vector3d(0, 0, 0), {1, 1, 1}, {1, 1, -1}}));
  EXPECT_TRUE(triangles_meet_beyond_corner(flat, {Eigen::Vector3d(0, 0, 0), {0.5, 0.5, 0}, {-1, 1, 0}}));
  EXPECT_FALSE(triangles_meet_beyond_corner(flat, {Eigen::Vector3d(0, 0, 0), {-1, -1, 1}, {-1, -1, -1}}));
  EXPECT_FALSE(triangles_meet_beyond_corner(flat, {Eigen::Vector3d(0, 0, 0), {1, 1, 1}, {1, 1, 2}}));
}

TEST(TriangleContact, MeasuresFoldsAndAngles) {
  EXPECT_NEAR(fold_cosine({0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {0, 0, 3}), 0, 1e-15);
  EXPECT_NEAR(fold_cosine({0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {0, -2, 0}), -1, 1e-15);
  EXPECT_NEAR(sharpest_cosine({Eigen::Vector3d(0, 0, 0), {1, 0, 0}, {0, 1, 0}}), std::sqrt(0.5), 1e-15);
}

}  // namespace
}  // namespace voxtet::remesh
