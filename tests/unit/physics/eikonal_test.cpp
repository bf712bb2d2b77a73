#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/digest.h"
#include "physics/eikonal/solve_eikonal.h"
#include "support/labelled_mesh.h"
#include "support/slab_wall.h"
#include "support/uniform_tissue.h"

namespace voxtet {
namespace {

const Eigen::Vector3d kAlongX(1, 0, 0);
const Eigen::Vector3d kAskew = Eigen::Vector3d(3, -2, 1).normalized();
const Eigen::Vector3d kCubeMiddle(-5, 20, 3);  ///< of test::kuhn_cube

/// sqrt(d . C^-1 d), by the inverse of C as it is defined.
double travel_time(const Eigen::Vector3d& d, double along, double across, const Eigen::Vector3d& fibre) {
  const Eigen::Matrix3d on_fibre = fibre * fibre.transpose();
  const Eigen::Matrix3d c =
      along * along * on_fibre + across * across * (Eigen::Matrix3d::Identity() - on_fibre);
  return std::sqrt(d.dot(c.inverse() * d));
}

std::vector<double> solved(const TetMesh& mesh, const Tissue& tissue,
                           const std::vector<EikonalSource>& sources) {
  RunContext ctx;
  auto times = solve_eikonal(mesh, tissue, sources, ctx);
  EXPECT_TRUE(times.ok()) << (times.ok() ? "" : times.error().message);
  return times.ok() ? *std::move(times) : std::vector<double>(mesh.points.size());
}

template <class IsSource, class TimeAt>
std::vector<EikonalSource> sources_where(const TetMesh& mesh, const IsSource& is_source,
                                         const TimeAt& time_at) {
  std::vector<EikonalSource> sources;
  for (std::uint32_t i = 0; i < mesh.points.size(); ++i)
    if (is_source(mesh.points[i])) sources.push_back({i, time_at(mesh.points[i])});
  return sources;
}

/// Mean and greatest error.
struct ArrivalErrors {
  double mean = 0, greatest = 0;
};

template <class TimeAt>
ArrivalErrors errors_of(const TetMesh& mesh, const std::vector<double>& times, const TimeAt& time_at) {
  ArrivalErrors errors;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double error = std::abs(times[i] - time_at(mesh.points[i]));
    errors.mean += error / static_cast<double>(times.size());
    errors.greatest = std::max(errors.greatest, error);
  }
  return errors;
}

/// Of a wave from the middle of a cube of n cells along each edge, with exact times up to 2 mm from it.
ArrivalErrors ball_errors(std::uint32_t n, double along, double across, const Eigen::Vector3d& fibre) {
  const TetMesh mesh = test::kuhn_cube(n);
  const auto exact = [&](const Eigen::Vector3d& p) {
    return travel_time(p - kCubeMiddle, along, across, fibre);
  };
  const auto in_ball = [](const Eigen::Vector3d& p) { return (p - kCubeMiddle).norm() <= 2; };
  const auto times =
      solved(mesh, test::uniform_tissue(mesh, along, across, fibre), sources_where(mesh, in_ball, exact));
  return errors_of(mesh, times, exact);
}

void expect_first_order(double along, double across, const Eigen::Vector3d& fibre) {
  const ArrivalErrors coarse = ball_errors(6, along, across, fibre);
  const ArrivalErrors middle = ball_errors(12, along, across, fibre);
  const ArrivalErrors fine = ball_errors(24, along, across, fibre);
  EXPECT_NEAR(coarse.greatest / middle.greatest, 2, 0.2);
  EXPECT_NEAR(middle.greatest / fine.greatest, 2, 0.2);
  EXPECT_GT(coarse.mean / middle.mean, 2);
  EXPECT_GT(middle.mean / fine.mean, 2);
}

TEST(Eikonal, IsOfFirstOrderWithoutFibres) {
  expect_first_order(0.5, 0.5, kAlongX);
}

TEST(Eikonal, IsOfFirstOrderWithFibresAlongAnAxis) {
  expect_first_order(0.5, 0.2, kAlongX);
}

TEST(Eikonal, IsOfFirstOrderWithFibresInAnyDirection) {
  expect_first_order(0.5, 0.2, kAskew);
}

TEST(Eikonal, ErrorFromASinglePointGoesWithHLogH) {
  double before = 0;
  for (const std::uint32_t n : {6U, 12U, 24U}) {
    const TetMesh mesh = test::kuhn_cube(n);
    const std::uint32_t source = test::nearest_point(mesh, kCubeMiddle);
    const auto exact = [&](const Eigen::Vector3d& p) {
      return travel_time(p - mesh.points[source], 0.5, 0.2, kAskew);
    };
    const auto times = solved(mesh, test::uniform_tissue(mesh, 0.5, 0.2, kAskew), {{source, 0}});
    const double mean = errors_of(mesh, times, exact).mean;
    EXPECT_EQ(times[source], 0);
    if (n > 6) {
      EXPECT_NEAR(before / mean, 2 * std::log(n / 2.0) / std::log(n), 0.1) << n;
    }
    before = mean;
  }
}

TEST(Eikonal, APlaneWaveIsExactInTetrahedraOfAnyShape) {
  // Sheared by 70 degrees, and squeezed to a hundredth.
  Eigen::Matrix3d sheared = Eigen::Matrix3d::Identity(), squeezed = sheared;
  sheared(0, 2) = 2.7;
  squeezed(2, 2) = 0.01;
  for (const Eigen::Matrix3d& shape : {sheared, squeezed}) {
    TetMesh mesh = test::kuhn_cube(6);
    for (Eigen::Vector3d& p : mesh.points) p = shape * p;
    // The slowness |s| of a plane wave in the direction n satisfies s . C s = 1.
    const Eigen::Vector3d n = Eigen::Vector3d(0.3, -0.5, 0.8);
    const double on_fibre = n.dot(kAskew);
    const Eigen::Vector3d slowness =
        n / std::sqrt(0.04 * n.squaredNorm() + (0.25 - 0.04) * on_fibre * on_fibre);
    std::vector<EikonalSource> sources;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      if (mesh.face_sides[f][1] == kBackground)
        for (const std::uint32_t point : mesh.faces[f])
          sources.push_back({point, slowness.dot(mesh.points[point])});
    const auto times = solved(mesh, test::uniform_tissue(mesh, 0.5, 0.2, kAskew), sources);
    const auto exact = [&](const Eigen::Vector3d& p) { return slowness.dot(p); };
    EXPECT_LT(errors_of(mesh, times, exact).greatest, 1e-8);
  }
}

/// From one side of the slab to the other.
double time_across_the_slab(const TetMesh& mesh, const Tissue& tissue, int axis) {
  const auto at_start = [&](const Eigen::Vector3d& p) { return p[axis] == 0; };
  const auto times = solved(mesh, tissue, sources_where(mesh, at_start, [](const auto&) { return 0.0; }));
  return *std::max_element(times.begin(), times.end());
}

TEST(Eikonal, SpeedsAreThoseOfThePlaneWaveAlongAndAcrossTheFibre) {
  const TetMesh mesh = test::slab(5, 3);
  const Tissue tissue = test::uniform_tissue(mesh, 0.5, 0.2, kAlongX);
  EXPECT_NEAR(time_across_the_slab(mesh, tissue, 0), 20 / 0.5, 1e-8);
  EXPECT_NEAR(time_across_the_slab(mesh, tissue, 1), 20 / 0.2, 1e-8);
  EXPECT_NEAR(time_across_the_slab(mesh, tissue, 2), test::kSlabThickness / 0.2, 1e-8);
  EXPECT_NEAR(time_across_the_slab(mesh, test::isotropic_tissue(mesh, 0.5), 1), 20 / 0.5, 1e-8);
}

TEST(Eikonal, ShareMultipliesTheSquareOfTheSpeed) {
  const TetMesh mesh = test::slab(5, 4);
  Tissue tissue = test::uniform_tissue(mesh, 0.5, 0.2, kAlongX);
  for (const Tet& tet : mesh.tets)
    tissue.share.push_back(test::centroid(mesh, tet)[2] < test::kSlabThickness / 2 ? 1.F : 0.25F);
  // Half of the way at 0.2 mm/ms, half of it at 0.1.
  EXPECT_NEAR(time_across_the_slab(mesh, tissue, 2), test::kSlabThickness / 2 * (5 + 10), 1e-8);
}

TEST(Eikonal, KindsOfTissueConductAtTheirOwnSpeeds) {
  const TetMesh mesh = test::slab(5, 4);
  Tissue tissue = test::isotropic_tissue(mesh, 0.5);
  tissue.kinds.push_back({0.1, 0.1, {}});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    tissue.kind[t] = test::centroid(mesh, mesh.tets[t])[2] < test::kSlabThickness / 2 ? 0 : 1;
  EXPECT_NEAR(time_across_the_slab(mesh, tissue, 2), test::kSlabThickness / 2 * (2 + 10), 1e-8);
}

TEST(Eikonal, TheFirstOfSeveralWavesCounts) {
  const TetMesh mesh = test::slab(10, 3);
  const auto at_end = [](const Eigen::Vector3d& p) { return p[0] == 0 || p[0] == 20; };
  // From both ends, from one of them 8 ms later: they meet at x = 12.
  const auto exact = [](const Eigen::Vector3d& p) {
    return std::min(-5 + p[0] / 0.5, 3 + (20 - p[0]) / 0.5);
  };
  const auto start = [&](const Eigen::Vector3d& p) { return p[0] == 0 ? -5.0 : 3.0; };
  auto sources = sources_where(mesh, at_end, start);
  const Tissue tissue = test::isotropic_tissue(mesh, 0.5);
  EXPECT_LT(errors_of(mesh, solved(mesh, tissue, sources), exact).greatest, 1e-8);

  // Later sources at points that have one, and at one that the wave passes before.
  sources.push_back({sources.front().point, 1});
  sources.insert(sources.begin(), {test::nearest_point(mesh, {8, 10, 2}), 11.5});
  EXPECT_LT(errors_of(mesh, solved(mesh, tissue, sources), exact).greatest, 1e-8);
}

TEST(Eikonal, AnotherSourceMakesNoTimeLater) {
  const TetMesh mesh = test::kuhn_cube(8);
  const Tissue tissue = test::uniform_tissue(mesh, 0.5, 0.2, kAskew);
  const EikonalSource a{test::nearest_point(mesh, {-9, 16, -1}), -12.5};
  const EikonalSource b{test::nearest_point(mesh, {-1, 22, 5}), -3};
  const auto from_a = solved(mesh, tissue, {a}), from_b = solved(mesh, tissue, {b});
  const auto from_both = solved(mesh, tissue, {a, b});
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    EXPECT_LE(from_both[i], std::min(from_a[i], from_b[i]) + 1e-8) << i;
  EXPECT_EQ(from_both[a.point], a.time_ms);
  EXPECT_EQ(from_both[b.point], b.time_ms);
}

/// The greatest error behind a barrier from x = 8 to 12 and y = 0 to 12, in a slab of n x n bricks.
double error_behind_a_barrier(int n) {
  const TetMesh mesh = test::slab(n, 3 * n / 10);
  Tissue tissue = test::isotropic_tissue(mesh, 0.5);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Eigen::Vector3d p = test::centroid(mesh, mesh.tets[t]);
    if (p[0] > 8 && p[0] < 12 && p[1] < 12) tissue.kind[t] = Tissue::kNone;
  }
  const Eigen::Vector3d source(4, 4, 0);
  const auto times = solved(mesh, tissue, {{test::nearest_point(mesh, source), 0}});
  // Seen from above the shortest path bends at (8, 12) and at (12, 12); unrolled, it is straight.
  const double to_bend = std::hypot(8 - 4, 12 - 4) + 12 - 8;
  double greatest = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Eigen::Vector3d& p = mesh.points[i];
    if (p[0] > 8 && p[0] < 12 && p[1] < 12) {
      EXPECT_TRUE(std::isnan(times[i])) << p.transpose();
    }
    if (p[0] < 12 || p[1] > 12) continue;
    const double path = std::hypot(to_bend + std::hypot(p[0] - 12, p[1] - 12), p[2] - source[2]);
    greatest = std::max(greatest, std::abs(times[i] - path / 0.5));
  }
  return greatest;
}

