#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include "io/mesh/read_mesh.h"
#include "io/mesh/write_mesh.h"
#include "mesh_texts.h"
#include "support/labelled_mesh.h"

namespace voxtet {
namespace {

WriteMeshOptions with_data(const TetMesh& mesh) {
  WriteMeshOptions options{PatientSpace::kRas, test::cube_infos(), test::cube_cell_data(mesh)};
  return options;
}

TEST(CellData, StandsBesideTheMeshThatIsReadBackWithoutIt) {
  const TetMesh mesh = test::kuhn_cube(3);
  for (const MeshFormat format :
       {MeshFormat::kVtu, MeshFormat::kVtk, MeshFormat::kMsh, MeshFormat::kMsh22, MeshFormat::kMedit,
        MeshFormat::kCarp, MeshFormat::kAbaqus, MeshFormat::kFebio}) {
    const auto files = write_tet_mesh(mesh, format, with_data(mesh));
    ASSERT_TRUE(files.ok()) << files.error().message;
    const VolumeFile file{"cube" + files->front().suffix, files->front().bytes,
                          [&](const std::string& name) -> Result<Bytes> {
                            for (const OutputFile& other : *files)
                              if (name == "cube" + other.suffix) return other.bytes;
                            return Error{ErrorCode::kBadInput, "test", "no " + name, {}};
                          }};
    const auto back = read_tet_mesh(file);
    ASSERT_TRUE(back.ok()) << back.error().message;
    EXPECT_EQ(back->tets, mesh.tets);
    EXPECT_EQ(back->labels, mesh.labels);
  }
}

TEST(CellData, IsReadBackWhereItStandsWithTheMesh) {
  const TetMesh mesh = test::kuhn_cube(3);
  for (const MeshFormat format : {MeshFormat::kVtu, MeshFormat::kVtk, MeshFormat::kXdmf}) {
    const auto files = write_tet_mesh(mesh, format, with_data(mesh));
    ASSERT_TRUE(files.ok()) << files.error().message;
    const SiblingReader sibling = [&](const std::string& name) -> Result<Bytes> {
      for (const OutputFile& file : *files)
        if (name == "mesh" + file.suffix) return file.bytes;
      return Error{ErrorCode::kBadInput, "test", name, {}};
    };
    MeshArrays arrays;
    const auto back = read_tet_mesh({"mesh" + files->front().suffix, files->front().bytes, sibling}, &arrays);
    ASSERT_TRUE(back.ok()) << back.error().message;
    EXPECT_TRUE(arrays.left_out.empty());
    const std::vector<Field> wanted = test::cube_cell_data(mesh);
    ASSERT_EQ(arrays.cell_data.size(), wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      EXPECT_EQ(arrays.cell_data[i].name, wanted[i].name);
      EXPECT_EQ(arrays.cell_data[i].values, wanted[i].values);
    }
  }
}

TEST(CellData, OfVtuIsThatOfTetrahedraInEveryPiece) {
  const auto array = [](const std::string& name, const std::string& values, const std::string& more = "") {
    return "<DataArray type=\"Float64\" Name=\"" + name + "\" format=\"ascii\"" + more + ">" + values +
           "</DataArray>";
  };
  // A triangle ahead of the tetrahedron: its values are not taken.
  const auto piece = [&](const std::string& arrays) {
    return "<Piece NumberOfPoints=\"4\" NumberOfCells=\"2\"><Points>" +
           array("p", "0 0 0 1 0 0 0 1 0 0 0 1", " NumberOfComponents=\"3\"") + "</Points><Cells>" +
           array("connectivity", "0 1 2 0 1 2 3") + array("offsets", "3 7") + array("types", "5 10") +
           "</Cells><CellData>" + array("label", "0 7") + arrays + "</CellData></Piece>";
  };
  const std::string vectors = array("fibre", "1 0 0 0 1 0", " NumberOfComponents=\"3\"");
  const std::string text =
      "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"><UnstructuredGrid>" +
      piece(array("a", "1 2") + array("once", "1 2") + array("two words", "1 2") + array("large", "1 1e300") +
            vectors) +
      piece(array("a", "3 4") + array("two words", "1 2") + array("large", "1 2") + vectors +
            array("late", "1 2")) +
      "</UnstructuredGrid></VTKFile>";
  MeshArrays arrays;
  const Result<TetMesh> mesh = read_tet_mesh({"two.vtu", Bytes(text.begin(), text.end()), {}}, &arrays);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  ASSERT_EQ(mesh->tets.size(), 2U);
  ASSERT_EQ(arrays.cell_data.size(), 1U);
  EXPECT_EQ(arrays.cell_data[0].name, "a");
  EXPECT_EQ(arrays.cell_data[0].values, (std::vector<float>{2, 4}));
  EXPECT_EQ(arrays.left_out, (std::vector<std::string>{"once", "two words", "large", "fibre", "late"}));
}

TEST(CellData, IsOneFileEachBesideOpenCarpWithOneValueALine) {
  const TetMesh mesh = test::kuhn_cube(2);
  const auto files = write_tet_mesh(mesh, MeshFormat::kCarp, with_data(mesh));
  ASSERT_TRUE(files.ok());
  ASSERT_EQ(files->size(), 5U);
  EXPECT_EQ((*files)[3].suffix, ".majority_label.dat");
  EXPECT_EQ((*files)[4].suffix, ".fraction_300.dat");
  for (std::size_t i = 0; i < 2; ++i) {
    std::istringstream in(test::text_of((*files)[3 + i].bytes));
    const Field data = test::cube_cell_data(mesh)[i];
    for (const float wanted : data.values) {
      float value = -1;
      ASSERT_TRUE(in >> value);
      EXPECT_EQ(value, wanted);
    }
    std::string more;
    EXPECT_FALSE(in >> more);
  }
}

TEST(CellData, IsASolutionBesideMedit) {
  const TetMesh mesh = test::kuhn_cube(2);
  const auto files = write_tet_mesh(mesh, MeshFormat::kMedit, with_data(mesh));
  ASSERT_TRUE(files.ok());
  ASSERT_EQ(files->size(), 2U);
  EXPECT_EQ((*files)[1].suffix, ".sol");
  const std::string text = test::text_of((*files)[1].bytes);
  EXPECT_NE(text.find("# fields majority_label fraction_300\nSolAtTetrahedra\n48\n2 1 1\n"),
            std::string::npos);
}

TEST(CellData, AddsNoFileAndNoByteWhereThereIsNone) {
  const TetMesh mesh = test::kuhn_cube(2);
  EXPECT_EQ(write_tet_mesh(mesh, MeshFormat::kCarp, {})->size(), 3U);
  EXPECT_EQ(write_tet_mesh(mesh, MeshFormat::kMedit, {})->size(), 1U);
  EXPECT_EQ(write_tet_mesh(mesh, MeshFormat::kMsh, {})->size(), 1U);
}

TEST(CellData, IsRefusedWithABadNameLengthOrValue) {
  const TetMesh mesh = test::kuhn_cube(2);
  const std::vector<float> good(mesh.tets.size(), 1);
  std::vector<float> infinite = good;
  infinite[7] = std::numeric_limits<float>::infinity();
  for (const Field& data :
       {test::tet_values("", good), test::tet_values("a b", good), test::tet_values("a\"/>", good),
        test::tet_values("../x", good), test::tet_values("x", {1, 2}), test::tet_values("x", infinite)}) {
    const auto files = write_tet_mesh(mesh, MeshFormat::kVtu, {PatientSpace::kRas, {}, {data}});
    ASSERT_FALSE(files.ok()) << data.name;
    EXPECT_EQ(files.error().code, ErrorCode::kInternal);
  }
}

}  // namespace
}  // namespace voxtet
