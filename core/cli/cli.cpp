#include "cli/cli.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/digest.h"
#include "base/parallel.h"
#include "cli/case_input.h"
#include "cli/convert.h"
#include "cli/dump_results.h"
#include "cli/options.h"
#include "cli/print.h"
#include "cli/simulate.h"
#include "io/bytes/files.h"
#include "io/mesh/read_mesh.h"
#include "io/mesh/write_mesh.h"
#include "io/volume/write_volume.h"
#include "io/volume/write_vti.h"
#include "pipeline/exports/field_volume.h"
#include "pipeline/forecast.h"
#include "pipeline/report.h"
#include "pipeline/version/engine_version.h"
#include "recipe/link.h"

namespace voxtet {
namespace {

using nlohmann::json;

/// What `mesh` writes, and how far it goes.
struct MeshOptions {
  std::string out, report, dump;
  std::string until = name_of(Stage::kQuality);
  bool measures = false;  ///< in the mesh file
};

/// Before anything is read: a run may take long.
Status check_mesh_outputs(const CaseOptions& options, const MeshOptions& wanted, Stage until) {
  if (!wanted.out.empty()) {
    if (Result<MeshFormat> format = mesh_format_of(wanted.out); !format) return format.error();
    if (until < Stage::kTransfer)
      return usage_error("cli", "-o: there is no mesh to write when a run ends with the stage " +
                                    wanted.until + ", expected --until transfer or quality, or --dump");
  }
  std::vector<NamedPath> outputs{{"-o", wanted.out}, {"--report", wanted.report}};
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

int run_mesh(const CaseOptions& options, const MeshOptions& wanted, const Output& output) {
  const Result<Stage> until = stage_of(wanted.until);
  if (!until) return fail(until.error());
  if (Status there = check_mesh_outputs(options, wanted, *until); !there) return fail(there.error());
  Session session;
  if (Status opened = open_case(options, session); !opened) return fail(opened.error());
  if (!gives_fibres(session.recipe(), *until))
    if (Status none = check_no_fibres({"-o", wanted.out}); !none) return fail(none.error());
  RunContext ctx = printing_context(output.time_limit_s, output.threads);
  Status done = std::monostate{};
  // A mesh file also holds the labels that were transferred.
  if (!wanted.out.empty() && !needs(*until, Stage::kTransfer)) done = session.run(Stage::kTransfer, ctx);
  if (done) done = session.run(*until, ctx);
  json report = report_json(session);
  if (!done) {
    report["error"] = error_json(done.error());
    if (output.as_json) print_json(report);
    if (Status written = write_report(session, wanted, report); !written) fail(written.error());
    return fail_run(done.error(), output);
  }
  if (!wanted.out.empty())
    if (const int code = export_session(session, wanted.measures, wanted.out, output); code != kExitOk)
      return code;
  if (Status written = write_report(session, wanted, report); !written) return fail(written.error());
  if (output.as_json)
    print_json(report);
  else if (session.quality())
    print_report(report, stdout);
  else
    print_stages(report["stages"], stdout);
  if (session.quality() && !session.quality()->passed())
    return fail({ErrorCode::kMeshing, "quality", "the mesh fails a hard check, see the checklist", {}});
  return kExitOk;
}

int run_field(const CaseOptions& options, const std::string& name, const std::string& out,
              const Output& output) {
  const bool vti = out.ends_with(".vti");
  if (!vti && !is_nifti_name(out))
    return fail({ErrorCode::kUsage, "cli", out + ": a field is written as .nii, .nii.gz or .vti", {}});
  if (Status there = check_outputs({{"-o", out}}, inputs_of(options)); !there) return fail(there.error());
  Session session;
  if (Status opened = open_case(options, session); !opened) return fail(opened.error());
  RunContext ctx = printing_context(output.time_limit_s, output.threads);
  if (Status done = session.run(Stage::kSizing, ctx); !done) return fail_run(done.error(), output);
  const Result<ScalarVolume> field = field_volume(session, name);
  if (!field) return fail(field.error());
  const Result<Bytes> bytes = vti ? write_vti(*field, name) : write_nifti(*field, out.ends_with(".gz"));
  if (!bytes) return fail(bytes.error());
  if (Status written = place_files({{out, *bytes}}); !written) return fail(written.error());
  return kExitOk;
}

int run_forecast(const CaseOptions& options, double elements, const Output& output) {
  Session session;
  if (Status opened = open_case(options, session); !opened) return fail(opened.error());
  RunContext ctx = printing_context(output.time_limit_s, output.threads);
  if (Status done = session.run(Stage::kSizing, ctx); !done) return fail_run(done.error(), output);
  const Result<json> forecast = forecast_json(session, elements, ctx);
  if (!forecast) return fail_run(forecast.error(), output);
  if (output.as_json)
    print_json(*forecast);
  else
    print_forecast(*forecast, stdout);
  return kExitOk;
}

int run_check(const std::string& path, const Output& output) {
  Result<TetMesh> mesh = read_tet_mesh_file(path);
  if (!mesh) return fail(mesh.error());
  RunContext ctx;
  Result<QualityReport> report = measure_mesh(*mesh, {}, ctx);
  if (!report) return fail(report.error());
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

int run_phantom(const std::string& name, const std::vector<std::string>& set, const std::string& out) {
  Result<Recipe> recipe = with_field(Recipe{}, "source.phantom.kind", name);
  for (const std::string& text : set) {
    if (!recipe) break;
    const std::size_t at = text.find('=');
    if (at == std::string::npos)
      return fail({ErrorCode::kUsage, "cli", "--set " + text + ": expected NAME=VALUE", {}});
    recipe = with_field(*recipe, "source.phantom." + text.substr(0, at), text.substr(at + 1));
  }
  if (!recipe) return fail(recipe.error());
  Result<LabelVolume> volume = make_phantom(*recipe->source.phantom);
  if (!volume) return fail(volume.error());
  const bool gzip = out.ends_with(".gz");
  if (!is_nifti_name(out))
    return fail({ErrorCode::kUsage, "cli", out + ": a phantom is written as .nii or .nii.gz", {}});
  Result<Bytes> bytes = write_nifti(*volume, gzip);
  if (!bytes) return fail(bytes.error());
  if (Status written = place_files({{out, *bytes}}); !written) return fail(written.error());
  std::printf("%s: %d x %d x %d voxels, digest %s\n", out.c_str(), volume->size[0], volume->size[1],
              volume->size[2], digest_of(*volume).c_str());
  return kExitOk;
}

int run_url(const std::string& input, const std::string& base) {
  if (!is_link(input) && !input.ends_with(".json"))
    return fail(
        {ErrorCode::kUsage, "cli", input + ": expected a case file (.json) or a link with #c1= or #j=", {}});
  Result<Recipe> recipe = read_case(input);
  if (!recipe) return fail(recipe.error());
  if (is_link(input))
    print_json(recipe_to_json(*recipe, true));
  else
    std::printf("%s%s\n", base.c_str(), link_fragment(*recipe).c_str());
  return kExitOk;
}

int run_verify(const CaseOptions& options, const Output& output) {
  Session session;
  if (Status opened = open_case(options, session); !opened) return fail(opened.error());
  Result<Expected> expected = expected_of(session.recipe(), options.input);
  if (!expected) return fail(expected.error());
  RunContext ctx = printing_context(output.time_limit_s, output.threads);
  if (Status done = session.run(Stage::kOptimise, ctx); !done) return fail_run(done.error(), output);
  const std::string digest = digest_of(*session.mesh());
  const bool same = digest == expected->digest;
  const bool same_engine = expected->engine.empty() || expected->engine == engine_version();
  const std::string verdict = same ? "reproduced" : same_engine ? "differs" : "made with another engine";
  if (output.as_json)
    print_json({{"verdict", verdict},
                {"digest", digest},
                {"expected", expected->digest},
                {"tets", session.mesh()->tets.size()},
                {"expected_tets", expected->tets},
                {"engine", engine_version()},
                {"expected_engine", expected->engine}});
  else
    std::printf("%s\n  engine %s, expected %s\n  digest %s, expected %s\n  tets %zu, expected %u\n",
                verdict.c_str(), engine_version().c_str(),
                expected->engine.empty() ? "any" : expected->engine.c_str(), digest.c_str(),
                expected->digest.c_str(), session.mesh()->tets.size(), expected->tets);
  return same ? kExitOk : kExitDiffers;
}

}  // namespace

int run_cli(int argc, const char* const* argv) {
  CLI::App app{"voxtet " + engine_version() + ": segmented volumes to simulation-ready tetrahedra"};
  app.require_subcommand(1);
  app.set_version_flag("--version", engine_version());
  CaseOptions options;
  Output output;
  MeshOptions wanted;
  std::string in, out, base;
  std::vector<std::string> set;
  int code = kExitOk;

  CLI::App* mesh = app.add_subcommand("mesh", "mesh a volume or a case");
  add_case_options(*mesh, options, output, "VOLUME|CASE.json");
  mesh->add_option("-o,--output", wanted.out, "mesh file: .vtu .msh .mesh .carp .inp .feb .xdmf .stl .ply")
      ->check(kNotEmpty);
  mesh->add_option("--report", wanted.report, "write the report as JSON to this file")->check(kNotEmpty);
  mesh->add_option("--until", wanted.until, "end with this stage: volume, surface, smooth, ...");
  mesh->add_option("--dump", wanted.dump, "write what each stage gave into this folder")->check(kNotEmpty);
  mesh->add_flag("--measures", wanted.measures, "write the measures of tetrahedra into the mesh file too");
  mesh->add_option("--space", output.lps_or_ras, "patient space of the mesh file")
      ->check(CLI::IsMember({"ras", "lps"}));
  mesh->callback([&] { code = run_mesh(options, wanted, output); });

  SimulateOptions simulated;
  CLI::App* simulate = app.add_subcommand("simulate", "mesh a case and simulate its physics on the mesh");
  add_simulate_command(*simulate, options, simulated, output);
  simulate->callback([&] { code = run_simulate(options, simulated, output); });

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
      ->check(CLI::PositiveNumber);
  forecast->callback([&] { code = run_forecast(options, elements, output); });

  CLI::App* verify = app.add_subcommand("verify", "mesh a case and compare with the digest it promises");
  add_case_options(*verify, options, output, "CASE.json");
  verify->callback([&] { code = run_verify(options, output); });

  CLI::App* check = app.add_subcommand("check", "measure a mesh file");
  check->add_option("MESH", in, ".vtu .msh .mesh .elem .carp")->required();
  check->add_flag("--json", output.as_json, "print the report as JSON");
  check->callback([&] { code = run_check(in, output); });

  CLI::App* phantom = app.add_subcommand("phantom", "generate a body as a label volume");
  phantom->add_option("NAME", in, "sphere, shell, torus, slab, nested_boxes, branching_tube, biventricle")
      ->required();
  phantom->add_option("--set", set, "a field of the phantom, as spacing_mm=[1,1,1]");
  phantom->add_option("-o,--output", out, ".nii or .nii.gz")->required();
  phantom->callback([&] { code = run_phantom(in, set, out); });

  ConvertOptions converted;
  CLI::App* convert = app.add_subcommand("convert", "convert a mesh file, or a volume to NIfTI");
  add_convert_command(*convert, converted, output);
  convert->callback([&] { code = run_convert(converted, output); });

  CLI::App* url = app.add_subcommand("url", "the link of a case, or the case of a link");
  url->add_option("CASE.json", in)->required();
  url->add_option("--base", base, "address of the app, put before the link's fragment");
  url->callback([&] { code = run_url(in, base); });

  CLI::App* schema = app.add_subcommand("schema", "the fields of a case, as JSON");
  schema->callback([&] { print_json(schema_json()); });

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitOk : kExitUsage;
  } catch (const std::bad_alloc&) {
    return fail({ErrorCode::kOutOfMemory, "cli", "out of memory", {}});
  } catch (const std::exception& error) {
    return fail({ErrorCode::kInternal, "cli", error.what(), {}});
  }
  return code;
}

}  // namespace voxtet
