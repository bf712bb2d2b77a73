// The command that meshes: `voxtet mesh`.
#pragma once

#include <string>

#include "cli/options.h"

namespace voxtet {

/// What `mesh` writes, and how far it goes.
struct MeshOptions {
  std::string out, report, dump;  ///< "-" as `out`: standard output
  std::string mechanics;          ///< a case for FEBio or svMultiPhysics
  std::string until = name_of(Stage::kQuality);
  bool measures = false;  ///< in the mesh file
};

void add_mesh_command(CLI::App& command, CaseOptions& options, MeshOptions& wanted, Output& output);

/// Meshes the case and writes what was asked for, its report also when the run fails. Returns the exit code.
int run_mesh(const CaseOptions& options, const MeshOptions& wanted, const Output& output);

}  // namespace voxtet
