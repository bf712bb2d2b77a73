// Surfaces of interpolated slices, smoothed.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "extracted.h"
#include "geometry/elements/surface_measures.h"
#include "smoothed.h"
#include "support/check_surface.h"
#include "support/label_bodies.h"
#include "volume/stack/interpolate_slices.h"

namespace voxtet {
namespace {

/// A ball of 30 mm in slices of 8 mm with pixels of 1.4 mm.
struct ThickBall {
  Eigen::Vector3d centre{38.2, 38.6, 51};
  LabelVolume slices, fine;
  SurfaceMesh raw;
  std::array<int, 3> planes{1, 1, 1};

  ThickBall() {
    const Eigen::Vector3d spacing(1.4, 1.4, 8);
    slices = test::make_volume(56, 56, 14, [&](int i, int j, int k) {
      return (spacing.cwiseProduct(Eigen::Vector3d(i, j, k)) - centre).norm() < 30;
    });
    slices.index_to_mm.diagonal().head<3>() = spacing;
    fine = interpolate_slices(slices, 2, {}).value();
    planes[2] = fine.size[2] / slices.size[2];
    raw = test::extract(fine, ExtractMethod::kMarchingCubes);
  }

  SurfaceMesh smoothed(const std::array<int, 3>& of_slice) const {
    RunContext ctx;
    SmoothParams params;
    params.iterations = 100;
    params.slice_share = 0.4;
    return smooth_surface(raw, fine, params, ctx, {}, of_slice).value();
  }

  /// Root mean square angle between the triangles' normals and the sphere's, degrees.
  double normal_error(const SurfaceMesh& surface) const {
    double sum = 0, area = 0;
    for (const auto& [a, b, c] : surface.triangles) {
      const Eigen::Vector3d &p = surface.points[a], &q = surface.points[b], &r = surface.points[c];
      const Eigen::Vector3d cross = (q - p).cross(r - p), out = (p + q + r) / 3 - centre;
      const double angle = std::acos(std::min(1.0, std::abs(cross.normalized().dot(out.normalized()))));
      sum += cross.norm() * angle * angle;
      area += cross.norm();
    }
    return std::sqrt(sum / area) * 180 / 3.14159265358979;
  }
};

TEST(SmoothThickSlices, TakesTheStepsBetweenSlicesAway) {
  const ThickBall ball;
  EXPECT_LT(ball.normal_error(ball.smoothed(ball.planes)), ball.normal_error(ball.smoothed({1, 1, 1})));
}

TEST(SmoothThickSlices, MovesAlongTheStackButNotFartherInThePlane) {
  const ThickBall ball;
  const SurfaceMesh surface = ball.smoothed(ball.planes);
  EXPECT_TRUE(test::is_valid_surface(surface));
  const Eigen::Vector3d voxel = ball.fine.spacing_mm();
  Eigen::Vector3d most = Eigen::Vector3d::Zero();
  for (std::size_t v = 0; v < surface.points.size(); ++v)
    most = most.cwiseMax((surface.points[v] - ball.raw.points[v]).cwiseQuotient(voxel).cwiseAbs());
  EXPECT_LE(most.x(), 0.5 + 1e-9);
  EXPECT_LE(most.y(), 0.5 + 1e-9);
  EXPECT_GT(most.z(), 0.5);
  EXPECT_LE(most.z(), 0.2 * ball.planes[2] + 1e-9);
  const double voxels = test::label_counts(ball.fine)[1] * ball.fine.voxel_mm3();
  EXPECT_NEAR(enclosed_volume_mm3(surface, 1), voxels, 0.003 * voxels);
}

}  // namespace
}  // namespace voxtet