TEST(Eikonal, GoesAroundABarrier) {
  // As from a single point, for at its edges the front bends as sharply.
  const double coarse = error_behind_a_barrier(10), middle = error_behind_a_barrier(20),
               fine = error_behind_a_barrier(40);
  EXPECT_NEAR(coarse / middle, 2 * std::log(10) / std::log(20), 0.1);
  EXPECT_NEAR(middle / fine, 2 * std::log(20) / std::log(40), 0.1);
}

TEST(Eikonal, GivesNoTimeToTissueThatIsNotConnected) {
  const TetMesh mesh = test::slab(10, 3);
  Tissue tissue = test::isotropic_tissue(mesh, 0.5);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const double x = test::centroid(mesh, mesh.tets[t])[0];
    if (x > 8 && x < 14) tissue.kind[t] = Tissue::kNone;
  }
  const auto times = solved(mesh, tissue, {{test::nearest_point(mesh, {0, 10, 2}), 0}});
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_EQ(std::isnan(times[i]), mesh.points[i][0] > 8) << mesh.points[i].transpose();
}

/// A small case in which everything that a tissue may have is used.
struct Heterogeneous {
  TetMesh mesh = test::kuhn_cube(8);
  Tissue tissue = test::uniform_tissue(mesh, 0.5, 0.2, kAskew);
  std::vector<EikonalSource> sources;

