// The order of the local operations.
#pragma once

namespace voxtet {

enum class AdaptSchedule {
  kAdaptive,  ///< collapse, split, flip, relocate to the sizing field, several passes, then polish
  kPaper,     ///< coarsen globally to the largest size, refine 1:4 locally, then optimise
};

}  // namespace voxtet
