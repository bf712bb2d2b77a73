// The fit of an adapted surface's points to the field.
#include "remesh/delaunay/fit_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/elements/surface_measures.h"
#include "geometry/search/closest_point.h"
#include "remesh/delaunay/find_missed.h"
#include "support/label_bodies.h"
#include "support/test_random.h"
#include "support/test_surfaces.h"
#include "surface_report.h"

namespace voxtet::remesh {
namespace {

using Eigen::Vector3d;

constexpr double kRadius = 12.3, kBall = 4 * EIGEN_PI / 3 * kRadius * kRadius * kRadius;
const Vector3d kCentre = Vector3d::Constant(15.5);

LabelField ball_field() {
  return {test::ball_volume(32, 15.5, kRadius), test::sphere(kCentre, kRadius, 5, 1, 0)};
}

TEST(FitSurface, GivesCoarseFacetsOfASphereTheirVolume) {
  SurfaceMesh coarse = test::sphere(kCentre, kRadius, 2, 1, 0);
  const SurfaceMesh before = coarse;
  const double lost = kBall - enclosed_volume_mm3(coarse, 1);
  const double thinnest = test::report_on(coarse, test::uniform_sizing(1)).least_planar_deg;
  ASSERT_GT(lost, 0.02 * kBall);
  ASSERT_GE(thinnest, 29.25);
  fit_surface(coarse, ball_field(), {}, {0, kBall});
  EXPECT_LT(std::abs(kBall - enclosed_volume_mm3(coarse, 1)), lost / 50);
  EXPECT_GE(test::report_on(coarse, test::uniform_sizing(1)).least_planar_deg, 29);
  EXPECT_EQ(coarse.triangles, before.triangles);
  EXPECT_EQ(coarse.sides, before.sides);
  for (std::size_t p = 0; p < before.points.size(); ++p)
    EXPECT_LE((coarse.points[p] - before.points[p]).norm(),
              2 * kMostShiftVoxels);  // steps of 1, 1/2 and 1/4 of it
}

TEST(FitSurface, MakesNoTriangleThinnerThanBeforeAndThan29Degrees) {
  SurfaceMesh surface = test::sphere(kCentre, kRadius, 3, 1, 0);
  test::TestRandom random(5);
  for (Vector3d& p : surface.points) {
    for (int d = 0; d < 3; ++d) p[d] += random.below(1001) / 1000.0 - 0.5;
    p = kCentre + kRadius * (p - kCentre).normalized();
  }
  const double thinnest = test::report_on(surface, test::uniform_sizing(1)).least_planar_deg;
  ASSERT_LT(thinnest, 29);
  fit_surface(surface, ball_field(), {}, {0, kBall});
  EXPECT_GE(test::report_on(surface, test::uniform_sizing(1)).least_planar_deg, thinnest - 1e-9);
}

TEST(FitSurface, GoesNoFartherFromTheReferenceThanAllowed) {
  // A reference that lies outside of the field's ball, by more than is allowed once coarse facets have been
  // fitted to the ball.
  const SurfaceMesh reference = test::sphere(kCentre, kRadius + 0.6, 2, 1, 0);
  const auto farthest = [&](const SurfaceMesh& surface) {
    double most = 0;
    for (const FarPoint& p : far_points(reference, surface, {}, kFarthestVoxels)) {
      const auto& [a, b, c] = surface.triangles[p.triangle];
      const Vector3d on =
          closest_on_triangle(p.point, surface.points[a], surface.points[b], surface.points[c]);
      most = std::max(most, (on - p.point).norm());
    }
    return most;
  };
  SurfaceMesh free = test::sphere(kCentre, kRadius + 0.3, 2, 1, 0), held = free;
  const double shrunk = 0.95 * kBall;
  fit_surface(free, ball_field(), {}, {0, shrunk});
  ASSERT_GT(farthest(free), 1.05 * kFarthestVoxels);
  fit_surface(held, ball_field(), reference, {0, shrunk});
  EXPECT_LE(farthest(held), kFarthestVoxels + 1e-9);
}

TEST(FitSurface, LeavesPointsWhereTheFieldKnowsNoDistance) {
  SurfaceMesh inside = test::sphere(kCentre, 3, 2, 1, 0);
  const SurfaceMesh before = inside;
  fit_surface(inside, ball_field(), {}, enclosed_volumes_mm3(before));
  EXPECT_EQ(inside.points, before.points);
}

}  // namespace
}  // namespace voxtet::remesh
