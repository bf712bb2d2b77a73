#pragma once

namespace voxtet {

/// The stage in errors, warnings and progress.
inline constexpr const char* kSizingStage = "sizing";

}  // namespace voxtet
