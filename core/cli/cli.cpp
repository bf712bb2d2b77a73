#include "cli/cli.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/digest.h"
#include "cli/convert.h"
#include "cli/input/case_input.h"
#include "cli/mesh.h"
#include "cli/options.h"
#include "cli/phantom.h"
#include "cli/print.h"
#include "cli/simulate.h"
#include "cli/study.h"
#include "cli/verify.h"
#include "cli/words/option_texts.h"
#include "io/bytes/files.h"
#include "io/mesh/read_mesh.h"
#include "io/volume/write_volume.h"
#include "io/volume/write_vti.h"
#include "pipeline/exports/field_volume.h"
#include "pipeline/forecast.h"
#include "pipeline/report.h"
#include "pipeline/sources/source_volume.h"
#include "pipeline/version/engine_version.h"
#include "recipe/link.h"

namespace voxtet {
namespace {

using nlohmann::json;

int run_field(const CaseOptions& options, const std::string& name, const std::string& out,
              const Output& output) {
  const bool vti = out.ends_with(".vti");
  if (!vti && !is_nifti_name(out))
    return fail({ErrorCode::kUsage, "cli", out + ": a field is written as .nii, .nii.gz or .vti", {}},
                output);
  if (Status there = check_outputs({{"-o", out}}, inputs_of(options)); !there)
    return fail(there.error(), output);
  RunContext ctx = context_of(output);
  Session session;
  if (Status opened = open_case(options, session); !opened) return fail(opened.error(), output);
  if (Status done = session.run(Stage::kSizing, ctx); !done) return fail_run(done.error(), output);
  const Result<ScalarVolume> field = field_volume(session, name);
  if (!field) return fail(field.error(), output);
  const Result<Bytes> bytes = vti ? write_vti(*field, name) : write_nifti(*field, out.ends_with(".gz"));
  if (!bytes) return fail(bytes.error(), output);
  if (Status written = place_files({{out, *bytes}}); !written) return fail(written.error(), output);
  return kExitOk;
}

int run_forecast(const CaseOptions& options, double elements, const Output& output) {
  RunContext ctx = context_of(output);
  Session session;
  if (Status opened = open_case(options, session); !opened) return fail(opened.error(), output);
  if (Status done = session.run(Stage::kSizing, ctx); !done) return fail_run(done.error(), output);
  const Result<json> forecast = forecast_json(session, elements, ctx);
  if (!forecast) return fail_run(forecast.error(), output);
  if (output.as_json)
    print_json(*forecast);
  else
    print_forecast(*forecast, stdout);
  return kExitOk;
}

Result<TetMesh> read_mesh(const std::string& path, const std::string& label_array, MeshArrays& arrays) {
  if (path != kDash) return read_tet_mesh_file(path, &arrays, label_array);
  const Result<Bytes> bytes = read_standard_input();
  if (!bytes) return bytes.error();
  return read_tet_mesh({"stdin", *bytes, {}}, &arrays, label_array);
}

int run_check(const std::string& path, const std::string& label_array, const Output& output) {
  MeshArrays arrays;
  Result<TetMesh> mesh = read_mesh(path, label_array, arrays);
  if (!mesh) return fail(mesh.error(), output);
  for (const std::string& note : arrays.notes) print_note(path + ": " + note);
  RunContext ctx;
  Result<QualityReport> report = measure_mesh(*mesh, {}, ctx);
  if (!report) return fail(report.error(), output);
  const json quality = quality_json(*report);
  if (output.as_json) {
    print_json({{"digest", digest_of(*mesh)},
                {"tets", mesh->tets.size()},
                {"points", mesh->points.size()},
                {"quality", quality}});
  } else {
    std::printf("%zu tetrahedra, %zu points\n", mesh->tets.size(), mesh->points.size());
    print_quality(quality, stdout);
  }
  return report->passed() ? kExitOk : kExitMeshing;
}

/// A case with its volume within it.
Result<Recipe> inlined_case(const CaseOptions& options) {
  Session session;
  if (Status opened = open_case(options, session); !opened) return opened.error();
  if (!session.files().volume)
    return Error{
        ErrorCode::kUsage, "cli", options.input + ": --inline expects a label volume, or a case of one", {}};
  return with_inline_volume(session.recipe(), *session.files().volume);
}

int run_url(const CaseOptions& options, const std::string& base, bool inlined) {
  const std::string& input = options.input;
  if (!inlined && !is_link(input) && !input.ends_with(".json"))
    return fail({ErrorCode::kUsage,
                 "cli",
                 input + ": expected a case file (.json), a link with #c1= or #j=, or a volume and --inline",
                 {}});
  Result<Recipe> recipe = inlined ? inlined_case(options) : read_case(input);
  if (!recipe) return fail(recipe.error());
  if (is_link(input) && !inlined)
    print_json(recipe_to_json(*recipe, true));
  else
    std::printf("%s%s\n", base.c_str(), link_fragment(*recipe).c_str());
  return kExitOk;
}

}  // namespace

int run_cli(int argc, const char* const* argv) {
  CLI::App app{"voxtet " + engine_version() + ": segmented volumes to simulation-ready tetrahedra"};
  app.require_subcommand(1);
  app.set_version_flag("--version", engine_version());
  CaseOptions options;
  Output output;
  MeshOptions wanted;
  std::string in, out, base, label_array;
  int code = kExitOk;

  CLI::App* mesh = app.add_subcommand("mesh", "mesh a volume or a case");
  add_mesh_command(*mesh, options, wanted, output);
  mesh->callback([&] { code = run_mesh(options, wanted, output); });

  SimulateOptions simulated;
  CLI::App* simulate = app.add_subcommand("simulate", "mesh a case and simulate its physics on the mesh");
  add_simulate_command(*simulate, options, simulated, output);
  simulate->callback([&] { code = run_simulate(options, simulated, output); });

  StudyOptions studied;
  CLI::App* study = app.add_subcommand("study", "run a table of cases and compare what they give");
  add_study_command(*study, studied, output);
  study->callback([&] { code = run_study_command(studied, output); });

  CLI::App* field =
      app.add_subcommand("field", "write edge length, wall thickness or wall potential as an image");
  add_case_options(*field, options, output, "VOLUME|CASE.json");
  std::string what = "size";
  field->add_option("--what", what, "size, thickness or potential")
      ->check(CLI::IsMember({"size", "thickness", "potential"}));
  field->add_option("-o,--output", out, ".nii, .nii.gz or .vti")->required();
  field->callback([&] { code = run_field(options, what, out, output); });

  CLI::App* forecast = app.add_subcommand("forecast", "elements, memory and time of a case, before meshing");
  add_case_options(*forecast, options, output, "VOLUME|CASE.json");
  double elements = 0;
  forecast->add_option("--elements", elements, "also the edge lengths that give so many tetrahedra")
      ->check(number_as("how many as 500000", [](double n) { return n > 0; }));
  forecast->callback([&] { code = run_forecast(options, elements, output); });

  CLI::App* verify = app.add_subcommand("verify", "run a case and compare with the digests it promises");
  add_case_options(*verify, options, output, "CASE.json");
  verify->callback([&] { code = run_verify(options, output); });

  CLI::App* check = app.add_subcommand("check", "measure a mesh file");
  check
      ->add_option("MESH", in,
                   ".vtu .vtk .msh .mesh .xdmf .inp .bdf .feb .ele .elem .carp, or - for standard input")
      ->required();
  check->add_option("--label-array", label_array, kLabelArrayHelp)->check(kNotEmpty);
  check->add_flag("--json", output.as_json, "print the report, or the error, as JSON");
  check->callback([&] { code = run_check(in, label_array, output); });

  PhantomOptions generated;
  CLI::App* phantom =
      app.add_subcommand("phantom", "generate a body, or a cohort of hearts, as label volumes");
  add_phantom_command(*phantom, generated);
  phantom->callback([&] { code = run_phantom(generated); });

  ConvertOptions converted;
  CLI::App* convert = app.add_subcommand("convert", "convert a mesh file, or a volume to NIfTI");
  add_convert_command(*convert, converted, output);
  convert->callback([&] { code = run_convert(converted, output); });

  CLI::App* url = app.add_subcommand("url", "the link of a case, or the case of a link");
  url->add_option("CASE.json", options.input)->required();
  url->add_option("--base", base, "address of the app, put before the link's fragment");
  bool inlined = false;
  url->add_flag("--inline", inlined, "with the volume itself in the link; of a volume the case by default");
  url->callback([&] { code = run_url(options, base, inlined); });

  CLI::App* schema = app.add_subcommand("schema", "the fields of a case, as JSON");
  bool standard = false;
  schema->add_flag("--json-schema", standard, "as a JSON Schema, for editors and validators");
  schema->callback([&] { print_json(standard ? recipe_json_schema() : schema_json()); });

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool as_json = std::find(argv, argv + argc, std::string_view("--json")) != argv + argc;
    if (as_json && error.get_exit_code() != 0)
      print_json({{"error", error_json(usage_error("cli", error.what()))}});
    return app.exit(error) == 0 ? kExitOk : kExitUsage;
  } catch (const std::bad_alloc&) {
    return fail({ErrorCode::kOutOfMemory, "cli", "out of memory", {}}, output);
  } catch (const std::exception& error) {
    return fail({ErrorCode::kInternal, "cli", error.what(), {}}, output);
  }
  return code;
}

}  // namespace voxtet
