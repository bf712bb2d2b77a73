#include "cli/options.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/cli.h"
#include "cli/print.h"
#include "pipeline/exports/exported_fields.h"

namespace voxtet {

using nlohmann::json;

bool is_nifti_name(const std::string& path) {
  return path.ends_with(".nii") || path.ends_with(".nii.gz");
}

const CLI::Validator kNotEmpty(
    [](const std::string& text) { return text.empty() ? std::string("found '', expected a value") : ""; },
    "");

void add_case_options(CLI::App& command, CaseOptions& options, Output& output,
                      const std::string& input_name) {
  command
      .add_option(input_name, options.input, "volume (.nii .nii.gz .nrrd .nhdr .mha .mhd), case.json or link")
      ->required();
  command.add_option("--labels", options.labels, "labels to mesh, as 1,2,5; all if absent")->delimiter(',');
  command
      .add_option("--merge", options.merge,
                  "mesh the labels 1,5,6 as one region (once a group), or all of them; after the input")
      ->expected(0, 1000)
      ->allow_extra_args(false)
      ->type_name("LABELS");
  command
      .add_option("--transfer,--look-up", options.transfer, "labels to transfer to the tetrahedra, as 5,6")
      ->delimiter(',');
  command.add_option("--edge-mm", options.edge_mm, "edge length, mm")->check(kNotEmpty);
  command.add_option("--edge-label", options.edge_labels, "edge length inside a label, as 5=0.8");
  command.add_option("--mask", options.masks, "label volume painted over the input, sized by --mask-edge");
  command.add_option("--mask-edge", options.mask_edges, "edge length inside a label of the masks, as 1=0.8");
  command.add_option("--size-image", options.size_images, "NIfTI image of edge lengths, mm");
  add_read_options(command, options.read);
  command.add_option("--set", options.set, "any field of the recipe, as sizing.gradation=0.2");
  command.add_flag("--json", output.as_json, "print the report as JSON");
  command.add_option("--time-limit", output.time_limit_s, "give up after so many seconds")
      ->check(CLI::NonNegativeNumber);
  command.add_option("--threads", output.threads, "threads to use; the result is the same for any number")
      ->check(CLI::PositiveNumber);
}

std::string text_of(const json& value) {
  return value.dump(1, ' ', false, json::error_handler_t::replace);
}

void print_json(const json& value) {
  std::printf("%s\n", text_of(value).c_str());
}

int fail_run(Error error, const Output& output) {
  if (error.code == ErrorCode::kCancelled)
    error.message = "given up after the " + json(output.time_limit_s).dump() + " s of --time-limit";
  return fail(error);
}

int export_mesh(const TetMesh& mesh, WriteMeshOptions options, const std::string& path,
                const Output& output) {
  Result<MeshFormat> format = mesh_format_of(path);
  if (!format) return fail(format.error());
  options.space = output.space();
  options.name = mesh_name_of(path);
  Result<std::vector<OutputFile>> files = write_tet_mesh(mesh, *format, options);
  if (!files) return fail(files.error());
  if (Status written = write_files(path, *files); !written) return fail(written.error());
  if (*format == MeshFormat::kCarp && !has_fibres(options.cell_data))
    print_warning(path + ": " + std::string(kNoFibres));
  return kExitOk;
}

int export_session(const Session& session, bool measures, const std::string& path, const Output& output) {
  Result<MeshFormat> format = mesh_format_of(path);
  if (!format) return fail(format.error());
  Exported exported = exported_fields(session, *format, measures);
  for (const std::string& name : exported.left_out)
    print_warning(path + ": left out " + name + ", for which this format has no place");
  return export_mesh(*session.mesh(), std::move(exported.options), path, output);
}

}  // namespace voxtet
