// One random label volume taken through the pipeline and judged.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sweep/defects.h"
#include "types/result.h"

namespace voxtet::sweep {

struct RandomCase {
  std::uint64_t seed = 0;
  std::string kind, affine;
  Stage last = Stage::kRemesh;                ///< how far it was to go
  std::array<double, kStageCount> seconds{};  ///< wall time of each stage
  std::vector<Defect> defects;
  std::string digest;    ///< of the last result; empty when there is none
  std::string gave_way;  ///< the warning with which method delaunay gave way to adapt; empty: it did not
};

/// random_labels(seed) with edges of twice the smallest spacing, through to the adapted surface or, with
/// `tets`, to tetrahedra. A stage that gives an error is a defect ("error") and ends the case. Errors: kUsage
/// for a method that the recipe does not know.
Result<RandomCase> run_random_case(std::uint64_t seed, const std::string& method, bool tets);

}  // namespace voxtet::sweep