  Heterogeneous() {
    tissue.kinds.push_back({0.9, 0.9, {}});
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      const Eigen::Vector3d p = test::centroid(mesh, mesh.tets[t]) - kCubeMiddle;
      if (p[0] > 0 && p[1] > 0) tissue.kind[t] = 1;
      if (p.norm() < 2) tissue.kind[t] = Tissue::kNone;
      tissue.fibre[t] = Eigen::Vector3d(-p[1], p[0], 0.3 * p[2]).normalized();
      tissue.share.push_back(p[2] < 0 ? 1.F : 0.3F);
    }
    sources = {{test::nearest_point(mesh, {-9, 16, -1}), 0}, {test::nearest_point(mesh, {-1, 24, 7}), 3.7}};
  }
};

TEST(Eikonal, NoTetrahedronMakesAnyTimeEarlier) {
  const Heterogeneous c;
  const auto times = solved(c.mesh, c.tissue, c.sources);
  std::vector<EikonalSource> all = c.sources;
  for (std::uint32_t i = 0; i < times.size(); ++i)
    if (!std::isnan(times[i])) all.push_back({i, times[i]});
  const auto again = solved(c.mesh, c.tissue, all);
  for (std::size_t i = 0; i < times.size(); ++i)
    if (!std::isnan(times[i])) {
      EXPECT_EQ(again[i], times[i]) << i;
    }
}

TEST(Eikonal, SameBytesOnEveryPlatform) {
  const Heterogeneous c;
  const auto times = solved(c.mesh, c.tissue, c.sources);
  Sha256 sha;
  for (const double time : times)  // the bits of NaN are not promised
    if (!std::isnan(time)) sha.update_values(&time, 1);
  EXPECT_EQ(sha.hex(), "615fd41d99c72b0a59386433c2787a3b2ac04d7a7b6d847ca13364dffd872ee3");
}

TEST(Eikonal, TellsItsProgressAndStopsWhenAsked) {
  const Heterogeneous c;
  RunContext ctx;
  double fraction = 0;
  ctx.on_progress = [&](const std::string& stage, double now) {
    EXPECT_EQ(stage, "eikonal");
    EXPECT_GE(now, fraction);
    EXPECT_LE(now, 1);
    fraction = now;
  };
  EXPECT_TRUE(solve_eikonal(c.mesh, c.tissue, c.sources, ctx).ok());
  EXPECT_EQ(fraction, 1);
  ctx.on_progress = {};
  ctx.on_cancelled = [] { return true; };
  const auto stopped = solve_eikonal(c.mesh, c.tissue, c.sources, ctx);
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace voxtet
