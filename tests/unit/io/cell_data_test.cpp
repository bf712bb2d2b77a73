#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include "io/read_mesh.h"
#include "io/write_mesh.h"
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
       {MeshFormat::kVtu, MeshFormat::kMsh, MeshFormat::kMedit, MeshFormat::kCarp}) {
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

TEST(CellData, IsOneFileEachBesideOpenCarpWithOneValueALine) {
  const TetMesh mesh = test::kuhn_cube(2);
  const auto files = write_tet_mesh(mesh, MeshFormat::kCarp, with_data(mesh));
  ASSERT_TRUE(files.ok());
  ASSERT_EQ(files->size(), 5U);
  EXPECT_EQ((*files)[3].suffix, ".majority_label.dat");
  EXPECT_EQ((*files)[4].suffix, ".fraction_300.dat");
  for (std::size_t i = 0; i < 2; ++i) {
    std::istringstream in(test::text_of((*files)[3 + i].bytes));
    const CellData data = test::cube_cell_data(mesh)[i];
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
  for (const CellData& data : {CellData{"", good}, CellData{"a b", good}, CellData{"a\"/>", good},
                               CellData{"../x", good}, CellData{"x", {1, 2}}, CellData{"x", infinite}}) {
    const auto files = write_tet_mesh(mesh, MeshFormat::kVtu, {PatientSpace::kRas, {}, {data}});
    ASSERT_FALSE(files.ok()) << data.name;
    EXPECT_EQ(files.error().code, ErrorCode::kInternal);
  }
}

}  // namespace
}  // namespace voxtet
