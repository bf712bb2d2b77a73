// The command that converts files: `voxtet convert`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/options.h"
#include "cli/words/read_options.h"

namespace voxtet {

struct ConvertOptions {
  std::string in, out;
  std::vector<std::string> values;  ///< files of values at the mesh's points, .dat or .igb
  std::optional<double> time_ms;    ///< of the frame of an .igb; none: the last
  std::string label_array;          ///< of a mesh, in the place of `label`
  ReadOptionTexts read;             ///< of a volume
};

void add_convert_command(CLI::App& command, ConvertOptions& wanted, Output& output);

/// Reads a mesh with its fibres or cell data, or a volume, and writes it. Returns the exit code.
int run_convert(const ConvertOptions& wanted, const Output& output);

}  // namespace voxtet
