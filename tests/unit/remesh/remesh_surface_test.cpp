// The adapted surface of small bodies: closed, conforming, well shaped, of the target size, and the same
// every time.
#include "remesh/remesh_surface.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/digest.h"
#include "geometry/intersect/self_intersections.h"
#include "support/check_surface.h"
#include "support/label_bodies.h"
#include "support/label_surface.h"
#include "support/test_random.h"
#include "support/test_surfaces.h"
#include "surface_report.h"

namespace voxtet {
namespace {

using Eigen::Vector3d;

constexpr double kLeastPlanarDeg = 29.2;

SurfaceMesh remesh(const LabelVolume& volume, const SizingField& sizing, const RemeshParams& params = {}) {
  RunContext ctx;
  Result<SurfaceMesh> result = remesh_surface(volume, test::label_surface(volume), sizing, params, ctx);
  EXPECT_TRUE(result.ok()) << result.error().message;
  return result.ok() ? std::move(*result) : SurfaceMesh{};
}

LabelVolume ball(int n, double radius, const Eigen::Matrix4d& affine) {
  LabelVolume volume = test::ball_volume(n, 0.5 * (n - 1), radius);
  volume.index_to_mm = affine;
  return volume;
}

Eigen::Matrix4d affine_of(const Eigen::Matrix3d& linear, const Vector3d& origin) {
  Eigen::Matrix4d affine = Eigen::Matrix4d::Identity();
  affine.topLeftCorner<3, 3>() = linear;
  affine.topRightCorner<3, 1>() = origin;
  return affine;
}

double volume_of(const SurfaceMesh& surface, Label label) {
  const std::vector<Label> labels = test::labels_of(surface);
  const std::vector<test::LabelTopology> found = test::label_topologies(surface);
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (labels[i] == label) return found[i].volume_mm3;
  return 0;
}

TEST(RemeshSurface, GivesARoundClosedSphereOfTheTargetSize) {
  constexpr double kRadius = 12.3;
  const LabelVolume volume = ball(32, kRadius, Eigen::Matrix4d::Identity());
  for (const double h : {1.2, 1.6, 2.0}) {
    const SizingField sizing = test::uniform_sizing(h);
    const SurfaceMesh surface = remesh(volume, sizing);
    ASSERT_TRUE(test::is_valid_surface(surface)) << h;
    const auto topology = test::label_topologies(surface);
    ASSERT_EQ(topology.size(), 1U);
    EXPECT_EQ(topology[0].euler(), 2) << h;
    EXPECT_EQ(topology[0].components, 1U) << h;
    const test::SurfaceReport report = test::report_on(surface, sizing);
    EXPECT_GE(report.least_planar_deg, kLeastPlanarDeg) << h;
    EXPECT_NEAR(report.size_median, 0, 0.05) << h;
    EXPECT_LE(report.size_p95, 0.5) << h;
    double farthest = 0;
    for (const Vector3d& p : surface.points)
      farthest = std::max(farthest, std::abs((p - Vector3d::Constant(15.5)).norm() - kRadius));
    EXPECT_LE(farthest, 0.6) << h;
    EXPECT_EQ(find_self_intersections(surface, 1).size(), 0U) << h;
  }
}

TEST(RemeshSurface, OverrulesTheSizeOnlyWhereTheDistanceDemands) {
  const LabelVolume volume = ball(32, 12.3, Eigen::Matrix4d::Identity());
  const SizingField sizing = test::uniform_sizing(3);
  RemeshParams loose;
  loose.max_distance_voxels = 0.5;
  EXPECT_NEAR(test::report_on(remesh(volume, sizing, loose), sizing).size_median, 0, 0.05);
  RemeshParams tight;
  tight.max_distance_voxels = 0.05;
  const SurfaceMesh surface = remesh(volume, sizing, tight);
  EXPECT_LT(test::report_on(surface, sizing).size_median, -0.5);
  EXPECT_TRUE(test::is_valid_surface(surface));
}

TEST(RemeshSurface, FollowsAGradedSizingField) {
  const LabelVolume volume = ball(44, 18, Eigen::Matrix4d::Identity());
  const SizingField sizing = test::sampled_sizing({-2, -2, -2}, {46, 46, 46}, 1, [](const Vector3d& p) {
    return std::clamp(1.2 + 0.06 * (p.x() - 6), 1.2, 3.0);
  });
  const SurfaceMesh surface = remesh(volume, sizing);
  ASSERT_TRUE(test::is_valid_surface(surface));
  const test::SurfaceReport report = test::report_on(surface, sizing);
  EXPECT_NEAR(report.size_median, 0, 0.05);
  EXPECT_GE(report.size_p5, -0.75);
  EXPECT_LE(report.size_p95, 0.55);
  EXPECT_GE(report.least_planar_deg, kLeastPlanarDeg);
  EXPECT_EQ(find_self_intersections(surface, 1).size(), 0U);
}

TEST(RemeshSurface, KeepsNestedAndTouchingLabelsClosedAndConforming) {
  const auto box = [](int i, int j, int k, int lo, int hi) {
    return i >= lo && i <= hi && j >= lo && j <= hi && k >= lo && k <= hi;
  };
  const LabelVolume nested = test::make_volume(28, 28, 28, [&](int i, int j, int k) {
    return box(i, j, k, 10, 17) ? 7 : box(i, j, k, 4, 23) ? 3 : 0;
  });
  const LabelVolume touching = test::make_volume(
      28, 28, 28, [&](int i, int j, int k) { return box(i, j, k, 5, 22) ? (i < 13 ? 1 : 9) : 0; });
  const LabelVolume three = test::make_volume(28, 28, 28, [&](int i, int j, int k) {
    return box(i, j, k, 5, 22) ? (i < 13 ? 1 : j < 14 ? 2 : 40000) : 0;
  });
  const SizingField sizing = test::uniform_sizing(2);
  for (const LabelVolume& volume : {nested, touching, three}) {
    const SurfaceMesh surface = remesh(volume, sizing);
    ASSERT_TRUE(test::is_valid_surface(surface));
    EXPECT_EQ(find_self_intersections(surface, 1).size(), 0U);
    const test::SurfaceReport report = test::report_on(surface, sizing);
    EXPECT_GE(report.least_planar_deg, 25);
    EXPECT_GE(report.least_dihedral_deg, 25);
    // Smoothing rounds the boxes' edges: at most 0.45 mm^3 a millimetre of edge, here an eighth of the
    // smallest box.
    const std::vector<double> counts = test::label_counts(volume);
    for (const Label label : test::labels_of(surface))
      EXPECT_NEAR(volume_of(surface, label) / counts[label], 1, counts[label] < 1000 ? 0.125 : 0.05) << label;
    EXPECT_EQ(test::labels_of(surface).size(),
              static_cast<std::size_t>(
                  std::count_if(counts.begin() + 1, counts.end(), [](double c) { return c > 0; })));
  }
}

TEST(RemeshSurface, LosesNoneOfFortySmallBalls) {
  LabelVolume volume = test::make_volume(50, 50, 20, [](int, int, int) { return 0; });
  int balls = 0;
  for (int b = 0; b < 40; ++b, ++balls) {
    const int ci = 5 + 10 * (b % 5), cj = 5 + 10 * (b / 5 % 4), ck = b < 20 ? 4 : 14;
    for (int k = ck - 2; k <= ck + 2; ++k)
      for (int j = cj - 2; j <= cj + 2; ++j)
        for (int i = ci - 2; i <= ci + 2; ++i)
          if ((i - ci) * (i - ci) + (j - cj) * (j - cj) + (k - ck) * (k - ck) <= 5)
            volume.labels[volume.offset(i, j, k)] = 4;
  }
  for (const double h : {1.2, 3.0, 5.0}) {
    const SurfaceMesh surface = remesh(volume, test::uniform_sizing(h));
    ASSERT_TRUE(test::is_valid_surface(surface));
    const auto topology = test::label_topologies(surface);
    ASSERT_EQ(topology.size(), 1U);
    EXPECT_EQ(topology[0].components, 40U) << h;
    EXPECT_EQ(topology[0].euler(), 80) << h;
  }
}

TEST(RemeshSurface, KeepsAWallOfOneVoxelWhole) {
  // A spherical shell one to two voxels thick: two sheets, no hole.
  const LabelVolume volume = test::make_volume(40, 40, 40, [](int i, int j, int k) {
    const double r = std::sqrt((i - 19.5) * (i - 19.5) + (j - 19.5) * (j - 19.5) + (k - 19.5) * (k - 19.5));
    return r <= 15.2 && r > 13.7 ? 2 : 0;
  });
  const SurfaceMesh surface = remesh(volume, test::uniform_sizing(2));
  ASSERT_TRUE(test::is_valid_surface(surface));
  const auto topology = test::label_topologies(surface);
  EXPECT_EQ(topology[0].components, 2U);
  EXPECT_EQ(topology[0].euler(), 4);
  EXPECT_EQ(find_self_intersections(surface, 1).size(), 0U);
}

TEST(RemeshSurface, KeepsLabelsOfOneVoxelAndLinesOfVoxels) {
  const LabelVolume volume = test::make_volume(24, 24, 24, [](int i, int j, int k) {
    if (i == 6 && j == 6 && k == 6) return 3;
    if (j == 16 && k == 16 && i >= 3 && i <= 20) return 5;
    return i >= 2 && i < 22 && j >= 2 && j < 22 && k >= 2 && k < 22 ? 1 : 0;
  });
  const SurfaceMesh surface = remesh(volume, test::uniform_sizing(2.5));
  ASSERT_TRUE(test::is_valid_surface(surface));
  EXPECT_EQ(test::labels_of(surface), (std::vector<Label>{1, 3, 5}));
  const auto topology = test::label_topologies(surface);
  EXPECT_EQ(topology[1].components, 1U);
  EXPECT_EQ(topology[2].components, 1U);
  EXPECT_EQ(topology[2].euler(), 2);
}

TEST(RemeshSurface, TakesFewRingsOfThreeAroundALineOfVoxels) {
  // No edge around the line can be as long as is asked for; those along it can be longer.
  const LabelVolume volume = test::make_volume(
      44, 14, 14, [](int i, int j, int k) { return j == 6 && k == 6 && i >= 2 && i < 42 ? 1 : 0; });
  for (const auto& [edge_mm, most] : {std::pair{3.0, 112U}, std::pair{5.0, 104U}}) {
    const SurfaceMesh surface = remesh(volume, test::uniform_sizing(edge_mm));
    ASSERT_TRUE(test::is_valid_surface(surface)) << edge_mm;
    EXPECT_TRUE(find_self_intersections(surface, 1).empty()) << edge_mm;
    EXPECT_EQ(test::label_topologies(surface)[0].euler(), 2) << edge_mm;
    EXPECT_LT(surface.triangles.size(), most) << edge_mm;
    EXPECT_GE(test::report_on(surface, test::uniform_sizing(edge_mm)).least_planar_deg, kLeastPlanarDeg);
  }
}

TEST(RemeshSurface, WorksInMirroredObliqueAndAnisotropicFrames) {
  Eigen::Matrix3d turned = Eigen::AngleAxisd(0.9, Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();
  Eigen::Matrix3d mirrored = turned * Vector3d(0.8, -0.8, 0.8).asDiagonal();
  Eigen::Matrix3d slices = turned * Vector3d(1.4, 1.4, 5).asDiagonal();
  for (const Eigen::Matrix3d& linear : {mirrored, slices}) {
    const Vector3d spacing = linear.colwise().norm().transpose();
    const double radius = 14;
    const Vector3d origin(100, -40, 7);
    LabelVolume volume = test::make_volume(44, 44, 44, [&](int i, int j, int k) {
      return spacing.cwiseProduct(Vector3d(i - 21.5, j - 21.5, k - 21.5)).norm() <= radius ? 6 : 0;
    });
    volume.index_to_mm = affine_of(linear, origin);
    const Vector3d centre = volume.to_mm(Vector3d::Constant(21.5));
    const SizingField sizing = test::uniform_sizing(3);
    const SurfaceMesh surface = remesh(volume, sizing);
    ASSERT_TRUE(test::is_valid_surface(surface));
    EXPECT_EQ(test::label_topologies(surface)[0].euler(), 2);
    EXPECT_EQ(find_self_intersections(surface, 1).size(), 0U);
    EXPECT_GE(test::report_on(surface, sizing).least_planar_deg, kLeastPlanarDeg);
    const double voxels = test::label_counts(volume)[6] * volume.voxel_mm3();
    EXPECT_NEAR(volume_of(surface, 6) / voxels, 1, spacing.maxCoeff() > 2 ? 0.05 : 0.025);
    for (const Vector3d& p : surface.points)
      EXPECT_LE(std::abs((p - centre).norm() - radius), spacing.maxCoeff());
  }
}

TEST(RemeshSurface, MeshesLabelsThatTouchTheBorderOfTheImage) {
  const LabelVolume volume = test::make_volume(12, 12, 12, [](int i, int, int) { return i < 6 ? 1 : 2; });
  const SurfaceMesh surface = remesh(volume, test::uniform_sizing(2));
  ASSERT_TRUE(test::is_valid_surface(surface));
  // Half of the box's edges and the rim of the interface are rounded.
  EXPECT_NEAR(volume_of(surface, 1), 6 * 12 * 12, 60);
  EXPECT_NEAR(volume_of(surface, 2), 6 * 12 * 12, 60);
}

TEST(RemeshSurface, GivesTheSameBytesOnEveryRunAndPlatform) {
  const LabelVolume volume = test::heart_volume(48, 40, 40);
  const SizingField sizing = test::uniform_sizing(2);
  const std::string first = digest_of(remesh(volume, sizing));
  EXPECT_EQ(digest_of(remesh(volume, sizing)), first);
  EXPECT_EQ(first, "64784c90e7ffdb4d9acbb931da4374ef4438303c641b4d096f4acf7598c2cab3");
}

/// Smooth random blobs: the argmax of a few random cosines per label.
LabelVolume blobs(int n, int labels, std::uint64_t seed) {
  test::TestRandom random(seed);
  const auto real = [&] { return random.below(1 << 20) / static_cast<double>(1 << 20); };
  std::vector<std::vector<std::array<double, 5>>> waves(static_cast<std::size_t>(labels) + 1);
  for (auto& label : waves)
    for (int w = 0; w < 5; ++w)
      label.push_back({real() - 0.5, real() - 0.5, real() - 0.5, 6.28 * real(), real()});
  return test::make_volume(n, n, n, [&](int i, int j, int k) {
    int best = 0;
    double best_value = -1e9;
    for (int l = 0; l <= labels; ++l) {
      double value = 0;
      for (const auto& w : waves[static_cast<std::size_t>(l)])
        value += w[4] * std::cos(w[0] * i + w[1] * j + w[2] * k + w[3]);
      if (value > best_value) {
        best_value = value;
        best = l;
      }
    }
    return best;
  });
}

class RemeshBlobs : public ::testing::TestWithParam<int> {};

TEST_P(RemeshBlobs, StayClosedConformingAndFreeOfIntersections) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  const int labels = 1 + GetParam() % 4;
  const LabelVolume volume = blobs(22, labels, seed);
  const SizingField sizing = test::uniform_sizing(1.2 + 0.2 * (GetParam() % 8));
  const SurfaceMesh reference = test::label_surface(volume);
  std::string method;
  RunContext ctx;
  ctx.on_note = [&](const std::string&, const std::string& message) { method = message; };
  RemeshParams params;
  params.keep_topology = KeepTopology::kLabels;
  const Result<SurfaceMesh> made = remesh_surface(volume, reference, sizing, params, ctx);
  ASSERT_TRUE(made.ok()) << made.error().message;
  const SurfaceMesh& surface = *made;
  ASSERT_TRUE(test::is_valid_surface(surface));
  EXPECT_EQ(test::labels_of(surface), test::labels_of(reference));
  EXPECT_EQ(find_self_intersections(surface, 1).size(), 0U);
  const test::SurfaceReport report = test::report_on(surface, sizing);
  EXPECT_GE(report.least_planar_deg, 17);
  EXPECT_GE(report.least_dihedral_deg, 15);
  RecordProperty("method", method);
  RecordProperty("planar_deg", std::to_string(report.least_planar_deg));
  RecordProperty("dihedral_deg", std::to_string(report.least_dihedral_deg));
}

// Most of them natively only (CMakePresets.json).
INSTANTIATE_TEST_SUITE_P(Seeds, RemeshBlobs, ::testing::Range(0, 40));

TEST(RemeshSurface, RefusesMalformedInputInWords) {
  RunContext ctx;
  const LabelVolume good = test::ball_volume(12, 5.5, 4);
  const SizingField sizing = test::uniform_sizing(2);
  SurfaceMesh reference = test::label_surface(good);
  const auto code = [&](const LabelVolume& volume, const SizingField& field, const RemeshParams& params) {
    const Result<SurfaceMesh> result = remesh_surface(volume, reference, field, params, ctx);
    EXPECT_FALSE(result.ok());
    if (result.ok()) return ErrorCode::kInternal;
    EXPECT_EQ(result.error().stage, "remesh");
    EXPECT_FALSE(result.error().message.empty());
    return result.error().code;
  };
  LabelVolume empty = good;
  std::fill(empty.labels.begin(), empty.labels.end(), Label{0});
  EXPECT_EQ(code(empty, sizing, {}), ErrorCode::kBadInput);
  LabelVolume shorter = good;
  shorter.labels.pop_back();
  EXPECT_EQ(code(shorter, sizing, {}), ErrorCode::kBadInput);
  LabelVolume singular = good;
  singular.index_to_mm(0, 0) = 0;
  EXPECT_EQ(code(singular, sizing, {}), ErrorCode::kBadInput);
  SizingField zero = sizing;
  zero.h_mm[0] = 0;
  EXPECT_EQ(code(good, zero, {}), ErrorCode::kBadInput);
  RemeshParams steep;
  steep.facet_angle_deg = 35;
  EXPECT_EQ(code(good, sizing, steep), ErrorCode::kBadInput);
  RemeshParams close;
  close.max_distance_voxels = 0;
  EXPECT_EQ(code(good, sizing, close), ErrorCode::kBadInput);
  RemeshParams heavy;
  heavy.shape_weight = 1.1;
  EXPECT_EQ(code(good, sizing, heavy), ErrorCode::kBadInput);
  const SurfaceMesh whole = reference;
  reference.triangles[3][1] = static_cast<std::uint32_t>(reference.points.size());
  EXPECT_EQ(code(good, sizing, {}), ErrorCode::kBadInput);
  reference = whole;
  reference.sides.pop_back();
  EXPECT_EQ(code(good, sizing, {}), ErrorCode::kBadInput);
  reference = whole;
  reference.points[0][2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code(good, sizing, {}), ErrorCode::kBadInput);
  reference = whole;
  reference.sides.assign(whole.sides.size(), {7, 0});
  EXPECT_EQ(code(good, sizing, {}), ErrorCode::kBadInput);
  reference = {};
  EXPECT_EQ(code(good, sizing, {}), ErrorCode::kBadInput);
}

TEST(RemeshSurface, StopsWhenCancelledAndReportsRisingProgress) {
  const LabelVolume volume = test::ball_volume(40, 19.5, 16);
  const SizingField sizing = test::uniform_sizing(1);
  RunContext ctx;
  int polls = 0;
  ctx.on_cancelled = [&] { return ++polls > 5; };
  const SurfaceMesh reference = test::label_surface(volume);
  const Result<SurfaceMesh> stopped = remesh_surface(volume, reference, sizing, {}, ctx);
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().code, ErrorCode::kCancelled);

  RunContext watching;
  double last = 0;
  int calls = 0;
  watching.on_progress = [&](const std::string& stage, double fraction) {
    EXPECT_EQ(stage, "remesh");
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    last = fraction;
    ++calls;
  };
  ASSERT_TRUE(remesh_surface(volume, reference, sizing, {}, watching).ok());
  EXPECT_EQ(last, 1);
  EXPECT_GE(calls, 5);
}

}  // namespace
}  // namespace voxtet
