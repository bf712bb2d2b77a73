#include "io/mesh/write/write_xdmf.h"

#include <algorithm>
#include <string>

#include "io/bytes/header_text.h"
#include "io/mesh/shared/element_nodes.h"
#include "io/mesh/shared/facet_tags.h"
#include "io/mesh/shared/hdf5_arrays.h"
#include "io/mesh/shared/mesh_groups.h"
#include "io/mesh/shared/xml_text.h"

namespace voxtet {
namespace {

bool can_be_named(const std::string& name) {
  return !name.empty() && trimmed(name) == name && std::none_of(name.begin(), name.end(), [](char c) {
    return c == ':' || static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
  });
}

std::string data_item(const Hdf5Array& array, const std::string& file) {
  std::string shape;
  for (const std::uint64_t extent : array.shape) shape += (shape.empty() ? "" : " ") + std::to_string(extent);
  return std::string("<DataItem DataType=\"") + (array.type == Hdf5Type::kInt32 ? "Int" : "Float") +
         "\" Precision=\"" + (array.type == Hdf5Type::kFloat64 ? "8" : "4") + "\" Dimensions=\"" + shape +
         "\" Format=\"HDF\">" + file + ":/" + array.name + "</DataItem>\n";
}

/// No comment may hold two hyphens.
std::string without_pairs_of_hyphens(std::string note) {
  for (std::size_t at = 0; (at = note.find("--", at)) != std::string::npos;) note.insert(at + 1, " ");
  return note;
}

/// "; label 1 LV myocardium, 2 RV", for a comment; nothing where no label has a name.
std::string label_note(const TetMesh& mesh, const std::vector<LabelInfo>& infos) {
  const std::vector<Label> labels = group_tets(mesh.labels).labels;
  const std::vector<std::string> names = group_names(labels, infos);
  std::string note;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const std::string number = std::to_string(labels[i]);
    if (names[i] != "label " + number) note += (note.empty() ? "; label " : ", ") + number + " " + names[i];
  }
  return without_pairs_of_hyphens(note);
}

constexpr std::size_t kGridArrays = 2;

std::vector<std::uint64_t> shape_of(const Field& field) {
  const auto components = static_cast<std::uint64_t>(field.components);
  if (components == 1) return {field.values.size()};
  return {field.values.size() / components, components};
}

/// The arrays of the .h5: points, tets, and then the attributes of cells and of points.
std::vector<Hdf5Array> arrays_of(const TetMesh& mesh, const WriteMeshOptions& options) {
  std::vector<Hdf5Array> arrays{{"points", Hdf5Type::kFloat64, {mesh.points.size(), 3}},
                                {"tets", Hdf5Type::kInt32, {mesh.tets.size(), nodes_per_tet(options)}},
                                {"label", Hdf5Type::kInt32, {mesh.tets.size()}}};
  for (const auto* fields : {&options.cell_data, &options.point_data})
    for (const Field& data : *fields) arrays.push_back({data.name, Hdf5Type::kFloat32, shape_of(data)});
  return arrays;
}

void write_points(ByteWriter& out, const TetMesh& mesh, PatientSpace space) {
  for (const Eigen::Vector3d& ras : mesh.points) {
    const Eigen::Vector3d p = in_space(ras, space);
    for (int d = 0; d < 3; ++d) out.raw(p[d]);
  }
}

Bytes write_numbers(const TetMesh& mesh, const WriteMeshOptions& options,
                    const std::vector<Hdf5Array>& arrays) {
  ByteWriter out = begin_hdf5(arrays);
  write_points(out, mesh, options.space);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (const std::uint32_t node : nodes_of_tet(mesh, t, options)) out.raw(static_cast<std::int32_t>(node));
  for (const Label label : mesh.labels) out.raw(std::int32_t{label});
  for (const auto* fields : {&options.cell_data, &options.point_data})
    for (const Field& data : *fields)
      for (const float value : in_space(data, options.space)) out.raw(value);
  return out.take();
}

/// A grid of cells of one type. Its arrays: points, cells, attributes of cells, and from `first_of_points` on
/// those of points.
struct XdmfGrid {
  std::string name, note, file, cell_type;
  std::vector<Hdf5Array> arrays;
  std::size_t first_of_points = 0;
};

Bytes write_description(const XdmfGrid& grid) {
  const auto& [name, note, h5, cell_type, arrays, first_of_points] = grid;
  const std::string file = xml_escaped(h5);
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- voxtet mesh, " + note +
                    " -->\n<Xdmf Version=\"3.0\">\n<Domain>\n<Grid Name=\"" + name +
                    "\" GridType=\"Uniform\">\n<Geometry GeometryType=\"XYZ\">\n" +
                    data_item(arrays[0], file) + "</Geometry>\n<Topology TopologyType=\"" + cell_type +
                    "\" NodesPerElement=\"" + std::to_string(arrays[1].shape[1]) + "\" NumberOfElements=\"" +
                    std::to_string(arrays[1].shape[0]) + "\">\n" + data_item(arrays[1], file) +
                    "</Topology>\n";
  for (std::size_t i = kGridArrays; i < arrays.size(); ++i)
    xml += "<Attribute Name=\"" + arrays[i].name + "\" AttributeType=\"" +
           (arrays[i].shape.size() == 1 ? "Scalar" : "Vector") + "\" Center=\"" +
           (i < first_of_points ? "Cell" : "Node") + "\">\n" + data_item(arrays[i], file) + "</Attribute>\n";
  xml += "</Grid>\n</Domain>\n</Xdmf>\n";
  return {xml.begin(), xml.end()};
}

/// The faces on the same points: FEniCS finds facets by their points' numbers.
void write_facets(const TetMesh& mesh, const WriteMeshOptions& options, std::vector<OutputFile>& files) {
  const FacetTags facets = facet_tags(mesh, options);
  const std::vector<Hdf5Array> arrays{
      {"points", Hdf5Type::kFloat64, {mesh.points.size(), 3}},
      {"triangles", Hdf5Type::kInt32, {mesh.faces.size(), nodes_per_face(options)}},
      {"facet", Hdf5Type::kInt32, {mesh.faces.size()}}};
  ByteWriter out = begin_hdf5(arrays);
  write_points(out, mesh, options.space);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (const std::uint32_t node : nodes_of_face(mesh.faces, f, mesh.points.size(), options))
      out.raw(static_cast<std::int32_t>(node));
  for (const std::int32_t tag : facets.of_face) out.raw(tag);
  std::string note = coordinates_note(options.space) + "; facet ";
  for (const std::string& tag : facet_legend(facets)) note += (note.ends_with("facet ") ? "" : ", ") + tag;
  files.push_back({".facets.xdmf",
                   write_description({"facets", without_pairs_of_hyphens(note), options.name + ".facets.h5",
                                      options.midside ? "Triangle_6" : "Triangle", arrays, arrays.size()})});
  files.push_back({".facets.h5", out.take()});
}

}  // namespace

Result<std::vector<OutputFile>> write_xdmf(const TetMesh& mesh, const WriteMeshOptions& options) {
  if (!can_be_named(options.name))
    return Error{ErrorCode::kUsage,
                 "write_mesh",
                 "the name " + in_quotes(options.name) +
                     ": an XDMF file cannot refer to an .h5 of this name, expected no colon, no control "
                     "character, no space at either end",
                 {}};
  const std::vector<Hdf5Array> arrays = arrays_of(mesh, options);
  std::vector<OutputFile> files{
      {".xdmf", write_description({"mesh", coordinates_note(options.space) + label_note(mesh, options.infos),
                                   options.name + ".h5", options.midside ? "Tetrahedron_10" : "Tetrahedron",
                                   arrays, arrays.size() - options.point_data.size()})},
      {".h5", write_numbers(mesh, options, arrays)}};
  if (!mesh.faces.empty()) write_facets(mesh, options, files);
  return files;
}

}  // namespace voxtet
