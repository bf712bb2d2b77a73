// The names of the stages, as errors, warnings, notes and progress tell them.
#pragma once

namespace voxtet {

inline constexpr const char* kSizingStage = "sizing";
inline constexpr const char* kRemeshStage = "remesh";

}  // namespace voxtet
