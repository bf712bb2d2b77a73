// The slab of Niederer et al., Phil. Trans. R. Soc. A 369 (2011): 20 x 7 x 3 mm, fibres along x, excited at a
// corner; with the cell of Mitchell and Schaeffer.
#include <cmath>
#include <cstdio>

#include "physics/monodomain/cell.h"
#include "support/bricks.h"
#include "support/uniform_tissue.h"
#include "verify.h"

namespace voxtet::verify {
namespace {

constexpr Way kSlabWays[] = {{"explicit", Integration::kExplicit, 0},
                             {"consistent 0", Integration::kSemiImplicit, 0},
                             {"consistent 0.5", Integration::kSemiImplicit, 0.5}};

const Eigen::Vector3d kSize(20, 7, 3);

std::array<int, 3> bricks_of(double edge_mm) {
  const auto bricks = [&](int d) { return static_cast<int>(std::lround(kSize[d] / edge_mm)); };
  return {bricks(0), bricks(1), bricks(2)};
}

/// Prints a row, with the point above the centre where that lies between points; the time at the far corner.
double print_row(const Way& way, double edge_mm, double step_ms, bool all_ways) {
  const auto count = bricks_of(edge_mm);
  const auto mesh = std::make_shared<const TetMesh>(all_ways ? test::bricks_cut_all_ways(kSize, count)
                                                             : test::bricks(kSize, count));
  const double unit = plane_wave_speed({});
  const Tissue tissue = test::uniform_tissue(*mesh, unit * std::sqrt(0.0953), unit * std::sqrt(0.012576),
                                             Eigen::Vector3d::UnitX());
  const auto times = activations_ms(mesh, tissue, at_corner({1.5, 1.5, 1.5}), params_of(way, step_ms));
  const auto at = [&](double x, double y, double z) { return times[test::nearest_point(*mesh, {x, y, z})]; };
  std::printf("  %.2f  %.3f  %-15s%-6s  %7.2f  %7.2f  %7.2f  %7.2f\n", edge_mm, step_ms, way.name,
              all_ways ? "cube" : "Kuhn", at(20, 0, 0), at(0, 7, 0),
              at(10, 3.5 + edge_mm / 4, 1.5 + edge_mm / 4), at(20, 7, 3));
  std::fflush(stdout);
  return at(20, 7, 3);
}

/// From two edge lengths, for an error that goes with their square.
double extrapolated(double coarse_mm, double coarse, double fine_mm, double fine) {
  const double ratio = coarse_mm * coarse_mm / (fine_mm * fine_mm);
  return fine + (fine - coarse) / (ratio - 1);
}

}  // namespace

void print_slab(bool all) {
  std::printf(
      "Slab, activation in ms. Bricks cut into 6 tetrahedra (Kuhn) or along all diagonals (cube: the stencil "
      "of finite differences). Expected at the far corner for short edges: 76.9 within 0.3\n");
  std::printf("  edge   step  %21s %7s  %7s  %7s  %7s\n", "", "20 0 0", "0 7 0", "centre", "20 7 3");
  std::printf("  0.50  0.010  finite differences      58.32    54.91    37.67    82.47\n");
  std::printf("  0.20  0.010  finite differences      57.13    50.30    37.26    78.27\n");
  for (const double edge : {0.5, 0.2}) print_row(kSlabWays[0], edge, 0.01, true);
  for (const Way& way : kSlabWays) {
    const bool quick = way.integration == Integration::kExplicit;
    const double step_ms = quick || all ? 0.01 : 0.05;
    print_row(way, 0.5, step_ms, false);
    // With these edges the points in the excited cube stand for exactly 1.5 mm of the slab.
    const double coarse = print_row(way, 1.0 / 5, step_ms, false);
    if (!quick && !all) continue;
    const double fine = print_row(way, 1.0 / 7, step_ms, false);
    std::printf("  0     %63.2f  extrapolated\n", extrapolated(1.0 / 5, coarse, 1.0 / 7, fine));
  }
  if (!all) return;
  print_row(kSlabWays[0], 1.0 / 9, 0.01, false);
  print_row(kSlabWays[0], 0.1, 0.005, false);
}

}  // namespace voxtet::verify
