// The command that generates bodies: `voxtet phantom`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/options.h"

namespace voxtet {

struct PhantomOptions {
  std::string kind, out;
  std::vector<std::string> set;       ///< NAME=VALUE
  std::vector<std::string> draw;      ///< NAME=FROM:TO or NAME=A,B,...
  int hearts = 0;                     ///< 0: one body, `out` is a file; else a cohort, `out` is a folder
  std::optional<std::uint32_t> seed;  ///< of the cohort; 1 if absent
};

void add_phantom_command(CLI::App& command, PhantomOptions& options);

/// Generates the body or the cohort. Returns the exit code.
int run_phantom(const PhantomOptions& options);

}  // namespace voxtet
