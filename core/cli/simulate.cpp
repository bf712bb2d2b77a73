#include "cli/simulate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <utility>

#include "cli/cli.h"
#include "cli/print.h"
#include "io/bytes/files.h"
#include "io/mesh/write_igb.h"
#include "pipeline/exports/carp_case.h"
#include "pipeline/report.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

using nlohmann::json;

Status check_simulate_outputs(const CaseOptions& options, const SimulateOptions& wanted) {
  if (!wanted.out.empty()) {
    Result<MeshFormat> format = mesh_format_of(wanted.out);
    if (!format) return format.error();
    if (!has_place_for(On::kPoints, 1, *format))
      return usage_error("cli", "-o " + wanted.out +
                                    ": this format has no place for values at points, expected .vtu, .vtk, "
                                    ".xdmf or .carp");
  }
  if (!wanted.frames.empty() && !wanted.frames.ends_with(".igb"))
    return usage_error("cli", "--frames " + wanted.frames + ": frames are written as .igb");
  return check_outputs({{"-o", wanted.out},
                        {"--report", wanted.report},
                        {"--traces", wanted.traces},
                        {"--frames", wanted.frames},
                        {"--save-state", wanted.save_state}},
                       inputs_of(options));
}

/// A column of times, then one for each trace.
std::string traces_csv(const Trajectory& result) {
  std::ostringstream out;
  out << "time_ms";
  for (const Trace& trace : result.traces) out << "," << trace.name << "_" << trace.unit;
  for (std::size_t i = 0; i < result.trace_times_ms.size(); ++i) {
    out << "\n" << result.trace_times_ms[i];
    for (const Trace& trace : result.traces) out << "," << trace.values[i];
  }
  out << "\n";
  return out.str();
}

/// Frames of the voltage, collected while the model runs: for each multiple of the recipe's `frame_ms` the
/// first that is not before it. One at an end between two multiples has no place in an .igb. Points that do
/// not conduct are written at rest.
class VoltageFrames {
 public:
  explicit VoltageFrames(double interval_ms) : interval_ms_(interval_ms) {}
  void add(const Snapshot& frame) {
    const Field& voltage = frame.fields[0];
    // A run that goes on from a state begins at any time.
    if (!writer_)
      writer_.emplace(voltage.values.size(), voltage.unit,
                      std::max(0.0, interval_ms_ * std::ceil(frame.time_ms / interval_ms_ - kRounding)),
                      interval_ms_, kRestingVoltageMv);
    while (frame.time_ms > writer_->next_ms() - kRounding) writer_->add(voltage.values);
  }
  bool empty() const { return !writer_ || writer_->frames() == 0; }
  Bytes take() { return writer_->take(); }

 private:
  static constexpr double kRounding = 1e-6;
  double interval_ms_;
  std::optional<IgbWriter> writer_;
};

/// The mesh with what was found on it; for openCARP a case that runs there.
int export_simulation(const Session& session, const std::string& path, const Output& output) {
  const Result<MeshFormat> format = mesh_format_of(path);
  if (!format) return fail(format.error(), output);
  if (*format != MeshFormat::kCarp) return export_session(session, false, path, output);
  const Result<std::vector<OutputFile>> files = carp_case_files(session, output.space(), mesh_name_of(path));
  if (!files) return fail(files.error(), output);
  if (Status written = write_files(path, *files); !written) return fail(written.error(), output);
  return kExitOk;
}

void print_simulation(const json& simulation) {
  for (const auto& [name, found] : simulation.items()) {
    std::printf("%s\n", name.c_str());
    for (const auto& [key, value] : found.items())
      if (key != "traces") std::printf("  %-22s %s\n", key.c_str(), value.dump().c_str());
  }
}

/// What the case asks for.
Result<Stage> stage_to_run(const Recipe& recipe, const std::string& what) {
  if (!recipe.physics)
    return usage_error("cli", "physics: found none in the case, expected what is to be simulated");
  if (!what.empty()) return stage_of(what);
  if (recipe.physics->mechanics) return Stage::kMechanics;
  return recipe.physics->monodomain ? Stage::kMonodomain : Stage::kEikonal;
}

}  // namespace

