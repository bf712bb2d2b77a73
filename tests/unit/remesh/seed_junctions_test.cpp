// First points along the curves where labels meet.
#include "remesh/delaunay/seed_junctions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/label_bodies.h"
#include "support/label_surface.h"
#include "support/test_surfaces.h"

namespace voxtet::remesh {
namespace {

using Eigen::Vector3d;

/// A ball cut at x = 12: two halves of different labels.
SurfaceMesh halved_ball() {
  return test::label_surface(test::make_volume(25, 25, 25, [](int i, int j, int k) {
    return (Vector3d(i, j, k) - Vector3d(12, 12, 12)).norm() > 9.3 ? 0 : i < 12 ? 1 : 2;
  }));
}

TEST(SeedJunctions, AreNoneWhereNoThreeLabelsMeet) {
  const SurfaceMesh sphere = test::sphere(Vector3d(5, 5, 5), 3, 2, 1, 0);
  EXPECT_TRUE(seed_junctions(sphere, test::uniform_sizing(1)).empty());
}

TEST(SeedJunctions, DivideAClosedCurveIntoEqualPartsOfTheTargetLength) {
  for (const double edge : {1.0, 2.5, 6.0}) {
    const std::vector<Vector3d> points = seed_junctions(halved_ball(), test::uniform_sizing(edge));
    const double length = 2 * EIGEN_PI * 9.3;
    EXPECT_NEAR(static_cast<double>(points.size()), length / edge, 0.05 * length / edge + 1);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_NEAR(points[i].x(), 11.5, 0.3);
      EXPECT_NEAR((points[i] - Vector3d(11.5, 12, 12)).norm(), 9.3, 0.5);
      const double step = (points[(i + 1) % points.size()] - points[i]).norm();
      // A chord is shorter than its arc.
      EXPECT_GT(step, 0.75 * edge);
      EXPECT_LT(step, 1.25 * edge);
    }
  }
}

TEST(SeedJunctions, BeginWithTheEndsOfAllCurves) {
  // Four quarters of a slab meet in a line of length 8, from whose ends four curves run around the slab.
  const SurfaceMesh surface =
      test::cells({2, 2, 1}, 8, [](int i, int j, int) { return Label(1 + i + 2 * j); });
  const std::vector<Vector3d> points = seed_junctions(surface, test::uniform_sizing(2));
  ASSERT_EQ(points.size(), 2U + 3 + 4 * 11);
  EXPECT_EQ(points[0] + points[1], Vector3d(16, 16, 8));
  EXPECT_EQ((points[0] - points[1]).cwiseAbs(), Vector3d(0, 0, 8));
  for (const Vector3d& p : points) {
    EXPECT_TRUE(p.x() == 8 || p.y() == 8) << p.transpose();
    const auto near = std::count_if(points.begin(), points.end(),
                                    [&](const Vector3d& q) { return std::abs((p - q).norm() - 2) < 1e-9; });
    EXPECT_EQ(near, &p < &points[2] ? 5 : 2) << p.transpose();
  }
}

}  // namespace
}  // namespace voxtet::remesh
