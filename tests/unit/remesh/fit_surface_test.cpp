// The fit of an adapted surface's points to the field.
#include "remesh/fit_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/surface_measures.h"
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
  fit_surface(coarse, ball_field(), {0, kBall});
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
  fit_surface(surface, ball_field(), {0, kBall});
  EXPECT_GE(test::report_on(surface, test::uniform_sizing(1)).least_planar_deg, thinnest - 1e-9);
}

TEST(FitSurface, LeavesPointsWhereTheFieldKnowsNoDistance) {
  SurfaceMesh inside = test::sphere(kCentre, 3, 2, 1, 0);
  const SurfaceMesh before = inside;
  fit_surface(inside, ball_field(), enclosed_volumes_mm3(before));
  EXPECT_EQ(inside.points, before.points);
}

}  // namespace
}  // namespace voxtet::remesh