void add_simulate_command(CLI::App& command, CaseOptions& options, SimulateOptions& wanted, Output& output) {
  add_case_options(command, options, output, "CASE.json");
  command
      .add_option("-o,--output", wanted.out,
                  "mesh file with what was found at its points: .vtu .vtk .xdmf .carp")
      ->check(kNotEmpty);
  command.add_option("--report", wanted.report, "write the report as JSON to this file")->check(kNotEmpty);
  command
      .add_option("--traces", wanted.traces,
                  "write the electrodes' potentials, or volumes and pressures of a beating heart, as CSV to "
                  "this file")
      ->check(kNotEmpty);
  command.add_option("--frames", wanted.frames, "write the voltage of each frame to this file, .igb")
      ->check(kNotEmpty);
  command
      .add_option("--save-state", wanted.save_state,
                  "write the state at the end to this file, for --from-state of a later run")
      ->check(kNotEmpty);
  command
      .add_option("--from-state", wanted.from_state,
                  "go on from this state: of a case that differs in its end, in later stimuli or in the "
                  "number of beats "
                  "only")
      ->check(kNotEmpty);
  command.add_option("--what", wanted.what, "mechanics, monodomain, or eikonal: the activation map alone")
      ->check(CLI::IsMember({kMechanicsStage, kMonodomainStage, kEikonalStage}));
  command.add_option("--space", output.lps_or_ras, "patient space of the mesh file")
      ->check(CLI::IsMember({"ras", "lps"}));
}

int run_simulate(const CaseOptions& options, const SimulateOptions& wanted, const Output& output) {
  if (Status there = check_simulate_outputs(options, wanted); !there) return fail(there.error(), output);
  RunContext ctx = context_of(output);
  Session session;
  if (Status opened = open_case(options, session); !opened) return fail(opened.error(), output);
  const Result<Stage> stage = stage_to_run(session.recipe(), wanted.what);
  if (!stage) return fail(stage.error(), output);
  if (!wanted.traces.empty() && *stage != Stage::kMechanics &&
      (*stage != Stage::kMonodomain || session.recipe().physics->monodomain->electrodes.empty()))
    return fail(usage_error("cli", "--traces: found no physics.monodomain.electrodes, expected at least one"),
                output);
  if (!wanted.frames.empty() && *stage != Stage::kMonodomain)
    return fail(usage_error("cli", "--frames: found no physics.monodomain to run, expected one"), output);
  if (*stage == Stage::kEikonal && !(wanted.save_state + wanted.from_state).empty())
    return fail(usage_error("cli", "--save-state, --from-state: the activation map alone has no state"),
                output);
  if (!wanted.from_state.empty()) {
    Result<Bytes> state = read_file(wanted.from_state);
    if (!state) return fail(state.error(), output);
    session.resume_from(*stage, *std::move(state));
  }
  if ((wanted.out + wanted.report + wanted.traces + wanted.frames + wanted.save_state).empty() &&
      !output.as_json)
    print_note("no -o: the report will be printed, and no mesh written");
  Status done = session.run(Stage::kQuality, ctx);
  std::optional<VoltageFrames> frames;
  if (done && !wanted.frames.empty()) {
    frames.emplace(session.recipe().physics->monodomain->frame_ms);
    ctx.on_snapshot = [&](const Snapshot& frame) { frames->add(frame); };
  }
  if (done) done = session.run(*stage, ctx);
  json report = report_json(session);
  if (!done) report["error"] = error_json(run_error(done.error(), output));
  if (!wanted.report.empty())
    if (Status written = write_text_file(wanted.report, text_of(report)); !written)
      return fail(written.error(), output);
  if (!wanted.save_state.empty() && (done || done.error().code == ErrorCode::kCancelled))
    if (Result<Bytes> state = session.saved_state(); state)
      if (Status placed = place_files({{wanted.save_state, *state}}); !placed)
        return fail(placed.error(), output);
  if (!done) {
    if (output.as_json) print_json(report);
    return fail(run_error(done.error(), output));
  }
  if (!wanted.traces.empty()) {
    const Trajectory* recorded = session.monodomain();
    if (*stage == Stage::kMechanics) recorded = session.mechanics();
    if (Status written = write_text_file(wanted.traces, traces_csv(*recorded)); !written)
      return fail(written.error(), output);
  }
  if (frames && frames->empty())
    print_warning("--frames: found no frame at a multiple of physics.monodomain.frame_ms, wrote no file");
  else if (frames)
    if (Status written = place_files({{wanted.frames, frames->take()}}); !written)
      return fail(written.error(), output);
  if (!wanted.out.empty())
    if (const int code = export_simulation(session, wanted.out, output); code != kExitOk) return code;
  if (output.as_json) {
    print_json(report);
  } else {
    print_stages(report["stages"], stdout);
    print_simulation(report["simulation"]);
  }
  return kExitOk;
}

}  // namespace voxtet
