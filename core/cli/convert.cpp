#include "cli/convert.h"

#include <cmath>
#include <utility>

#include "cli/cli.h"
#include "cli/input/check_outputs.h"
#include "cli/print.h"
#include "geometry/topology/adjacency.h"
#include "io/bytes/files.h"
#include "io/mesh/read_mesh.h"
#include "io/mesh/read_values.h"
#include "io/volume/read_volume.h"
#include "io/volume/write_volume.h"

namespace voxtet {
namespace {

/// The values of a file; of an .igb the frame whose time is nearest.
Result<Field> values_of_file(const std::string& path, std::size_t points, std::optional<double> time_ms) {
  Result<Bytes> bytes = read_file(path);
  if (!bytes) return bytes.error();
  const Result<PointValues> values = PointValues::open(path, std::move(bytes).value());
  if (!values) return values.error();
  if (Status fits = values->check_count(points); !fits) return fits.error();
  std::size_t frame = values->frames() - 1;
  if (time_ms)
    for (std::size_t k = 0; k < values->times_ms().size(); ++k)
      if (std::abs(values->times_ms()[k] - *time_ms) < std::abs(values->times_ms()[frame] - *time_ms))
        frame = k;
  return values->frame(frame);
}

int convert_mesh(const ConvertOptions& wanted, const Output& output) {
  const std::string &in = wanted.in, &out = wanted.out;
  const Result<MeshFormat> format = written_format(out, output);
  if (!format) return fail(format.error());
  MeshArrays arrays;
  Result<TetMesh> mesh = read_tet_mesh_file(in, &arrays, wanted.label_array);
  if (!mesh) return fail(mesh.error());
  for (const std::string& note : arrays.notes) print_warning(in + ": " + note);
  for (const std::string& name : arrays.left_out)
    print_warning(in + ": left out the array " + name + ", expected a finite number for each cell");
  WriteMeshOptions options;
  options.infos = std::move(arrays.infos);
  for (Field& field : arrays.cell_data) {
    if (has_place_for(field.on, field.components, *format))
      options.cell_data.push_back(std::move(field));
    else
      print_warning(out + ": left out " + field.name + ", for which this format has no place");
  }
  if (!has_fibres(options.cell_data))
    if (Status none = check_no_fibres({"OUTPUT", out}); !none) return fail(none.error());
  for (const std::string& path : wanted.values) {
    Result<Field> field = values_of_file(path, mesh->points.size(), wanted.time_ms);
    if (!field) return fail(field.error());
    options.point_data.push_back(std::move(field).value());
  }
  add_label_faces(*mesh);
  return export_mesh(*mesh, std::move(options), out, output);
}

}  // namespace

void add_convert_command(CLI::App& command, ConvertOptions& wanted, Output& output) {
  command.add_option("INPUT", wanted.in)->required();
  command.add_option("OUTPUT", wanted.out)->required();
  command.add_option("--values", wanted.values, "openCARP's values at the mesh's points, .dat or .igb")
      ->check(kNotEmpty);
  command.add_option("--time", wanted.time_ms, "time of the frame of an .igb, ms; the last if absent");
  add_read_options(command, wanted.read);
  command.add_option("--label-array", wanted.label_array, kLabelArrayHelp)->check(kNotEmpty);
  add_write_options(command, output);
}

int run_convert(const ConvertOptions& wanted, const Output& output) {
  const std::string &in = wanted.in, &out = wanted.out;
  std::vector<NamedPath> inputs{{"INPUT", in}};
  for (const std::string& path : wanted.values) inputs.push_back({"--values", path});
  if (Status there = check_outputs({{"OUTPUT", out}}, inputs); !there) return fail(there.error());
  if (mesh_format_of(in).ok()) return convert_mesh(wanted, output);
  if (!wanted.values.empty())
    return fail(usage_error("cli", "--values: found the volume " + in + ", expected a mesh file"));
  if (!wanted.label_array.empty())
    return fail(usage_error("cli", "--label-array: found the volume " + in + ", expected a mesh file"));
  const Result<ReadOptions> read = read_options_of(wanted.read);
  if (!read) return fail(read.error());
  ReadRemarks remarks;
  Result<LabelVolume> volume = read_volume_file(in, *read, &remarks);
  if (!volume) return fail(volume.error());
  for (const std::string& warning : remarks.warnings) print_warning(warning);
  for (const std::string& note : remarks.notes) print_note(note);
  if (!is_nifti_name(out))
    return fail({ErrorCode::kUsage, "cli", out + ": a volume is written as .nii or .nii.gz", {}});
  Result<Bytes> bytes = write_nifti(*volume, out.ends_with(".gz"));
  if (!bytes) return fail(bytes.error());
  if (Status written = place_files({{out, *bytes}}); !written) return fail(written.error());
  return kExitOk;
}

}  // namespace voxtet
