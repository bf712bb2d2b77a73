#include "cli/options.h"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/parallel.h"
#include "cli/cli.h"
#include "cli/print.h"
#include "cli/words/option_texts.h"
#include "geometry/curved/midside_nodes.h"
#include "io/bytes/files.h"
#include "pipeline/exports/exported_fields.h"
#include "pipeline/exports/second_order.h"
#include "pipeline/report.h"
#include "volume/clean/clean_volume.h"

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
  // Every text may be absent, so that its absence is answered with what was expected, and takes one word.
  const auto add_labels = [&](const std::string& name, std::vector<std::string>& texts,
                              const std::string& help) {
    command.add_option(name, texts, help)->expected(0, 1000)->allow_extra_args(false)->type_name("LABELS");
  };
  command
      .add_option(input_name, options.input,
                  "volume (.nii .nii.gz .nrrd .nhdr .mha .mhd .mgh .mgz), mesh, case.json, link, or - for "
                  "standard input")
      ->required();
  command
      .add_option("--input-format", options.input_format,
                  "of a mesh on standard input: vtu, msh or mesh; a volume's is found from its content")
      ->check(CLI::IsMember({"vtu", "msh", "mesh"}));
  add_labels("--labels", options.labels, "labels to mesh, as Wall,1-3 or all; all if absent");
  add_labels("--merge", options.merge,
             "mesh the labels 1,5,6 as one region (once a group), or all of them; after the input");
  add_labels("--transfer,--look-up", options.transfer, "labels to transfer to the tetrahedra, as 5,6");
  command.add_option("--edge-mm", options.edge_mm, "edge length, as 2, 2mm, 0.2cm or 800um; mm if no unit")
      ->check(kNotEmpty)
      ->type_name("LENGTH");
  command
      .add_option("--edge-label", options.edge_labels, "edge length inside a label, as 5=0.8 or Wall=800um")
      ->type_name("LABEL=LENGTH");
  command.add_option("--mask", options.masks, "label volume painted over the input, sized by --mask-edge");
  command.add_option("--mask-edge", options.mask_edges, "edge length inside a label of the masks, as 1=0.8");
  command.add_option("--size-image", options.size_images, "NIfTI image of edge lengths, mm");
  command.add_flag("--align-slices", options.align_slices,
                   "put thick slices back that are shifted against each other, as by breath-holds");
  command.add_flag(
      "--stack", options.stack,
      "what a clinical stack of thick slices needs: --align-slices, interpolation, more smoothing");
  add_read_options(command, options.read);
  command
      .add_option("--cut", options.cut,
                  "cut labels off at a plane through a point (mm), on the side to which a normal points, as "
                  "all:0,0,40:0,0,1 or Wall,1-3:0,0,40:0,0,1:base with the surface's name; once a plane")
      ->type_name("LABELS:X,Y,Z:NX,NY,NZ[:NAME]");
  command.add_flag("--clean", options.clean,
                   "take noise away: loose pieces, holes, thin handles, tunnels and pits below " +
                       std::to_string(kUsualCleaning.speck_voxels) + " voxels");
  command.add_option("--set", options.set, "any field of the recipe, as sizing.gradation=0.2");
  command.add_flag("--json", output.as_json, "print the report, or the error, as JSON");
  command.add_option("--time-limit", output.time_limit_s, "give up after so many seconds")
      ->check(number_as("seconds as 60; 0 for no limit", [](double s) { return s >= 0; }));
  command
      .add_option("--threads", output.threads,
                  "threads to use, 0 (as if absent) for one a core; the result is the same for any number")
      ->check(number_as("a whole number as 2; 0 for one a core",
                        [](double n) { return n >= 0 && n <= 1e6 && is_whole(n); }));
}

std::string text_of(const json& value) {
  return value.dump(1, ' ', false, json::error_handler_t::replace);
}

void print_json(const json& value) {
  std::printf("%s\n", text_of(value).c_str());
}

RunContext context_of(const Output& output) {
  return printing_context(output.time_limit_s, output.threads > 0 ? output.threads : hardware_threads());
}

int fail(const Error& error, const Output& output) {
  if (output.as_json) print_json({{"error", error_json(error)}});
  return fail(error);
}

Error run_error(Error error, const Output& output) {
  if (error.code == ErrorCode::kCancelled)
    error.message = "given up after the " + json(output.time_limit_s).dump() + " s of --time-limit";
  return error;
}

int fail_run(Error error, const Output& output) {
  return fail(run_error(std::move(error), output), output);
}

