// Mesh files written by hand, and how tests read meshes from memory.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "io/mesh/read_mesh.h"
#include "io/mesh/write_mesh.h"

namespace voxtet::test {

inline Bytes bytes_of(const std::string& text) {
  return {text.begin(), text.end()};
}

/// The text with the first `from` replaced, which must be there.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

inline std::string text_of(const Bytes& bytes) {
  return {bytes.begin(), bytes.end()};
}

/// A file of an export.
inline std::string text_of(const std::vector<OutputFile>& files, const std::string& suffix) {
  for (const OutputFile& file : files)
    if (file.suffix == suffix) return text_of(file.bytes);
  ADD_FAILURE() << "no file " << suffix;
  return {};
}

/// The files of an export that must succeed.
inline std::vector<OutputFile> written(const TetMesh& mesh, MeshFormat format,
                                       const WriteMeshOptions& options) {
  Result<std::vector<OutputFile>> files = write_tet_mesh(mesh, format, options);
  EXPECT_TRUE(files.ok()) << files.error().message;
  return files ? std::move(files).value() : std::vector<OutputFile>{};
}

inline Result<TetMesh> read_text(const std::string& name, const std::string& text) {
  const Bytes bytes = bytes_of(text);
  return read_tet_mesh({name, bytes, {}});
}

/// Reads the files of one export as if they stood in one folder.
inline Result<TetMesh> read_export(const std::vector<OutputFile>& files) {
  std::map<std::string, Bytes> folder;
  for (const OutputFile& file : files) folder["mesh" + file.suffix] = file.bytes;
  const SiblingReader sibling = [&](const std::string& name) -> Result<Bytes> {
    if (const auto found = folder.find(name); found != folder.end()) return found->second;
    return Error{ErrorCode::kBadInput, "test", name + " is missing", {}};
  };
  return read_tet_mesh({"folder/mesh" + files.front().suffix, files.front().bytes, sibling});
}

/// The message of a failure; its code is kBadInput.
inline std::string refusal(const Result<TetMesh>& result) {
  EXPECT_FALSE(result.ok());
  if (result.ok()) return {};
  EXPECT_EQ(result.error().code, ErrorCode::kBadInput);
  return result.error().message;
}

inline void expect_refusal(const std::string& name, const std::string& text,
                           const std::vector<std::string>& parts) {
  const std::string message = refusal(read_text(name, text));
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
}

inline const std::string kXdmfText = R"(<?xml version="1.0"?>
<Xdmf Version="3.0"><Domain><Grid Name="Grid">
<Geometry GeometryType="XYZ"><DataItem DataType="Float" Dimensions="5 3" Format="XML" Precision="8">
0 0 0 1 0 0 0 1 0 0 0 1e0 7 7 7</DataItem></Geometry>
<Topology TopologyType="Tetrahedron" NumberOfElements="1">
<DataItem DataType="Int" Dimensions="1 4" Format="XML" Precision="8">0 1 2 3</DataItem></Topology>
<Attribute Name="tag" AttributeType="Scalar" Center="Cell">
<DataItem DataType="Int" Dimensions="1" Format="XML" Precision="8">9</DataItem></Attribute>
</Grid></Domain></Xdmf>
)";

/// The least significant byte last, as in legacy VTK.
template <class T>
void put_big_endian(Bytes& bytes, T value) {
  Bytes raw(sizeof(T));
  std::memcpy(raw.data(), &value, sizeof(T));
  bytes.insert(bytes.end(), raw.rbegin(), raw.rend());
}

/// One tetrahedron among a triangle and an unused point, as ParaView writes them since version 5.8, or
/// before.
inline Bytes binary_vtk(const std::string& title, bool version_5 = true) {
  Bytes bytes;
  const auto text = [&](const std::string& line) { bytes.insert(bytes.end(), line.begin(), line.end()); };
  text("# vtk DataFile Version 5.1\n" + title + "\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n");
  for (const float x : {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 7, 7, 7}) put_big_endian(bytes, x);
  if (version_5) {
    text("\nMETADATA\nINFORMATION 0\n\nCELLS 3 7\nOFFSETS vtktypeint64\n");
    for (const std::int64_t offset : {0, 3, 7}) put_big_endian(bytes, offset);
    text("\nCONNECTIVITY vtktypeint64\n");
    for (const std::int64_t point : {0, 1, 2, 0, 1, 2, 3}) put_big_endian(bytes, point);
  } else {
    text("\nCELLS 2 9\n");
    for (const std::int32_t number : {3, 0, 1, 2, 4, 0, 1, 2, 3}) put_big_endian(bytes, number);
  }
  text("\nCELL_TYPES 2\n");
  for (const std::int32_t type : {5, 10}) put_big_endian(bytes, type);
  text("\nCELL_DATA 2\nSCALARS label int\nLOOKUP_TABLE default\n");
  for (const std::int32_t label : {0, 12}) put_big_endian(bytes, label);
  text("\nFIELD FieldData 1\nother 1 2 double\n");
  for (const double value : {0.5, 2.25}) put_big_endian(bytes, value);
  text("\n");
  return bytes;
}

inline const std::string kMeditText = R"(MeshVersionFormatted 2
# a comment
Dimension 3
Tetrahedra 1
1 2 3 5 9
Vertices
5
0 0 0 0
1 0 0 0 # another
0 1 0 0
7 7 7 0
0 0 1e0 0
Corners 2
1
2
End
)";

inline const std::string kMsh22Text = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
3 4 "wall"
$EndPhysicalNames
$Nodes
4
10 0 0 0
20 1 0 0
5 0 0 1
15 0 1 0
$EndNodes
$Elements
3
7 15 2 9 1 10
8 2 2 1 1 10 20 15
2 4 2 4 1 10 20 15 5
$EndElements
)";

inline const std::string kMsh41Text = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
1 0 0 1
1 0 0 0 0
3 0 0 0 1 1 1 2 6 8 0
$EndEntities
$Nodes
2 4 1 4
0 1 0 1
1
0 0 0
3 3 1 3
2
3
4
1 0 0 .1 .2 .3
0 1 0 .1 .2 .3
0 0 1 .1 .2 .3
$EndNodes
$Elements
2 2 1 2
0 1 15 1
1 1
3 3 4 1
2 1 2 3 4
$EndElements
$NodeData
anything
$EndNodeData
)";

inline const std::string kVtuText = R"(<?xml version="1.0"?>
<!-- written by hand -->
<VTKFile type='UnstructuredGrid' version="0.1">
  <UnstructuredGrid>
    <FieldData><Array type="String" Name="space" format="ascii">76 80 83 0</Array></FieldData>
    <Piece NumberOfPoints="5" NumberOfCells="2">
      <PointData/>
      <CellData Scalars="label">
        <DataArray type="Float64" Name="other" format="ascii"> 0.5 nan </DataArray>
        <DataArray type="Float64" Name="label" format="ascii"> 0 65535 </DataArray>
      </CellData>
      <Points>
        <DataArray type="Float32" NumberOfComponents="3" format="ascii">
          0 0 0  1 0 0  0 1 0  0 0 1  -2.5 4 8
          <InformationKey name="L2_NORM_RANGE" location="vtkDataArray" length="2"><Value index="0">0</Value></InformationKey>
        </DataArray>
      </Points>
      <Cells>
        <DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 0 1 2 3</DataArray>
        <DataArray type="Int32" Name="offsets" format="ascii">3 7</DataArray>
        <DataArray type="UInt8" Name="types" format="ascii">5 10</DataArray>
      </Cells>
    </Piece>
  </UnstructuredGrid>
</VTKFile>
)";

}  // namespace voxtet::test
