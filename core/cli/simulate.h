// The command that simulates: `voxtet simulate`.
#pragma once

#include <string>

#include "cli/options.h"

namespace voxtet {

struct SimulateOptions {
  std::string out, report, traces, frames;
  std::string save_state, from_state;
  std::string
      what;  ///< a stage: eikonal or monodomain; empty: monodomain where the case has it, else eikonal
};

void add_simulate_command(CLI::App& command, CaseOptions& options, SimulateOptions& wanted, Output& output);

/// Meshes the case, simulates, and writes what was asked for. Returns the exit code.
int run_simulate(const CaseOptions& options, const SimulateOptions& wanted, const Output& output);

}  // namespace voxtet
