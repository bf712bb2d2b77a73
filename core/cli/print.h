// Output of the command line: progress and errors on standard error, results on standard output.
#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>

#include "types/result.h"
#include "types/run_context.h"

namespace voxtet {

/// A context that prints a line for each stage (and percentages on a terminal) to standard error. If
/// `time_limit_s` > 0 it cancels after this time. `threads` as in RunContext.
RunContext printing_context(double time_limit_s, int threads);

/// A line of warning on standard error.
void print_warning(const std::string& message);
/// The same of something that is not wrong.
void print_note(const std::string& message);

/// Prints the error and returns its exit code.
int fail(const Error& error);

/// The report of a mesh, for people.
void print_report(const nlohmann::json& report, std::FILE* out);

/// Metrics and checklist, for people.
void print_quality(const nlohmann::json& quality, std::FILE* out);

/// What meshing a case will need, and the fitting edge lengths if they were asked for.
void print_forecast(const nlohmann::json& forecast, std::FILE* out);

/// Time and memory of each stage, its notes below it, and the sum.
void print_stages(const nlohmann::json& stages, std::FILE* out);

}  // namespace voxtet
