// Problems of Land et al., Proceedings of the Royal Society A 471 (2015): statics of muscle, by element and
// resolution.
#include "support/land.h"

#include <cmath>
#include <cstdio>
#include <optional>

#include "verify.h"

namespace voxtet::verify {
namespace {

using mechanics::Formulation;

constexpr double kBulk = 1000;  // kPa
constexpr int kSteps = 10;

struct Row {
  Formulation formulation;
  int across;  ///< bricks or layers
  int along;   ///< bricks or rings
  bool fast;   ///< in some seconds
  int steps = kSteps;
};

/// A number that was found with elements of the length h.
struct Found {
  double h, value;
};

/// What the last three of these tell if they are limit + c h^order.
struct Convergence {
  double order, limit;
};
std::optional<Convergence> convergence_of(const std::vector<Found>& found) {
  constexpr double kLeast = 0.01, kMost = 10;
  if (found.size() < 3) return std::nullopt;
  const Found *const a = &found.back() - 2, *const b = a + 1, *const c = b + 1;
  const auto ratio = [&](double p) {
    return (std::pow(a->h, p) - std::pow(b->h, p)) / (std::pow(b->h, p) - std::pow(c->h, p));
  };
  const double wanted = (a->value - b->value) / (b->value - c->value);
  double low = kLeast, high = kMost;
  if (!(wanted > ratio(low) && wanted < ratio(high))) return std::nullopt;
  for (int i = 0; i < 60; ++i) (ratio((low + high) / 2) < wanted ? low : high) = (low + high) / 2;
  const double far = std::pow(b->h, low), near = std::pow(c->h, low);
  return Convergence{low, c->value - (b->value - c->value) * near / (far - near)};
}

/// Of the rows of a table that refine the same element alike, all of them.
class Refinement {
 public:
  void add(const Row& row, double value) {
    const bool goes_on = formulation_ == row.formulation && row.along * across_ == along_ * row.across;
    if (!goes_on) found_.clear();
    formulation_ = row.formulation;
    across_ = row.across;
    along_ = row.along;
    found_.push_back({1.0 / row.across, value});
  }
  void print(const char* format) const {
    const auto convergence = convergence_of(found_);
    if (convergence) std::printf(format, convergence->order, convergence->limit);
  }

 private:
  Formulation formulation_ = Formulation::kLinear;
  int across_ = 0, along_ = 1;
  std::vector<Found> found_;
};

void print_counts(const test::LandResult& result) {
  std::printf("%8zu  %10d  %14d", result.unknowns, result.iterations, result.factorisations);
}

void print_oscillation(const test::LandResult& result) {
  std::printf("  %11s", result.oscillation > 0 ? text("%.4f", result.oscillation).c_str() : "-");
}

void print_beam(bool all) {
  constexpr Row kRows[] = {{Formulation::kLinear, 2, 20, true},
                           {Formulation::kLinear, 4, 40, true},
                           {Formulation::kLinear, 8, 80, false},
                           {Formulation::kAverageNodalPressure, 2, 20, true},
                           {Formulation::kAverageNodalPressure, 4, 40, true},
                           {Formulation::kAverageNodalPressure, 8, 80, false},
                           {Formulation::kStabilised, 2, 20, true},
                           {Formulation::kStabilised, 4, 40, true},
                           {Formulation::kStabilised, 8, 80, false},
                           {Formulation::kQuadratic, 1, 10, true},
                           {Formulation::kQuadratic, 2, 20, true},
                           {Formulation::kQuadratic, 4, 40, false},
                           {Formulation::kQuadratic, 3, 25, true}};
  std::printf(
      "Land, problem 1: how far the tip of the beam rises, mm. Expected for short edges: 3.17. Bulk modulus "
      "%.0f kPa.\nOscillation: of a node's pressure from the mean of its neighbours', over the pressure. "
      "Order and "
      "limit: by three sizes\n  element    bricks  unknowns  iterations  factorisations  oscillation  rises  "
      "order  "
      "limit\n",
      kBulk);
  Refinement refinement;
  for (const Row& row : kRows) {
    if (!row.fast && !all) continue;
    const auto beam = value_or_exit(
        test::land_beam({row.along, row.across, row.across}, row.formulation, kBulk, row.steps));
    std::printf("  %-6s  %2d x%2d x%2d  ", name_of(row.formulation), row.along, row.across, row.across);
    print_counts(beam.result);
    print_oscillation(beam.result);
    std::printf("  %5.3f", beam.deflection_mm);
    refinement.add(row, beam.deflection_mm);
    refinement.print("  %5.2f  %5.3f");
    std::printf("\n");
    std::fflush(stdout);
  }
  const auto softer =
      value_or_exit(test::land_beam({25, 3, 3}, Formulation::kQuadratic, 400, kSteps, {2, 8, 2, 2}));
  std::printf(
      "  P2 on 25 x 3 x 3 with half of the stiffness in shear, b_fs = 2, and a bulk modulus of 400 kPa, as "
      "Thunderbolt "
      "has it: %.3f. There 3.17 +- 0.02\n",
      softer.deflection_mm);
}

void print_ventricle(bool contracts, bool all) {
  constexpr Row kRows[] = {
      {Formulation::kLinear, 1, 8, true},
      {Formulation::kLinear, 2, 16, false},
      {Formulation::kAverageNodalPressure, 1, 8, true, 7},  // which pass the load where it buckles
      {Formulation::kAverageNodalPressure, 2, 16, true},
      {Formulation::kAverageNodalPressure, 3, 24, false},
      {Formulation::kStabilised, 1, 8, true},
      {Formulation::kStabilised, 2, 16, true},
      {Formulation::kStabilised, 3, 24, false},
      {Formulation::kQuadratic, 1, 8, true},
      {Formulation::kQuadratic, 2, 8, false},
  };
  std::printf(
      "Land, problem %s: z of the apex, mm. Expected for short edges: inside %s, outside %s\n  element  "
      "layers  "
      "rings  unknowns  iterations  factorisations  oscillation  inside  outside  order, limit inside and "
      "outside\n",
      contracts ? "3" : "2", contracts ? "-12.0 to -12.5" : "-26.53",
      contracts ? "-15.2 to -15.5" : "-28.18");
  Refinement inside, outside;
  for (const Row& row : kRows) {
    if (!row.fast && !all) continue;
    // Steps of the load become ever shorter below half of it.
    if (contracts && row.formulation == Formulation::kStabilised && row.across == 3) continue;
    const auto heart =
        test::land_ventricle(contracts, static_cast<std::uint32_t>(row.across),
                             static_cast<std::uint32_t>(row.along), row.formulation, kBulk, row.steps);
    std::printf("  %-7s  %6d  %5d  ", name_of(row.formulation), row.across, row.along);
    // Locked elements may buckle: what the solver says then is a result too.
    if (heart) {
      print_counts(heart->result);
      print_oscillation(heart->result);
      std::printf("  %6.2f  %7.2f", heart->endo_mm, heart->epi_mm);
      inside.add(row, heart->endo_mm);
      outside.add(row, heart->epi_mm);
      inside.print("  %4.1f %6.2f");
      outside.print("  %4.1f %6.2f");
      std::printf("\n");
    } else {
      std::printf("%s\n", heart.error().message.c_str());
    }
    std::fflush(stdout);
  }
}

}  // namespace

void print_land(bool all) {
  print_beam(all);
  print_ventricle(false, all);
  print_ventricle(true, all);
}

}  // namespace voxtet::verify
