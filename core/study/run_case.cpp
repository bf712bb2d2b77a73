#include "study/run_case.h"

#include <chrono>
#include <cstdio>
#include <new>

#include "io/mesh/write_mesh.h"
#include "pipeline/case_files.h"
#include "pipeline/exports/exported_fields.h"
#include "pipeline/forecast.h"
#include "pipeline/memory.h"
#include "pipeline/report.h"
#include "pipeline/version/engine_version.h"
#include "recipe/link.h"
#include "study/figures.h"
#include "study/picture.h"

namespace voxtet {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

RunContext context_of(const CaseLimits& limits, Clock::time_point start) {
  RunContext ctx;
  ctx.threads = limits.threads;
  if (limits.time_limit_s > 0)
    ctx.on_cancelled = [start, most = limits.time_limit_s] { return seconds_since(start) > most; };
  return ctx;
}

Status open(const StudyCase& one, const StudyPlan& plan, Session& session) {
  Recipe recipe = one.recipe;
  if (!one.volume_path.empty()) {
    const auto load = [&](const VolumeFile& file) { return session.load_volume(file, recipe.source.read); };
    if (Status loaded = open_case_file(one.volume_path, load); !loaded) return loaded;
    if (recipe.source.file->sha256.empty()) recipe.source.file->sha256 = session.files().digest;
  }
  if (Status loaded = load_side_files(side_paths(recipe, plan.folder), session); !loaded) return loaded;
  return session.set_recipe(recipe);
}

/// The machine failed, not the case.
bool is_of_machine(const Error& error) {
  if (error.code == ErrorCode::kCancelled) return true;
  return error.code == ErrorCode::kOutOfMemory && error.stage != "forecast";
}

/// A text in which no path begins with a folder any more.
std::string without(std::string text, const std::string& folder) {
  const std::string beginning = folder + "/";
  for (std::size_t at = 0; !folder.empty() && (at = text.find(beginning, at)) != std::string::npos; ++at)
    if (at == 0 || text[at - 1] == ' ') text.erase(at, beginning.size());
  return text;
}

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

/// Why a case failed. Where the study lies is nothing that its table depends on.
std::string reason_of(const Error& error, const StudyPlan& plan, const CaseLimits& limits) {
  if (error.code == ErrorCode::kCancelled)
    return "given up after the " + number_text(limits.time_limit_s) + " s of --time-limit";
  if (is_of_machine(error) && limits.memory_mb > 0)
    return error.message + ", with the " + number_text(limits.memory_mb) + " MB of --memory-mb";
  return without(without(error.message, plan.folder), plan.study_folder);
}

Json unknown_cost() {
  return {
      {"seconds", nullptr}, {"peak_mb", nullptr}, {"forecast_seconds", nullptr}, {"forecast_mb", nullptr}};
}

Json record_of(const Recipe& recipe, const std::string& key, const Json& figures) {
  return {{"key", key},     {"status", "done"},   {"stage", nullptr},       {"reason", nullptr},
          {"again", false}, {"figures", figures}, {"cost", unknown_cost()}, {"link", link_fragment(recipe)}};
}

void put_failure(Json& record, const std::string& stage, const std::string& reason, bool again) {
  record["status"] = "failed";
  record["stage"] = stage;
  record["reason"] = reason;
  record["again"] = again;
}

/// What is kept of a case that is done.
Status add_kept(const Session& session, const StudyPlan& plan, const std::string& key,
                std::vector<CaseFile>& files) {
  for (const std::string& ending : plan.keep) {
    if (ending == "report") {
      const std::string text = report_json(session).dump(1);
      files.push_back({"files/" + key + ".report.json", Bytes(text.begin(), text.end())});
      continue;
    }
    const Result<MeshFormat> format = mesh_format_of(key + "." + ending);
    if (!format) return format.error();
    Exported exported = exported_fields(session, *format, false);
    exported.options.name = key;
    Result<std::vector<OutputFile>> written = write_tet_mesh(*session.mesh(), *format, exported.options);
    if (!written) return written.error();
    for (OutputFile& file : *written) files.push_back({"files/" + key + file.suffix, std::move(file.bytes)});
  }
  return std::monostate{};
}

Status run_stages(const StudyPlan& plan, Session& session, RunContext& ctx, Json& cost) {
  if (!session.opened_mesh()) {
    if (Status done = session.run(Stage::kSizing, ctx); !done) return done;
    if (const Result<Forecast> forecast = forecast_case(session, ctx)) {
      cost["forecast_seconds"] = forecast->seconds;
      cost["forecast_mb"] = forecast->peak_mb;
    }
  }
  for (const Stage stage : plan.stages)
    if (Status done = session.run(stage, ctx); !done) return done;
  return std::monostate{};
}

}  // namespace

Json failed_record(const StudyCase& one, const std::string& key, const std::string& stage,
                   const std::string& reason) {
  Json record = record_of(one.recipe, key, no_figures());
  put_failure(record, stage, reason, true);
  return record;
}

CaseOutcome run_case(const StudyCase& one, const StudyPlan& plan, const std::string& key,
                     const CaseLimits& limits) {
  const Clock::time_point start = Clock::now();
  RunContext ctx = context_of(limits, start);
  reset_peak_memory();
  CaseOutcome outcome;
  Session session(0);
  Json cost = unknown_cost();
  Status done = std::monostate{};
  try {
    done = open(one, plan, session);
    if (done) done = run_stages(plan, session, ctx, cost);
    cost["seconds"] = seconds_since(start);
    cost["peak_mb"] = peak_memory_mb();
    if (session.mesh()) outcome.files.push_back({"pictures/" + key + ".png", picture_of(session)});
    if (done) done = add_kept(session, plan, key, outcome.files);
  } catch (const std::bad_alloc&) {
    done = Error{ErrorCode::kOutOfMemory, "study", "out of memory", {}};
  }
  if (!done) {
    // How far a machine came that failed is by chance.
    const bool of_machine = is_of_machine(done.error());
    outcome.record = record_of(one.recipe, key, of_machine ? no_figures() : figures_of(session));
    put_failure(outcome.record, done.error().stage, reason_of(done.error(), plan, limits), of_machine);
    if (of_machine) outcome.files.clear();
  } else {
    Recipe recipe = session.recipe();
    recipe.expected = promise_of(session);
    outcome.record = record_of(recipe, key, figures_of(session));
  }
  outcome.record["cost"] = cost;
  return outcome;
}

Result<Forecast> forecast_of(const StudyCase& one, const StudyPlan& plan, const CaseLimits& limits) {
  RunContext ctx = context_of(limits, Clock::now());
  Session session(0);
  if (Status opened = open(one, plan, session); !opened) return opened.error();
  if (Status done = session.run(Stage::kSizing, ctx); !done) return done.error();
  return forecast_case(session, ctx);
}

}  // namespace voxtet
