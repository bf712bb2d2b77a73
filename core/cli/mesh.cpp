#include "cli/mesh.h"

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "cli/cli.h"
#include "cli/dump_results.h"
#include "cli/print.h"
#include "cli/words/option_texts.h"
#include "io/bytes/files.h"
#include "pipeline/exports/mechanics_case.h"
#include "pipeline/exports/second_order.h"
#include "pipeline/report.h"

namespace voxtet {
namespace {

using nlohmann::json;

/// Before anything is read: a run may take long.
Status check_mesh_outputs(const CaseOptions& options, const MeshOptions& wanted, Stage until,
                          const Output& output) {
  const Result<std::string> out = mesh_path_of(wanted.out, output);
  if (!out) return out.error();
  if (wanted.out == kDash && output.as_json)
    return usage_error("cli",
                       "--json: found -o -, which has standard output for the mesh; expected --report FILE");
  if (!wanted.out.empty()) {
    if (const Result<MeshFormat> format = written_format(*out, output); !format) return format.error();
    if (until < Stage::kTransfer)
      return usage_error("cli", "-o: there is no mesh to write when a run ends with the stage " +
                                    wanted.until + ", expected --until transfer or quality, or --dump");
  }
  if (!wanted.mechanics.empty())
    if (const Result<MechanicsProgram> program = mechanics_program_of(wanted.mechanics); !program)
      return program.error();
  std::vector<NamedPath> outputs{{"-o", wanted.out == kDash ? "" : wanted.out},
                                 {"--mechanics", wanted.mechanics},
                                 {"--report", wanted.report}};
  if (!wanted.dump.empty()) {
    std::error_code failed;
    std::filesystem::create_directories(wanted.dump, failed);  // what cannot be made is found below
    for (const std::string& path : files_of_dump(wanted.dump)) outputs.push_back({"--dump", path});
  }
  return check_outputs(outputs, inputs_of(options));
}

/// Writes what was asked for, also when a run has failed: then its report ends with the error.
Status write_report(const Session& session, const MeshOptions& wanted, const json& report) {
  if (!wanted.dump.empty())
    if (Status written = dump_results(session, wanted.dump); !written) return written;
  if (wanted.report.empty()) return std::monostate{};
  return write_text_file(wanted.report, text_of(report));
}

/// Said before the stages run, which may take long.
void note_no_output(const MeshOptions& wanted, const Output& output) {
  const bool asked = output.as_json || !(wanted.out + wanted.mechanics + wanted.report + wanted.dump).empty();
  if (!asked) print_note("no -o: the report will be printed, and no mesh written");
}

/// A case of mechanics, its files beside `path`.
Status export_mechanics(const Session& session, const std::string& path, const Output& output) {
  const Result<MechanicsProgram> program = mechanics_program_of(path);
  if (!program) return program.error();
  WriteMeshOptions options{.space = output.space(), .name = mesh_name_of(path)};
  if (output.order == 2) {
    CurvedNodes curved = second_order_nodes(session, context_of(output).threads);
    print_note(path + ": " + note_of(curved));
    options.midside = std::move(curved.nodes);
  }
  const Result<std::vector<OutputFile>> files = mechanics_case_files(session, *program, std::move(options));
  if (!files) return files.error();
  const std::string ending(mesh_ending_of(path)), base = path.substr(0, path.size() - ending.size());
  std::vector<TargetFile> targets;
  for (const OutputFile& file : *files)
    targets.push_back({&file == &files->front() ? path : base + file.suffix, file.bytes});
  return place_files(targets);
}

/// The mesh is there, without what was asked of it.
Error layers_error(const LayerCount& count) {
  char text[192];
  std::snprintf(text, sizeof text,
                "exact layers were given up: %u layers on %.1f %% of the wall's area, expected %.0f %%; the "
                "report's layers name the places",
                count.target_layers, 100 * count.by_edges.exact, 100 * LayerCount::kNearlyAll);
  return {ErrorCode::kMeshing, "quality", text, {}};
}

/// What went wrong, in the stages or with what they made.
std::optional<Error> error_of(const Status& done, const Session& session, const Output& output) {
  if (!done) return run_error(done.error(), output);
  if (session.quality() && !session.quality()->passed())
    return Error{ErrorCode::kMeshing, "quality", "the mesh fails a hard check, see the checklist", {}};
  if (session.quality())
    for (const LayerCount& count : session.quality()->layers)
      if (count.given_up()) return layers_error(count);
  return std::nullopt;
}

}  // namespace

void add_mesh_command(CLI::App& command, CaseOptions& options, MeshOptions& wanted, Output& output) {
  add_case_options(command, options, output, "VOLUME|CASE.json");
  command
      .add_option(
          "-o,--output", wanted.out,
          "mesh file: .vtu .vtk .msh .mesh .carp .inp .bdf .feb .xdmf .ele .stl .ply; or - for standard "
          "output")
      ->check(kNotEmpty);
  command.add_option("--output-format", output.mesh_format,
                     "of the mesh on standard output: vtu, vtk, msh, mesh, inp, bdf, feb, stl or ply");
  command
      .add_option("--mechanics", wanted.mechanics,
                  "write a case of passive inflation: .feb for FEBio, or .xml with its meshes for "
                  "svMultiPhysics")
      ->check(kNotEmpty);
  command.add_option("--report", wanted.report, "write the report as JSON to this file")->check(kNotEmpty);
  command.add_option("--until", wanted.until, "end with this stage: volume, surface, smooth, ...");
  command.add_option("--dump", wanted.dump, "write what each stage gave into this folder")->check(kNotEmpty);
  command.add_flag("--measures", wanted.measures, "write the measures of tetrahedra into the mesh file too");
  add_write_options(command, output);
}

int run_mesh(const CaseOptions& options, const MeshOptions& wanted, const Output& output) {
  const Result<Stage> until = stage_of(wanted.until);
  if (!until) return fail(until.error(), output);
  if (Status there = check_mesh_outputs(options, wanted, *until, output); !there)
    return fail(there.error(), output);
  RunContext ctx = context_of(output);
  Session session;
  if (Status opened = open_case(options, session); !opened) return fail(opened.error(), output);
  if (!gives_fibres(session.recipe(), *until))
    if (Status none = check_no_fibres({"-o", wanted.out}); !none) return fail(none.error(), output);
  note_no_output(wanted, output);
  Status done = std::monostate{};
  // A mesh file also holds the labels that were transferred.
  if (!wanted.out.empty() && !needs(*until, Stage::kTransfer)) done = session.run(Stage::kTransfer, ctx);
  if (done && !wanted.mechanics.empty()) done = session.run(Stage::kFibres, ctx);
  if (done) done = session.run(*until, ctx);
  const std::optional<Error> failed = error_of(done, session, output);
  json report = report_json(session);
  if (failed) report["error"] = error_json(*failed);
  if (done && !wanted.out.empty())
    if (const int code = export_session(session, wanted.measures, wanted.out, output); code != kExitOk)
      return code;
  if (done && !wanted.mechanics.empty())
    if (Status placed = export_mechanics(session, wanted.mechanics, output); !placed)
      return fail(placed.error(), output);
  const Status written = write_report(session, wanted, report);
  if (!written && !failed) return fail(written.error(), output);
  if (!written) fail(written.error());
  // Where the mesh goes to standard output, nothing else does.
  std::FILE* out = wanted.out == kDash ? stderr : stdout;
  if (output.as_json)
    print_json(report);
  else if (done && session.quality())
    print_report(report, out);
  else if (done)
    print_stages(report["stages"], out);
  return failed ? fail(*failed) : kExitOk;
}

}  // namespace voxtet
