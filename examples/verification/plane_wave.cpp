// The speed of a plane wave along a bar of unstructured tetrahedra, by its mean edge length.
#include <cmath>
#include <cstdio>

#include "physics/monodomain/cell.h"
#include "support/bricks.h"
#include "support/uniform_tissue.h"
#include "verify.h"

namespace voxtet::verify {
namespace {

constexpr double kSpeed = 0.5;
constexpr Way kBarWays[] = {{"explicit", Integration::kExplicit, 0},
                            {"consistent 0", Integration::kSemiImplicit, 0},
                            {"0.5", Integration::kSemiImplicit, 0.5},
                            {"0.75", Integration::kSemiImplicit, 0.75},
                            {"1", Integration::kSemiImplicit, 1}};

/// Of `ms` steps in the limit of short edges: along one row of bricks.
double fine_speed(const MonodomainParams& params) {
  constexpr int kBricks = 600;
  const auto row =
      std::make_shared<const TetMesh>(test::bricks_cut_all_ways({30, 0.05, 0.05}, {kBricks, 1, 1}));
  return speed_along(row, params);
}

struct Expected {
  double edge_mm;
  std::array<double, std::size(kBarWays)> error_percent;
};

/// Measured with another code on bars of 60 mm; there was no explicit column.
constexpr Expected kExpected[] = {
    {0.84, {-2.8, -2.8, 0.2, 2.1, 4.2}},   {1.59, {-6.6, -6.6, -0.4, 4.1, 10.1}},
    {2.06, {-9.0, -9.0, -0.9, 5.1, 14.3}}, {3.00, {-13.4, -13.4, -3.2, 4.8, 17.2}},
    {1.10, {-4.5, -4.5, 0.1, 3.2, 7.0}},   {0.65, {-2.1, -2.1, 0.1, 1.4, 2.7}},
    {0.44, {-1.2, -1.2, -0.1, 0.4, 1.0}},
};

}  // namespace

double speed_along(const std::shared_ptr<const TetMesh>& bar, const MonodomainParams& params) {
  double length = 0;
  for (const Eigen::Vector3d& p : bar->points) length = std::max(length, p[0]);
  const auto times =
      activations_ms(bar, test::isotropic_tissue(*bar, kSpeed), at_corner({4, 1000, 1000}), params);
  double n = 0, x = 0, t = 0, xx = 0, xt = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double at = bar->points[i][0] / length;
    if (at < 0.35 || at > 0.85) continue;
    n += 1, x += at, t += times[i], xx += at * at, xt += at * times[i];
  }
  return length * (n * xx - x * x) / (n * xt - x * t);
}

void print_plane_wave(bool all) {
  const double step_ms = all ? 0.01 : 0.05;
  std::printf(
      "Plane wave, speed in a bar of TetGen's tetrahedra, D %.4f mm^2/ms, step %.2f ms: error in %% of the "
      "speed for short edges; in brackets what is expected, within 0.5\n",
      diffusivity_of(kSpeed, {}), step_ms);
  std::printf("  edge mm    tets");
  for (const Way& way : kBarWays) std::printf("  %14s", way.name);
  const double explicit_fine = fine_speed(params_of(kBarWays[0], 0.0015));
  const double fine = fine_speed(params_of(kBarWays[1], step_ms));
  std::printf("\n  0.05    (row)  %14.4f  %14.4f mm/ms\n", explicit_fine, fine);
  for (const Expected& expected : kExpected) {
    if (!all && expected.edge_mm < 0.8) continue;
    const double length = expected.edge_mm < 1 ? 30 : 60;
    const double square = expected.edge_mm / kEdgePerSquare;
    const auto bar = box_of_tets({static_cast<int>(std::lround(length / square)), 8, 8}, square);
    std::printf("  %.2f  %8zu", mean_edge_mm(*bar), bar->tets.size());
    for (std::size_t w = 0; w < std::size(kBarWays); ++w) {
      const double speed = speed_along(bar, params_of(kBarWays[w], step_ms));
      const double error = 100 * (speed / (w == 0 ? explicit_fine : fine) - 1);
      std::printf("  %6.2f (%5.1f)", error, expected.error_percent[w]);
      std::fflush(stdout);
    }
    std::printf("\n");
  }
}

}  // namespace voxtet::verify
