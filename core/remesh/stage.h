#pragma once

namespace voxtet::remesh {

/// The stage in errors, warnings and progress.
inline constexpr const char* kRemeshStage = "remesh";

}  // namespace voxtet::remesh
