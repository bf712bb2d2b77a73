// Points of a surface spread along it.
#include "remesh/delaunay/relax_surface.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "geometry/elements/triangle_measures.h"
#include "support/test_random.h"
#include "support/test_surfaces.h"
#include "surface_report.h"

namespace voxtet::remesh {
namespace {

using Eigen::Vector3d;

double mean_radius_ratio(const SurfaceMesh& surface) {
  double sum = 0;
  for (const auto& [a, b, c] : surface.triangles)
    sum += measure_triangle({surface.points[a], surface.points[b], surface.points[c]}).radius_ratio;
  return sum / static_cast<double>(surface.triangles.size());
}

/// A sphere whose points are shaken along it.
SurfaceMesh shaken_sphere(double radius) {
  SurfaceMesh surface = test::sphere({1, 2, 3}, radius, 4, 1, 0);
  const double edge = 1.13 * radius / 16;
  test::TestRandom random(9);
  for (Vector3d& p : surface.points) {
    for (int d = 0; d < 3; ++d) p[d] += 0.3 * edge * (random.below(1001) / 500.0 - 1);
    p = Vector3d(1, 2, 3) + radius * (p - Vector3d(1, 2, 3)).normalized();
  }
  return surface;
}

TEST(RelaxSurface, EvensOutSizesAndShapesAlongTheSurface) {
  const SurfaceMesh before = shaken_sphere(12);
  SurfaceMesh after = before;
  const SizingField sizing = test::uniform_sizing(0.85);
  relax_surface(after, sizing);
  EXPECT_EQ(after.triangles, before.triangles);
  EXPECT_GT(mean_radius_ratio(after), mean_radius_ratio(before) + 0.05);
  EXPECT_GT(mean_radius_ratio(after), 0.95);
  const test::SurfaceReport was = test::report_on(before, sizing), is = test::report_on(after, sizing);
  EXPECT_GE(is.least_planar_deg, std::min(was.least_planar_deg, 29.25) - 1e-9);
  EXPECT_LT(is.size_p95 - is.size_p5, 0.6 * (was.size_p95 - was.size_p5));
  for (const Vector3d& p : after.points) EXPECT_NEAR((p - Vector3d(1, 2, 3)).norm(), 12, 0.1);
}

TEST(RelaxSurface, FollowsTheTargetSizes) {
  SurfaceMesh surface = test::sphere({0, 0, 0}, 12, 4, 1, 0);
  const SizingField sizing = test::sampled_sizing(
      {-14, -14, -14}, {14, 14, 14}, 1, [](const Vector3d& p) { return 0.85 * (1 + 0.02 * p.z()); });
  const double before = test::report_on(surface, sizing).size_p95 - test::report_on(surface, sizing).size_p5;
  relax_surface(surface, sizing);
  EXPECT_LT(test::report_on(surface, sizing).size_p95 - test::report_on(surface, sizing).size_p5, before);
}

TEST(RelaxSurface, LeavesPointsOfCreasesAndJunctions) {
  // Two cubes side by side.
  SurfaceMesh cubes = test::cells({6, 3, 3}, 1, [](int x, int, int) { return x < 3 ? Label{1} : Label{2}; });
  for (Vector3d& p : cubes.points)  // the middles of the faces are not in the middle
    for (int d = 0; d < 3; ++d)
      if (p[d] == 1) p[d] = 0.8;
  const SurfaceMesh before = cubes;
  relax_surface(cubes, test::uniform_sizing(1));
  std::size_t moved = 0;
  for (std::size_t p = 0; p < cubes.points.size(); ++p) {
    const Vector3d shift = cubes.points[p] - before.points[p];
    if (shift.isZero(0)) continue;
    ++moved;
    std::vector<Sides> sides;
    for (std::size_t t = 0; t < cubes.triangles.size(); ++t)
      if (std::find(cubes.triangles[t].begin(), cubes.triangles[t].end(), p) != cubes.triangles[t].end())
        sides.push_back(cubes.sides[t]);
    for (const Sides& s : sides) EXPECT_EQ(s, sides.front());
    EXPECT_NEAR(shift.cwiseAbs().minCoeff(), 0, 1e-12);  // in the plane of its face
  }
  EXPECT_GT(moved, 0U);
}

}  // namespace
}  // namespace voxtet::remesh
