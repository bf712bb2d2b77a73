#include "quality/surface_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/test_surfaces.h"

namespace voxtet {
namespace {

using test::sphere;

SurfaceDistances distances(const SurfaceMesh& a, const SurfaceMesh& b, const DistanceParams& params) {
  RunContext ctx;
  const Result<SurfaceDistances> found =
      measure_distances({a.points, a.triangles, a.sides}, {b.points, b.triangles, b.sides}, params, ctx);
  EXPECT_TRUE(found.ok());
  return *found;
}

TEST(MeasureDistances, KnowsTheGapBetweenConcentricSpheres) {
  const SurfaceMesh inner = sphere({3, 2, 1}, 10, 4, 1, 0), outer = sphere({3, 2, 1}, 11, 3, 1, 0);
  const SurfaceDistances found = distances(inner, outer, {0.2, 0.05});
  for (const DistanceSummary& d : {found.forth, found.back}) {
    EXPECT_NEAR(d.mean_mm, 0.95, 0.05);
    EXPECT_NEAR(d.rms_mm, 0.95, 0.05);
    EXPECT_GE(d.max_mm, d.p95_mm);
    EXPECT_GE(d.p95_mm, d.mean_mm);
    EXPECT_LE(d.max_mm, 1 + 0.05);
    EXPECT_GE(d.max_mm + d.uncertainty_mm, 1) << "a corner of the one lies above a corner of the other";
    EXPECT_GT(d.samples, 4 * M_PI * 100 / (0.2 * 0.2) / 2);
    EXPECT_LE(d.spacing_mm, 0.2);
    EXPECT_GT(d.spacing_mm, 0.1);
  }
}

TEST(MeasureDistances, FindsTheLargestBetweenSamplesWithinTheTolerance) {
  // Corners of the icosahedron lie on the sphere; its face centres are 1 - 0.79465 radii away from it.
  const SurfaceMesh icosahedron = sphere({0, 0, 0}, 10, 0, 1, 0), ball = sphere({0, 0, 0}, 10, 5, 1, 0);
  const SurfaceDistances found = distances(icosahedron, ball, {99, 0.01});
  EXPECT_EQ(found.forth.samples, icosahedron.points.size());
  EXPECT_NEAR(found.forth.mean_mm, 0, 1e-12) << "of the corners alone";
  EXPECT_NEAR(found.forth.max_mm, 10 * (1 - 0.7946544723), 0.01);
  EXPECT_LE(found.forth.uncertainty_mm, 0.01);
  EXPECT_NEAR(found.back.max_mm, 10 * (1 - 0.7946544723), 0.01);
}

TEST(MeasureDistances, SaysHowFarApartItsSamplesAreAndIsNoFartherOff) {
  // Corners of the icosahedron lie on the sphere, all else of it does not: few samples are far off.
  const SurfaceMesh icosahedron = sphere({0, 0, 0}, 10, 0, 1, 0), ball = sphere({0, 0, 0}, 10, 5, 1, 0);
  const DistanceSummary fine = distances(icosahedron, ball, {0.1, 0.05}).forth;
  EXPECT_LE(fine.spacing_mm, 0.1);
  for (const double spacing : {1.0, 4.0, 99.0}) {
    const DistanceSummary coarse = distances(icosahedron, ball, {spacing, 0.05}).forth;
    EXPECT_LE(coarse.spacing_mm, std::min(spacing, 10.6)) << "an edge is 10.51 mm long";
    const double room = coarse.spacing_mm + fine.spacing_mm;
    EXPECT_NEAR(coarse.mean_mm, fine.mean_mm, room);
    EXPECT_NEAR(coarse.rms_mm, fine.rms_mm, room);
    EXPECT_NEAR(coarse.p95_mm, fine.p95_mm, room);
    if (spacing == 99) EXPECT_GT(fine.mean_mm, 5 * fine.spacing_mm) << "what corners alone do not see";
  }
  // Beyond 250,000 samples the lattice is coarser than asked for.
  EXPECT_GT(distances(icosahedron, ball, {0.01, 0.05}).forth.spacing_mm, 0.05);
}

TEST(MeasureDistances, OfEqualSurfacesAreNoneAndSure) {
  const SurfaceMesh ball = sphere({0, 0, 0}, 10, 3, 1, 0);
  const SurfaceDistances found = distances(ball, ball, {0.5, 0.01});
  EXPECT_NEAR(found.forth.max_mm, 0, 1e-12);
  EXPECT_LE(found.forth.uncertainty_mm, 0.01);
}

TEST(MeasureDistances, AreThoseOfTheSameLabel) {
  const auto two = [](Label left, Label right) {
    SurfaceMesh balls = sphere({0, 0, 0}, 5, 2, left, 0);
    test::append(balls, sphere({30, 0, 0}, 5, 2, right, 0));
    return balls;
  };
  EXPECT_NEAR(distances(two(1, 2), two(1, 2), {1, 0.1}).forth.max_mm, 0, 1e-12);
  EXPECT_NEAR(distances(two(1, 2), two(2, 1), {1, 0.1}).forth.max_mm, 30, 0.1);
  EXPECT_NEAR(distances(two(1, 2), two(1, 3), {1, 0.1}).forth.max_mm, 0, 1e-12)
      << "a label that the other lacks is measured to all of it";
}

TEST(MeasureDistances, KeepsTheNumberOfSamplesInBounds) {
  const SurfaceMesh inner = sphere({0, 0, 0}, 10, 2, 1, 0), outer = sphere({0, 0, 0}, 11, 2, 1, 0);
  const DistanceSummary fine = distances(inner, outer, {1e-3, 0.05}).forth;
  EXPECT_LE(fine.samples, 260'000U);
  EXPECT_GT(fine.samples, 200'000U);
}

TEST(MeasureDistances, AreZeroWithoutTriangles) {
  EXPECT_EQ(distances({}, sphere({0, 0, 0}, 1, 1, 1, 0), {}).back.samples, 0U);
}

TEST(MeasureDistances, StopWhenCancelled) {
  const SurfaceMesh inner = sphere({0, 0, 0}, 10, 2, 1, 0), outer = sphere({0, 0, 0}, 11, 2, 1, 0);
  for (const int after : {0, 2, 6}) {
    RunContext ctx;
    int asked = 0;
    ctx.on_cancelled = [&] { return asked++ >= after; };
    const Result<SurfaceDistances> found =
        measure_distances({inner.points, inner.triangles, inner.sides},
                          {outer.points, outer.triangles, outer.sides}, {0.2, 0.05}, ctx);
    ASSERT_FALSE(found.ok()) << after;
    EXPECT_EQ(found.error().code, ErrorCode::kCancelled);
    EXPECT_EQ(asked, after + 1) << "soon after";
  }
}

std::vector<float> distances_of_points(const SurfaceMesh& a, const SurfaceMesh& b) {
  RunContext ctx;
  DistanceMeasurement distances({a.points, a.triangles, a.sides}, {b.points, b.triangles, b.sides}, {}, ctx);
  distances.measure(0);
  return distances.of_points();
}

TEST(DistancesOfPoints, AreToTheSameLabelTheLargestOfASharedPointAndNoneOffTheSurface) {
  SurfaceMesh inner = sphere({0, 0, 0}, 5, 3, 1, 2), balls = sphere({0, 0, 0}, 6, 4, 1, 0);
  test::append(balls, sphere({0, 0, 0}, 8, 4, 2, 0));
  inner.points.emplace_back(0, 0, 0);
  const std::vector<float> found = distances_of_points(inner, balls);
  ASSERT_EQ(found.size(), inner.points.size());
  for (std::size_t v = 0; v + 1 < found.size(); ++v) EXPECT_NEAR(found[v], 3, 0.05);
  EXPECT_TRUE(std::isnan(found.back()));
}

TEST(DistancesOfPoints, AreNoneWithoutASurfaceToMeasureTo) {
  const SurfaceMesh ball = sphere({0, 0, 0}, 5, 1, 1, 0), none;
  const std::vector<float> found = distances_of_points(ball, none);
  EXPECT_EQ(found.size(), ball.points.size());
  for (const float distance : found) EXPECT_TRUE(std::isnan(distance));
}

}  // namespace
}  // namespace voxtet