void add_write_options(CLI::App& command, Output& output) {
  command.add_option("--space", output.lps_or_ras, "patient space of the mesh file")
      ->check(CLI::IsMember({"ras", "lps"}));
  command.add_option("--msh", output.msh_version, "version of a .msh: 4.1 (as if absent), or 2.2 as text")
      ->check(CLI::IsMember({"4.1", "2.2"}));
  command.add_flag("--stl-per-label", output.stl_per_label, "for a.stl: a.LABEL.stl for each label");
  command
      .add_option("--order", output.order,
                  "of elements: 2 for tetrahedra of ten nodes, in " + std::string(kSecondOrderEndings))
      ->check(CLI::IsMember({1, 2}));
}

Result<MeshFormat> written_format(const std::string& path, const Output& output) {
  const Result<MeshFormat> format = mesh_format_of(path);
  if (!format) return format;
  if (!output.msh_version.empty() && *format != MeshFormat::kMsh)
    return usage_error("cli", "--msh " + output.msh_version + ": found " + path + ", expected a name.msh");
  if (output.stl_per_label && *format != MeshFormat::kStl)
    return usage_error("cli", "--stl-per-label: found " + path + ", expected a name.stl");
  if (output.order == 2 && !has_second_order(*format))
    return usage_error("cli", "--order 2: found " + path + ", expected a name that ends with " +
                                  std::string(kSecondOrderEndings));
  if (output.msh_version == "2.2") return MeshFormat::kMsh22;
  return output.stl_per_label ? MeshFormat::kLabelStl : *format;
}

Result<std::string> mesh_path_of(const std::string& path, const Output& output) {
  constexpr const char* kForms = "vtu, vtk, msh, mesh, inp, bdf, feb, stl or ply";
  if (path != kDash) {
    if (output.mesh_format.empty()) return path;
    return usage_error("cli", "--output-format " + output.mesh_format + ": found -o " + path +
                                  ", whose ending says the format; expected -o -");
  }
  if (output.mesh_format.empty())
    return usage_error("cli", std::string("-o -: expected --output-format with ") + kForms);
  const std::string name = "stdout." + output.mesh_format;
  const Result<MeshFormat> format = mesh_format_of(name);
  if (!format || *format == MeshFormat::kCarp || *format == MeshFormat::kXdmf ||
      *format == MeshFormat::kTetgen)
    return usage_error("cli", "--output-format: found '" + output.mesh_format + "', expected " + kForms +
                                  (format ? ": a format of one file" : ""));
  return name;
}

int export_mesh(const TetMesh& mesh, WriteMeshOptions options, const std::string& path,
                const Output& output) {
  const Result<std::string> name = mesh_path_of(path, output);
  if (!name) return fail(name.error(), output);
  const Result<MeshFormat> format = written_format(*name, output);
  if (!format) return fail(format.error(), output);
  options.space = output.space();
  options.name = mesh_name_of(*name);
  if (output.order == 2 && !options.midside) options.midside = straight_midside_nodes(mesh);
  Result<std::vector<OutputFile>> files = write_tet_mesh(mesh, *format, options);
  if (!files) return fail(files.error(), output);
  if (path == kDash) {
    for (std::size_t i = 1; i < files->size(); ++i)
      print_warning("-o -: left out the file that ends with " + (*files)[i].suffix);
    if (Status written = write_standard_output(files->front().bytes); !written)
      return fail(written.error(), output);
  } else if (Status written = write_files(path, *files); !written) {
    return fail(written.error(), output);
  }
  if (*format == MeshFormat::kCarp && !has_fibres(options.cell_data))
    print_warning(path + ": " + std::string(kNoFibres));
  return kExitOk;
}

int export_session(const Session& session, bool measures, const std::string& path, const Output& output) {
  const Result<std::string> name = mesh_path_of(path, output);
  if (!name) return fail(name.error(), output);
  const Result<MeshFormat> format = written_format(*name, output);
  if (!format) return fail(format.error(), output);
  Exported exported = exported_fields(session, *format, measures);
  for (const std::string& field : exported.left_out)
    print_warning(path + ": left out " + field + ", for which this format has no place");
  if (output.order == 2) {
    const RunContext ctx = context_of(output);
    CurvedNodes curved = second_order_nodes(session, ctx.threads);
    print_note(path + ": " + note_of(curved));
    exported.options.midside = std::move(curved.nodes);
  }
  return export_mesh(*session.mesh(), std::move(exported.options), path, output);
}

}  // namespace voxtet
