// The command that runs many cases: `voxtet study`.
#pragma once

#include <string>

#include "cli/options.h"

namespace voxtet {

struct StudyOptions {
  std::string input, out;
  std::string chunk;                            ///< "2/5"; empty: all cases
  std::string base = "http://127.0.0.1:8123/";  ///< address of the app, for the links of the page
  int plan = 0;                                 ///< number of chunks to forecast; 0: none
  int jobs = 1;
  double memory_mb = 0;  ///< of a case; 0: no limit
  bool table_only = false;
};

void add_study_command(CLI::App& command, StudyOptions& options, Output& output);

/// Runs the study, or a part of it, and writes its table. Returns the exit code.
int run_study_command(const StudyOptions& options, const Output& output);

}  // namespace voxtet
