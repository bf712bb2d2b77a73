// Which triangles may be facets of a Delaunay triangulation.
#include "remesh/complex/gabriel_balls.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "geometry/elements/surface_measures.h"
#include "support/test_random.h"
#include "support/triangulated.h"

namespace voxtet::remesh {
namespace {

using Eigen::Vector3d;

const TriangleCorners kTriangle{Vector3d(1, 0, 0), Vector3d(-0.5, std::sqrt(0.75), 0),
                                Vector3d(-0.5, -std::sqrt(0.75), 0)};  // circumradius 1 around the origin

TEST(GabrielBalls, AreThereWithoutOtherPoints) {
  EXPECT_TRUE(GabrielBalls(kTriangle).any());
}

TEST(GabrielBalls, GoAwayFromAPointOnOneSide) {
  GabrielBalls balls(kTriangle);
  EXPECT_FALSE(balls.leave_out({0, 0, 3}));  // all end before it
  EXPECT_TRUE(balls.leave_out({0, 0, 0.7}));
  EXPECT_FALSE(balls.leave_out({0, 0, 0.8}));
  EXPECT_TRUE(balls.any());
}

TEST(GabrielBalls, AreNotBetweenTwoPointsThatAreNear) {
  GabrielBalls balls(kTriangle);
  EXPECT_TRUE(balls.leave_out({0.1, 0, 0.5}));
  EXPECT_TRUE(balls.leave_out({0, 0.1, -0.5}));
  EXPECT_FALSE(balls.any());
}

TEST(GabrielBalls, AreBetweenTwoPointsThatAreFarEnough) {
  GabrielBalls balls(kTriangle);
  balls.leave_out({0.1, 0, 1.2});
  balls.leave_out({0, 0.1, -0.9});
  EXPECT_TRUE(balls.any());
}

TEST(GabrielBalls, HoldNoPointOfTheTrianglesPlaneInsideItsCircle) {
  GabrielBalls inside(kTriangle), on(kTriangle);
  EXPECT_TRUE(inside.leave_out({0.9, 0.1, 0}));
  EXPECT_FALSE(inside.any());
  on.leave_out({-1, 0, 0});  // a square or the like: either diagonal will do
  EXPECT_TRUE(on.any());
}

TEST(GabrielBalls, AreThereForEveryFacetOfADelaunayTriangulationWithSmallBalls) {
  test::TestRandom random(3);
  std::vector<Vector3d> points;
  points.reserve(200);
  for (int i = 0; i < 200; ++i)
    points.emplace_back(random.below(1000) / 1000.0, random.below(1000) / 1000.0,
                        random.below(1000) / 1000.0);
  const DelaunayTriangulation triangulation = test::triangulated(points);
  int checked = 0, without = 0;
  for (std::uint32_t cell = 0; cell < triangulation.slots(); ++cell) {
    if (!triangulation.is_finite(cell)) continue;
    const auto& corners = triangulation.corners(cell);
    const TriangleCorners p{points[corners[1]], points[corners[2]], points[corners[3]]};
    const Vector3d centre = triangulation.ball(cell).centre;
    GabrielBalls balls(p);
    for (const Vector3d& point : points)
      if (point != p[0] && point != p[1] && point != p[2]) balls.leave_out(point);
    // The cell's own ball is one of them, if its centre is near enough to the triangle.
    const Vector3d normal = triangle_cross(p[0], p[1], p[2]).normalized();
    const double radius2 = (centre - p[0]).squaredNorm();
    const double height = (centre - p[0]).dot(normal);
    if (2 * height * height > radius2) continue;
    ++checked;
    EXPECT_TRUE(balls.any());
  }
  EXPECT_GT(checked, 100);
  // Of triangles of any three points few are facets.
  for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
    GabrielBalls balls({points[i], points[i + 1], points[i + 2]});
    for (std::size_t k = 0; k < points.size(); ++k)
      if (k < i || k > i + 2) balls.leave_out(points[k]);
    without += !balls.any();
  }
  EXPECT_GT(without, 55);
}

}  // namespace
}  // namespace voxtet::remesh
