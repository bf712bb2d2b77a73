#include "cli/study.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/parallel.h"
#include "base/with_commas.h"
#include "cli/cli.h"
#include "cli/print.h"
#include "cli/words/option_texts.h"
#include "io/bytes/files.h"
#include "study/page/page.h"
#include "study/run_study.h"
#include "study/table.h"

namespace voxtet {
namespace {

using nlohmann::json;

/// "2/5". Errors: kUsage.
Result<Chunk> to_chunk(const std::string& text) {
  if (text.empty()) return Chunk{};
  const std::vector<std::string> parts = split(text, '/');
  const auto is_number = [](const std::string& part) {
    return !part.empty() && part.size() <= 9 && part.find_first_not_of("0123456789") == std::string::npos;
  };
  if (parts.size() == 2 && is_number(parts[0]) && is_number(parts[1])) {
    const Chunk chunk{std::stoul(parts[0]), std::stoul(parts[1])};
    if (chunk.index >= 1 && chunk.index <= chunk.of) return chunk;
  }
  return usage_error("cli", "--chunk: found '" + text + "', expected one of so many, as 2/5");
}

Status check_options(const StudyOptions& options) {
  const int modes = !options.chunk.empty() + (options.plan > 0) + options.table_only;
  if (modes > 1)
    return usage_error("cli", "found more than one of --chunk, --plan and --table, expected one");
  return std::monostate{};
}

std::string in(const StudyOptions& options, const char* name) {
  return (std::filesystem::path(options.out) / name).string();
}

Status make_folder(const std::string& path) {
  std::error_code failed;
  std::filesystem::create_directories(path, failed);
  if (!failed) return std::monostate{};
  return Error{ErrorCode::kBadInput, "cli", path + ": cannot be made: " + failed.message(), {}};
}

/// Memory and time of each chunk, by the forecasts of its cases.
Status write_plan(const Study& study, const StudyOptions& options, const CaseLimits& limits) {
  json chunks = json::array();
  const auto of = static_cast<std::size_t>(options.plan);
  for (std::size_t index = 1; index <= of; ++index) {
    const std::vector<const StudyCase*> cases = cases_of_chunk(study, {index, of});
    double memory_mb = 0, seconds = 0;
    for (const StudyCase* one : cases) {
      const Result<Forecast> forecast = forecast_of(*one, study.plan, limits);
      if (!forecast) {
        print_warning(one->name + ": " + forecast.error().message);
        continue;
      }
      memory_mb = std::max(memory_mb, forecast->peak_mb);
      seconds += forecast->seconds;
    }
    chunks.push_back({{"chunk", std::to_string(index) + "/" + std::to_string(of)},
                      {"cases", cases.size()},
                      {"memory_mb", memory_mb},
                      {"seconds", seconds}});
  }
  if (Status made = make_folder(options.out); !made) return made;
  return write_text_file(in(options, "plan.json"),
                         text_of({{"cases", study.cases.size()}, {"chunks", chunks}}) + "\n");
}

Status write_table(const Study& study, const StudyOptions& options) {
  if (Status made = make_folder(options.out); !made) return made;
  const StudyTable table = read_table(study, options.out);
  const std::vector<std::pair<const char*, std::string>> files{
      {"table.csv", csv_of(table.rows)},
      {"table.jsonl", json_lines_of(table.rows)},
      {"costs.csv", csv_of(table.costs)},
      {"index.html", study_page(study, table, options.base)}};
  for (const auto& [name, text] : files)
    if (Status written = write_text_file(in(options, name), text); !written) return written;
  std::printf("%zu cases: %zu done, %zu failed, %zu not run; see %s\n", table.rows.size(),
              count_of(table.rows, "done"), count_of(table.rows, "failed"), count_of(table.rows, "missing"),
              in(options, "index.html").c_str());
  return std::monostate{};
}

/// A line for each case that ends.
void print_case(const StudyCase& one, std::size_t of, const nlohmann::ordered_json& record, bool was_there) {
  std::string what = "its record could not be written";
  if (!record.is_null() && record["status"] == "failed") {
    what = "failed: " + record["reason"].get<std::string>();
  } else if (!record.is_null()) {
    what = record["figures"]["tets"].is_number()
               ? with_commas(record["figures"]["tets"].get<std::uint64_t>()) + " tetrahedra"
               : "done";
    if (!was_there && record["cost"]["seconds"].is_number()) {
      char seconds[32];
      std::snprintf(seconds, sizeof seconds, ", %.1f s", record["cost"]["seconds"].get<double>());
      what += seconds;
    }
  }
  std::fprintf(stderr, "%zu/%zu %s: %s%s\n", one.number, of, one.name.c_str(), what.c_str(),
               was_there ? ", was there" : "");
}

}  // namespace

void add_study_command(CLI::App& command, StudyOptions& options, Output& output) {
  command.add_option("STUDY.json", options.input, "a table of cases: what varies, and which stages are run")
      ->required();
  command
      .add_option("-o,--output", options.out, "folder of the results; what is done there is not done again")
      ->required()
      ->check(kNotEmpty);
  command
      .add_option("--chunk", options.chunk,
                  "run these cases only, as 2/5: the second of five parts; no table")
      ->check(kNotEmpty);
  command.add_flag("--table", options.table_only, "run nothing, write the table of what is there");
  command
      .add_option("--plan", options.plan,
                  "run nothing, write plan.json: memory and time of so many chunks, by forecast")
      ->check(
          number_as("a number of chunks as 5", [](double n) { return n >= 1 && n <= 1e5 && is_whole(n); }));
  command.add_option("--jobs", options.jobs, "cases at once, 1 if absent")
      ->check(number_as("a whole number as 2", [](double n) { return n >= 1 && n <= 1e4 && is_whole(n); }));
  command
      .add_option("--threads", output.threads,
                  "threads of a case; 0, as if absent, for as many as there are cores, divided by the jobs")
      ->check(number_as("a whole number as 2; 0 for one a core",
                        [](double n) { return n >= 0 && n <= 1e6 && is_whole(n); }));
  command
      .add_option("--memory-mb", options.memory_mb, "a case that needs more memory fails; no limit if absent")
      ->check(number_as("MB as 4000; 0 for no limit", [](double mb) { return mb >= 0; }));
  command.add_option("--time-limit", output.time_limit_s, "a case that takes more seconds fails")
      ->check(number_as("seconds as 60; 0 for no limit", [](double s) { return s >= 0; }));
  command.add_option("--base", options.base,
                     "address of the app, for the links of the page; http://127.0.0.1:8123/ if absent");
}

int run_study_command(const StudyOptions& options, const Output& output) {
  if (Status fits = check_options(options); !fits) return fail(fits.error(), output);
  const Result<Chunk> chunk = to_chunk(options.chunk);
  if (!chunk) return fail(chunk.error(), output);
  const Result<Study> study = read_study(options.input);
  if (!study) return fail(study.error(), output);
  const CaseLimits limits{
      .threads = output.threads > 0 ? output.threads : std::max(1, hardware_threads() / options.jobs),
      .memory_mb = options.memory_mb,
      .time_limit_s = output.time_limit_s};
  if (options.plan > 0) {
    const Status planned = write_plan(*study, options, limits);
    return planned ? kExitOk : fail(planned.error(), output);
  }
  Status done = std::monostate{};
  if (!options.table_only)
    done = run_study(*study, {.out = options.out,
                              .chunk = *chunk,
                              .jobs = options.jobs,
                              .limits = limits,
                              .on_case = [of = study->cases.size()](const StudyCase& one, const auto& record,
                                                                    bool was_there) {
                                print_case(one, of, record, was_there);
                              }});
  if (!done) return fail(done.error(), output);
  if (!options.chunk.empty()) return kExitOk;
  const Status written = write_table(*study, options);
  return written ? kExitOk : fail(written.error(), output);
}

}  // namespace voxtet
