// The command line. main() is one call, so that tests can run commands in process.
#pragma once

namespace voxtet {

/// Exit codes of every command.
enum ExitCode {
  kExitOk = 0,
  kExitUsage = 2,
  kExitBadInput = 3,
  kExitMeshing = 4,  ///< also where a mesh was made that fails a hard check or lacks exact layers
  kExitDiffers = 5,
  kExitLimits = 6,  ///< out of memory or time
};

/// Parses and runs one command; messages and progress go to standard error, results to standard output.
int run_cli(int argc, const char* const* argv);

}  // namespace voxtet
