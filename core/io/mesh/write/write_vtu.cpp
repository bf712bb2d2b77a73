#include "io/mesh/write/write_vtu.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "io/bytes/byte_writer.h"
#include "io/mesh/shared/element_nodes.h"
#include "io/mesh/shared/mesh_groups.h"
#include "io/mesh/write/vtk_xml.h"

namespace voxtet {
namespace {

constexpr std::uint8_t kVtkTriangle = 5, kVtkQuadraticTriangle = 22;

/// `names`: of the labels, as arrays of field data.
VtkXml header_of(PatientSpace space, std::size_t points, std::size_t cells, const std::string& names,
                 const std::string& note = "") {
  std::string field_data = names;
  if (space == PatientSpace::kLps)
    field_data +=
        "<DataArray type=\"Int8\" Name=\"space\" NumberOfTuples=\"3\" format=\"ascii\">"
        "76 80 83</DataArray>\n";
  return VtkXml(
      "UnstructuredGrid", coordinates_note(space) + note, field_data,
      "NumberOfPoints=\"" + std::to_string(points) + "\" NumberOfCells=\"" + std::to_string(cells) + "\"");
}

std::string ascii_array(const std::string& type, std::string_view name, const std::vector<int>& values) {
  std::string text;
  for (const int value : values) text += (text.empty() ? "" : " ") + std::to_string(value);
  return "<DataArray type=\"" + type + "\" Name=\"" + std::string(name) + "\" NumberOfTuples=\"" +
         std::to_string(values.size()) + "\" format=\"ascii\">" + text + "</DataArray>\n";
}

/// The labels that have a name, and the bytes of the names with a zero behind each: meshio reads no texts.
std::string name_arrays(const std::vector<Label>& labels, const std::vector<LabelInfo>& infos) {
  std::vector<int> values, bytes;
  for (const LabelInfo& info : infos) {
    if (info.name.empty() || !std::binary_search(labels.begin(), labels.end(), info.label)) continue;
    values.push_back(info.label);
    for (const char c : info.name)
      if (c != '\0') bytes.push_back(static_cast<unsigned char>(c));
    bytes.push_back(0);
  }
  if (values.empty()) return {};
  return ascii_array("Int32", kLabelValues, values) + ascii_array("UInt8", kLabelNames, bytes);
}

/// All labels on the two sides of triangles, ascending.
std::vector<Label> labels_of(const SurfaceMesh& surface) {
  std::vector<Label> labels;
  for (const Sides& pair : group_faces(surface.sides).pairs)
    labels.insert(labels.end(), pair.begin(), pair.end());
  std::sort(labels.begin(), labels.end());
  return labels;
}

void declare_grid(VtkXml& header, std::size_t points, std::size_t cells, std::size_t nodes_per_cell) {
  header.open("Points");
  header.array("Float64", "Points", 24 * points, " NumberOfComponents=\"3\"");
  header.open("/Points");
  header.open("Cells");
  header.array("Int64", "connectivity", 8 * nodes_per_cell * cells);
  header.array("Int64", "offsets", 8 * cells);
  header.array("UInt8", "types", cells);
  header.open("/Cells");
}

struct Cells {
  std::size_t count, nodes_per_cell;
  std::uint8_t type;
};

/// `nodes_of`: of a cell by its index.
template <class NodesOf>
void append_grid(ByteWriter& out, const std::vector<Eigen::Vector3d>& points, PatientSpace space,
                 const Cells& cells, const NodesOf& nodes_of) {
  out.raw(std::uint64_t{24 * points.size()});
  for (const Eigen::Vector3d& ras : points) {
    const Eigen::Vector3d p = in_space(ras, space);
    for (int d = 0; d < 3; ++d) out.raw(p[d]);
  }
  out.raw(std::uint64_t{8 * cells.nodes_per_cell * cells.count});
  for (std::size_t i = 0; i < cells.count; ++i)
    for (const std::uint32_t node : nodes_of(i)) out.raw(std::int64_t{node});
  out.raw(std::uint64_t{8 * cells.count});
  for (std::size_t i = 1; i <= cells.count; ++i) out.raw(static_cast<std::int64_t>(cells.nodes_per_cell * i));
  out.raw(std::uint64_t{cells.count});
  for (std::size_t i = 0; i < cells.count; ++i) out.raw(cells.type);
}

void declare_data(VtkXml& header, const std::vector<Field>& fields) {
  for (const Field& data : fields)
    header.array(
        "Float32", data.name, 4 * data.values.size(),
        data.components == 1 ? "" : " NumberOfComponents=\"" + std::to_string(data.components) + "\"");
}

void append_data(ByteWriter& out, const std::vector<Field>& fields, PatientSpace space) {
  for (const Field& data : fields) {
    out.raw(std::uint64_t{4 * data.values.size()});
    for (const float value : in_space(data, space)) out.raw(value);
  }
}

}  // namespace

Bytes write_vtu(const TetMesh& mesh, const WriteMeshOptions& options) {
  VtkXml header = header_of(options.space, mesh.points.size(), mesh.tets.size(),
                            name_arrays(group_tets(mesh.labels).labels, options.infos));
  const Cells cells{mesh.tets.size(), nodes_per_tet(options),
                    options.midside ? kVtkQuadraticTetra : kVtkTetra};
  declare_grid(header, mesh.points.size(), cells.count, cells.nodes_per_cell);
  header.open("CellData Scalars=\"label\"");
  header.array("Int32", "label", 4 * mesh.tets.size());
  declare_data(header, options.cell_data);
  header.open("/CellData");
  if (!options.point_data.empty()) {
    header.open("PointData");
    declare_data(header, options.point_data);
    header.open("/PointData");
  }
  ByteWriter out = header.finish();
  append_grid(out, mesh.points, options.space, cells,
              [&](std::size_t t) { return nodes_of_tet(mesh, t, options); });
  out.raw(std::uint64_t{4 * mesh.labels.size()});
  for (const Label label : mesh.labels) out.raw(std::int32_t{label});
  append_data(out, options.cell_data, options.space);
  append_data(out, options.point_data, options.space);
  out.text(VtkXml::kFooter);
  return out.take();
}

Bytes write_vtu(const SurfaceMesh& surface, const WriteMeshOptions& options) {
  const bool named = !options.surfaces.empty();
  VtkXml header = header_of(options.space, surface.points.size(), surface.triangles.size(),
                            name_arrays(labels_of(surface), options.infos),
                            named ? "; surface " + set_legend(options.surfaces) : "");
  const Cells cells{surface.triangles.size(), nodes_per_face(options),
                    options.midside ? kVtkQuadraticTriangle : kVtkTriangle};
  declare_grid(header, surface.points.size(), cells.count, cells.nodes_per_cell);
  header.open("CellData Scalars=\"label_behind\"");
  header.array("Int32", "label_behind", 4 * surface.sides.size());
  header.array("Int32", "label_front", 4 * surface.sides.size());
  if (named) header.array("Int32", "surface", 4 * surface.sides.size());
  header.open("/CellData");
  ByteWriter out = header.finish();
  append_grid(out, surface.points, options.space, cells, [&](std::size_t t) {
    return nodes_of_face(surface.triangles, t, surface.points.size(), options);
  });
  for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
    out.raw(std::uint64_t{4 * surface.sides.size()});
    for (const Sides& sides : surface.sides) out.raw(std::int32_t{sides[side]});
  }
  if (named) {
    out.raw(std::uint64_t{4 * surface.sides.size()});
    for (const std::int32_t number : set_numbers(options.surfaces, surface.sides.size())) out.raw(number);
  }
  out.text(VtkXml::kFooter);
  return out.take();
}

}  // namespace voxtet
