#include "io/mesh/write/write_xdmf.h"

#include <algorithm>
#include <string>

#include "io/bytes/header_text.h"
#include "io/mesh/shared/hdf5_arrays.h"
#include "io/mesh/shared/mesh_groups.h"

namespace voxtet {
namespace {

bool can_be_named(const std::string& name) {
  return !name.empty() && trimmed(name) == name && std::none_of(name.begin(), name.end(), [](char c) {
    return c == ':' || static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
  });
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else
      result += c;
  }
  return result;
}

std::string data_item(const Hdf5Array& array, const std::string& file) {
  std::string shape;
  for (const std::uint64_t extent : array.shape) shape += (shape.empty() ? "" : " ") + std::to_string(extent);
  return std::string("<DataItem DataType=\"") + (array.type == Hdf5Type::kInt32 ? "Int" : "Float") +
         "\" Precision=\"" + (array.type == Hdf5Type::kFloat64 ? "8" : "4") + "\" Dimensions=\"" + shape +
         "\" Format=\"HDF\">" + file + ":/" + array.name + "</DataItem>\n";
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
                                {"tets", Hdf5Type::kInt32, {mesh.tets.size(), 4}},
                                {"label", Hdf5Type::kInt32, {mesh.tets.size()}}};
  for (const auto* fields : {&options.cell_data, &options.point_data})
    for (const Field& data : *fields) arrays.push_back({data.name, Hdf5Type::kFloat32, shape_of(data)});
  return arrays;
}

Bytes write_numbers(const TetMesh& mesh, const WriteMeshOptions& options,
                    const std::vector<Hdf5Array>& arrays) {
  ByteWriter out = begin_hdf5(arrays);
  for (const Eigen::Vector3d& ras : mesh.points) {
    const Eigen::Vector3d p = in_space(ras, options.space);
    for (int d = 0; d < 3; ++d) out.raw(p[d]);
  }
  for (const Tet& tet : mesh.tets)
    for (const std::uint32_t corner : tet) out.raw(static_cast<std::int32_t>(corner));
  for (const Label label : mesh.labels) out.raw(std::int32_t{label});
  for (const auto* fields : {&options.cell_data, &options.point_data})
    for (const Field& data : *fields)
      for (const float value : in_space(data, options.space)) out.raw(value);
  return out.take();
}

Bytes write_description(const WriteMeshOptions& options, const std::vector<Hdf5Array>& arrays) {
  const std::string file = escaped(options.name) + ".h5";
  std::string xml =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- voxtet mesh, " + coordinates_note(options.space) +
      " -->\n<Xdmf Version=\"3.0\">\n<Domain>\n<Grid Name=\"mesh\" GridType=\"Uniform\">\n"
      "<Geometry GeometryType=\"XYZ\">\n" +
      data_item(arrays[0], file) +
      "</Geometry>\n<Topology TopologyType=\"Tetrahedron\" NodesPerElement=\"4\" "
      "NumberOfElements=\"" +
      std::to_string(arrays[1].shape[0]) + "\">\n" + data_item(arrays[1], file) + "</Topology>\n";
  const std::size_t first_of_points = arrays.size() - options.point_data.size();
  for (std::size_t i = kGridArrays; i < arrays.size(); ++i)
    xml += "<Attribute Name=\"" + arrays[i].name + "\" AttributeType=\"" +
           (arrays[i].shape.size() == 1 ? "Scalar" : "Vector") + "\" Center=\"" +
           (i < first_of_points ? "Cell" : "Node") + "\">\n" + data_item(arrays[i], file) + "</Attribute>\n";
  xml += "</Grid>\n</Domain>\n</Xdmf>\n";
  return {xml.begin(), xml.end()};
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
  return std::vector<OutputFile>{{".xdmf", write_description(options, arrays)},
                                 {".h5", write_numbers(mesh, options, arrays)}};
}

}  // namespace voxtet
