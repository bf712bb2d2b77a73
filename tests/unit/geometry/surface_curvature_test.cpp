#include "geometry/elements/surface_curvature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "support/label_bodies.h"
#include "support/label_surface.h"

namespace voxtet {
namespace {

using Eigen::Vector3d;

/// A body's smoothed label surface, and the curvature of its true surface at a place near that.
struct Bent {
  SurfaceMesh surface;
  std::function<double(const Vector3d&)> truth;
};

Bent ball(double radius) {
  const int n = static_cast<int>(2 * radius) + 9;
  return {test::label_surface(test::ball_volume(n, n / 2.0, radius)),
          [=](const Vector3d&) { return 1 / radius; }};
}

/// A tube bent to a ring: its own curvature is the larger one where it is thinner than half the ring.
Bent torus(double big, double small) {
  const int n = static_cast<int>(2 * (big + small)) + 9, height = static_cast<int>(2 * small) + 9;
  const double c = n / 2.0, middle = height / 2.0;
  return {
      test::label_surface(test::make_volume(
          n, n, height,
          [=](int i, int j, int k) { return test::in_torus(i - c, j - c, k - middle, big, small) ? 1 : 0; })),
      [=](const Vector3d&) { return 1 / small; }};
}

/// An ellipsoid of revolution about z, half axes `across` and `along`, the longer one along.
Bent ellipsoid(double across, double along) {
  const int n = static_cast<int>(2 * across) + 9, height = static_cast<int>(2 * along) + 9;
  const Vector3d middle(n / 2.0, n / 2.0, height / 2.0);
  const auto level = [=](const Vector3d& p) {
    return ((p - middle).array() / Vector3d(across, across, along).array()).matrix().squaredNorm();
  };
  const auto truth = [=](const Vector3d& p) {
    const double z = std::clamp((p - middle).z() / along, -1.0, 1.0), r2 = 1 - z * z;
    const double metric = std::sqrt(along * along * r2 + across * across * z * z);
    return std::max(along / (across * metric), across * along / (metric * metric * metric));
  };
  return {test::label_surface(test::make_volume(
              n, n, height, [=](int i, int j, int k) { return level(Vector3d(i, j, k)) <= 1 ? 1 : 0; })),
          truth};
}

/// Found over true curvature at all points: median, and the largest part by which 95 % of them are off.
struct Accuracy {
  double median = 0, p95 = 0;
};

Accuracy accuracy_of(const Bent& body) {
  const std::vector<float> found = surface_curvature(body.surface, 2);
  std::vector<double> ratios, errors;
  for (std::size_t p = 0; p < found.size(); ++p) {
    ratios.push_back(found[p] / body.truth(body.surface.points[p]));
    errors.push_back(std::abs(ratios.back() - 1));
  }
  std::sort(ratios.begin(), ratios.end());
  std::sort(errors.begin(), errors.end());
  return {ratios[ratios.size() / 2], errors[errors.size() * 95 / 100]};
}

void expect_near(const Bent& body, double p95) {
  const Accuracy accuracy = accuracy_of(body);
  EXPECT_NEAR(accuracy.median, 1, 0.05);
  EXPECT_LE(accuracy.p95, p95);
}

TEST(SurfaceCurvature, IsThatOfSmoothedBalls) {
  expect_near(ball(5), 0.05);
  expect_near(ball(8), 0.05);
  expect_near(ball(15), 0.1);
  expect_near(ball(30), 0.3);
}

TEST(SurfaceCurvature, IsThatOfASmoothedTorus) {
  expect_near(torus(18, 6), 0.1);
  expect_near(torus(30, 10), 0.15);
}

TEST(SurfaceCurvature, FollowsThatOfASmoothedEllipsoid) {
  expect_near(ellipsoid(8, 16), 0.25);
  expect_near(ellipsoid(12, 30), 0.25);
}

TEST(SurfaceCurvature, OfAFlatSheetIsNone) {
  SurfaceMesh sheet;
  sheet.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  sheet.sides.assign(2, {1, 0});
  for (const float k : surface_curvature(sheet, 1)) EXPECT_EQ(k, 0.F);
}

}  // namespace
}  // namespace voxtet
