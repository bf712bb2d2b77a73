#include "io/mesh/write/text/write_vtk.h"

#include <algorithm>
#include <string>
#include <vector>

#include "io/bytes/byte_writer.h"
#include "io/mesh/shared/mesh_groups.h"
#include "io/mesh/write/write_vtu.h"

namespace voxtet {
namespace {

/// Values of one tuple stand on a line.
template <class Value>
void write_row(ByteWriter& out, const Value* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) out.text(" ");
    if constexpr (std::is_floating_point_v<Value>)
      out.real(values[i]);
    else
      out.integer(static_cast<std::int64_t>(values[i]));
  }
  out.text("\n");
}

/// An array of field data: one number a tuple.
struct WholeArray {
  std::string name, type;
  std::vector<int> values;
};

void add_name(const std::string& name, std::vector<int>& bytes) {
  for (const char c : name)
    if (c != '\0') bytes.push_back(static_cast<unsigned char>(c));
  bytes.push_back(0);
}

std::vector<WholeArray> names_of_labels(const std::vector<Label>& labels,
                                        const std::vector<LabelInfo>& infos) {
  WholeArray values{std::string(kLabelValues), "int", {}},
      names{std::string(kLabelNames), "unsigned_char", {}};
  for (const LabelInfo& info : infos) {
    if (info.name.empty() || !std::binary_search(labels.begin(), labels.end(), info.label)) continue;
    values.values.push_back(info.label);
    add_name(info.name, names.values);
  }
  if (values.values.empty()) return {};
  return {values, names};
}

void write_vtk_head(ByteWriter& out, PatientSpace space, const std::vector<WholeArray>& arrays) {
  // coordinates_note() begins with the space.
  out.text("# vtk DataFile Version 3.0\nvoxtet mesh, " + coordinates_note(space) +
           "\nASCII\nDATASET UNSTRUCTURED_GRID\n");
  if (arrays.empty()) return;
  out.text("FIELD FieldData " + std::to_string(arrays.size()) + "\n");
  for (const WholeArray& array : arrays) {
    out.text(array.name + " 1 " + std::to_string(array.values.size()) + " " + array.type + "\n");
    write_row(out, array.values.data(), array.values.size());
  }
}

template <std::size_t kCorners>
void write_vtk_grid(ByteWriter& out, const std::vector<Eigen::Vector3d>& points, PatientSpace space,
                    const std::vector<std::array<std::uint32_t, kCorners>>& cells, const char* cell_type) {
  out.text("POINTS " + std::to_string(points.size()) + " double\n");
  for (const Eigen::Vector3d& ras : points) write_row(out, in_space(ras, space).eval().data(), 3);
  out.text("CELLS " + std::to_string(cells.size()) + " " + std::to_string((kCorners + 1) * cells.size()) +
           "\n");
  for (const auto& cell : cells) {
    out.integer(kCorners);
    out.text(" ");
    write_row(out, cell.data(), kCorners);
  }
  out.text("CELL_TYPES " + std::to_string(cells.size()) + "\n");
  for (std::size_t i = 0; i < cells.size(); ++i) out.text(cell_type);
}

void write_vtk_scalars(ByteWriter& out, const std::string& name, const std::vector<std::int32_t>& values) {
  out.text("SCALARS " + name + " int 1\nLOOKUP_TABLE default\n");
  for (const std::int32_t value : values) write_row(out, &value, 1);
}

void write_vtk_fields(ByteWriter& out, const std::vector<Field>& fields, PatientSpace space) {
  if (fields.empty()) return;
  out.text("FIELD FieldData " + std::to_string(fields.size()) + "\n");
  for (const Field& field : fields) {
    const auto components = static_cast<std::size_t>(field.components);
    const std::vector<float> values = in_space(field, space);
    out.text(field.name + " " + std::to_string(components) + " " +
             std::to_string(values.size() / components) + " float\n");
    for (std::size_t i = 0; i < values.size(); i += components) write_row(out, &values[i], components);
  }
}

}  // namespace

Bytes write_vtk(const TetMesh& mesh, const WriteMeshOptions& options) {
  ByteWriter out(64 * mesh.points.size() + (40 + 16 * options.cell_data.size()) * mesh.tets.size() + 4096);
  write_vtk_head(out, options.space, names_of_labels(group_tets(mesh.labels).labels, options.infos));
  write_vtk_grid(out, mesh.points, options.space, mesh.tets, "10\n");
  out.text("CELL_DATA " + std::to_string(mesh.tets.size()) + "\n");
  write_vtk_scalars(out, "label", {mesh.labels.begin(), mesh.labels.end()});
  write_vtk_fields(out, options.cell_data, options.space);
  if (!options.point_data.empty()) {
    out.text("POINT_DATA " + std::to_string(mesh.points.size()) + "\n");
    write_vtk_fields(out, options.point_data, options.space);
  }
  return out.take();
}

Bytes write_vtk(const SurfaceMesh& surface, const WriteMeshOptions& options) {
  std::vector<Label> labels;
  for (const Sides& pair : group_faces(surface.sides).pairs)
    labels.insert(labels.end(), pair.begin(), pair.end());
  std::sort(labels.begin(), labels.end());
  std::vector<WholeArray> names = names_of_labels(labels, options.infos);
  if (!options.surfaces.empty()) {
    names.push_back({"surface_names", "unsigned_char", {}});
    for (const NamedSet& set : options.surfaces) add_name(set.name, names.back().values);
  }
  ByteWriter out(64 * surface.points.size() + 40 * surface.triangles.size() + 4096);
  write_vtk_head(out, options.space, names);
  write_vtk_grid(out, surface.points, options.space, surface.triangles, "5\n");
  out.text("CELL_DATA " + std::to_string(surface.triangles.size()) + "\n");
  std::vector<std::int32_t> behind, front;
  for (const Sides& sides : surface.sides) {
    behind.push_back(sides[0]);
    front.push_back(sides[1]);
  }
  write_vtk_scalars(out, "label_behind", behind);
  write_vtk_scalars(out, "label_front", front);
  if (!options.surfaces.empty())
    write_vtk_scalars(out, "surface", set_numbers(options.surfaces, surface.triangles.size()));
  return out.take();
}

}  // namespace voxtet
