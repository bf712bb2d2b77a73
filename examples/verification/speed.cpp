// Milliseconds a step while a wave runs through a plate of unstructured tetrahedra.
#include <algorithm>
#include <chrono>
#include <cstdio>

#include "support/uniform_tissue.h"
#include "verify.h"

namespace voxtet::verify {
namespace {

constexpr double kStep = 0.05;  // ms

/// ms a step: the least of some runs, as other programs may run beside it.
double step_cost_ms(const std::shared_ptr<const TetMesh>& mesh, const Way& way, int threads) {
  constexpr int kRuns = 9, kSteps = 20;
  Monodomain heart = value_or_exit(Monodomain::start(*mesh, test::isotropic_tissue(*mesh, 0.5),
                                                     {at_corner({5, 5, 5})}, params_of(way, kStep), threads));
  while (heart.time_ms() < 5) step(heart);
  std::vector<double> costs;
  for (int run = 0; run < kRuns; ++run) {
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < kSteps; ++i) step(heart);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    costs.push_back(took.count() / kSteps);
  }
  return *std::min_element(costs.begin(), costs.end());
}

}  // namespace

void print_speed(bool) {
  std::printf(
      "Speed, ms a step of 0.05 ms; expected: explicit, 373k tetrahedra, one thread, 2.13 (in float32)\n");
  std::printf("  edge mm    tets  points  explicit  explicit, 2 threads  semi-implicit\n");
  const Way quick{"explicit", Integration::kExplicit, 0}, accurate{"", Integration::kSemiImplicit, 0.5};
  for (const int squares : {28, 37, 57}) {
    const auto plate = box_of_tets({squares, squares, squares / 3}, 60.0 / squares);
    const double one = step_cost_ms(plate, quick, 1), two = step_cost_ms(plate, quick, 2),
                 implicit = step_cost_ms(plate, accurate, 1);
    std::printf("  %7.2f  %6zu  %6zu  %8.2f  %19.2f  %13.2f\n", mean_edge_mm(*plate), plate->tets.size(),
                plate->points.size(), one, two, implicit);
    std::fflush(stdout);
  }
}

}  // namespace voxtet::verify
