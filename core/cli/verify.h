// The command that compares a run with what a case promises: `voxtet verify`.
#pragma once

#include "cli/options.h"

namespace voxtet {

/// Meshes the case, simulates what it promises, and compares digests. Returns the exit code: kExitDiffers
/// where one of them is another.
int run_verify(const CaseOptions& options, const Output& output);

}  // namespace voxtet
