// Problems of Land et al., Proceedings of the Royal Society A 471 (2015): statics of muscle, by element and
// resolution.
#include "support/land.h"

#include <cstdio>

#include "verify.h"

namespace voxtet::verify {
namespace {

using mechanics::Formulation;

constexpr double kBulk = 1000;  // kPa
constexpr int kSteps = 10;

const char* name_of(Formulation formulation) {
  switch (formulation) {
    case Formulation::kLinear: return "P1";
    case Formulation::kAverageNodalPressure: return "P1 ANP";
    case Formulation::kQuadratic: return "P2";
    case Formulation::kStabilised: return "P1-P1";
  }
  return "";
}

struct Row {
  Formulation formulation;
  int across;  ///< bricks or layers
  int along;   ///< bricks or rings
  bool fast;   ///< in less than half a minute
};

void print_beam(bool all) {
  constexpr Row kRows[] = {{Formulation::kLinear, 2, 20, true},
                           {Formulation::kLinear, 4, 40, true},
                           {Formulation::kLinear, 8, 80, false},
                           {Formulation::kAverageNodalPressure, 2, 20, true},
                           {Formulation::kAverageNodalPressure, 4, 40, true},
                           {Formulation::kAverageNodalPressure, 8, 80, false},
                           {Formulation::kQuadratic, 1, 10, true},
                           {Formulation::kQuadratic, 2, 20, true},
                           {Formulation::kQuadratic, 3, 25, true},
                           {Formulation::kQuadratic, 4, 40, false}};
  std::printf(
      "Land, problem 1: how far the tip of the beam rises, mm. Expected for short edges: 3.17. Bulk modulus "
      "%.0f kPa\n  element    bricks  unknowns  iterations  factorisations  rises\n",
      kBulk);
  for (const Row& row : kRows) {
    if (!row.fast && !all) continue;
    const auto beam =
        value_or_exit(test::land_beam({row.along, row.across, row.across}, row.formulation, kBulk, kSteps));
    std::printf("  %-6s  %2d x%2d x%2d  %8zu  %10d  %14d  %5.3f\n", name_of(row.formulation), row.along,
                row.across, row.across, beam.result.unknowns, beam.result.iterations,
                beam.result.factorisations, beam.deflection_mm);
    std::fflush(stdout);
  }
}

void print_ventricle(bool contracts, bool all) {
  constexpr Row kRows[] = {
      {Formulation::kLinear, 1, 8, true},
      {Formulation::kLinear, 2, 16, false},
      {Formulation::kAverageNodalPressure, 1, 8, true},
      {Formulation::kAverageNodalPressure, 2, 16, true},
      {Formulation::kAverageNodalPressure, 3, 20, false},
      {Formulation::kQuadratic, 1, 8, true},
      {Formulation::kQuadratic, 1, 12, false},
      {Formulation::kQuadratic, 2, 12, false},
  };
  std::printf(
      "Land, problem %s: z of the apex, mm. Expected for short edges: inside %s, outside %s\n  element  "
      "layers  rings  unknowns  iterations  factorisations  inside  outside\n",
      contracts ? "3" : "2", contracts ? "-12.0 to -12.5" : "-26.53",
      contracts ? "-15.2 to -15.5" : "-28.18");
  for (const Row& row : kRows) {
    if (!row.fast && !all) continue;
    const auto heart =
        test::land_ventricle(contracts, static_cast<std::uint32_t>(row.across),
                             static_cast<std::uint32_t>(row.along), row.formulation, kBulk, kSteps);
    std::printf("  %-7s  %6d  %5d  ", name_of(row.formulation), row.across, row.along);
    // Locked elements may buckle: what the solver says then is a result too.
    if (heart)
      std::printf("%8zu  %10d  %14d  %6.2f  %7.2f\n", heart->result.unknowns, heart->result.iterations,
                  heart->result.factorisations, heart->endo_mm, heart->epi_mm);
    else
      std::printf("%s\n", heart.error().message.c_str());
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
