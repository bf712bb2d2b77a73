// Meshes written by hand, and what is said of their mistakes.
#include "unit/io/mesh_texts.h"

namespace voxtet::test {
namespace {

TEST(ReadMedit, SkipsOtherSectionsAndCommentsInAnyOrder) {
  const auto mesh = read_text("a.mesh", kMeditText);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->points.size(), 5U);
  EXPECT_EQ(mesh->tets, (std::vector<Tet>{{0, 1, 2, 4}}));
  EXPECT_EQ(mesh->labels, std::vector<Label>{9});
}

TEST(ReadMedit, NamesWhatIsWrong) {
  expect_refusal("a.mesh", replaced(kMeditText, "1 2 3 5 9", "1 2 3 6 9"),
                 {"a.mesh", "tetrahedron 1", "vertex 6", "1 to 5"});
  expect_refusal("a.mesh", replaced(kMeditText, "1 2 3 5 9", "1 2 3 0 9"), {"line 5", "\"0\""});
  expect_refusal("a.mesh", replaced(kMeditText, "1e0", "nan"), {"line 12", "nan", "finite"});
  expect_refusal("a.mesh", replaced(kMeditText, "5\n0 0", "4000000000\n0 0"), {"4000000000 vertices"});
  expect_refusal("a.mesh", replaced(kMeditText, "End\n", ""), {"ends", "End"});
  expect_refusal("a.mesh", replaced(kMeditText, "Tetrahedra 1\n1 2 3 5 9\n", ""), {"no linear tetrahedra"});
  expect_refusal("a.mesh", replaced(kMeditText, "Dimension 3", "Dimension 2"), {"line 3", "Dimension"});
  expect_refusal("a.txt", "hello",
                 {"a.txt", "VTU", "legacy VTK", "MSH", "MEDIT", "Nastran", "TetGen", "openCARP"});
}

TEST(ReadMsh, Reads22WithSparseTagsInAnyOrder) {
  const auto mesh = read_text("a.msh", kMsh22Text);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->points, (std::vector<Eigen::Vector3d>{{0, 0, 1}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}}));
  EXPECT_EQ(mesh->tets, (std::vector<Tet>{{1, 3, 2, 0}}));
  EXPECT_EQ(mesh->labels, std::vector<Label>{4});
}

TEST(ReadMsh, Reads41WithParametricNodesAndTakesTheFirstGroup) {
  const auto mesh = read_text("a.msh", kMsh41Text);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->points, (std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(mesh->tets, (std::vector<Tet>{{0, 1, 2, 3}}));
  EXPECT_EQ(mesh->labels, std::vector<Label>{6});
}

TEST(ReadMsh, NamesWhatIsWrong) {
  expect_refusal("a.msh", replaced(kMsh22Text, "20 15 5\n", "20 15 6\n"), {"element 2", "node 6", "4 nodes"});
  expect_refusal("a.msh", replaced(kMsh22Text, "5 0 0 1", "10 0 0 1"), {"node tag 10", "twice"});
  expect_refusal("a.msh", replaced(kMsh22Text, "0 0 1\n", "0 0 inf\n"), {"line 12", "inf"});
  expect_refusal("a.msh", replaced(kMsh22Text, "$EndElements\n", ""), {"$EndElements"});
  expect_refusal("a.msh", replaced(kMsh22Text, "2.2 0 8", "3.0 0 8"), {"line 2", "3.0", "4.1 or 2.2"});
  expect_refusal("a.msh", replaced(kMsh22Text, "8 2 2 1 1", "8 77 2 1 1"), {"element type 77"});
  expect_refusal("a.msh", replaced(kMsh41Text, "2 4 1 4", "2 5 1 4"), {"4 nodes", "says 5"});
  expect_refusal("a.msh", replaced(kMsh41Text, "2 2 1 2", "2 3 1 2"), {"2 elements", "says 3"});
  expect_refusal("a.msh", replaced(kMsh41Text, "$EndNodeData\n", ""), {"$EndNodeData"});
}

TEST(ReadVtu, ReadsAsciiMixedCellsAndTheSpace) {
  const auto mesh = read_text("a.vtu", kVtuText);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->points,
            (std::vector<Eigen::Vector3d>{{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {2.5, -4, 8}}));
  EXPECT_EQ(mesh->tets, (std::vector<Tet>{{0, 1, 2, 3}}));
  EXPECT_EQ(mesh->labels, std::vector<Label>{65535});
}

TEST(ReadVtu, JoinsPieces) {
  const std::size_t begin = kVtuText.find("<Piece"), end = kVtuText.find("</Piece>") + 8;
  const std::string piece = kVtuText.substr(begin, end - begin);
  const auto mesh = read_text("a.vtu", kVtuText.substr(0, end) + piece + kVtuText.substr(end));
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->points.size(), 10U);
  EXPECT_EQ(mesh->tets, (std::vector<Tet>{{0, 1, 2, 3}, {5, 6, 7, 8}}));
}

TEST(ReadVtu, NamesWhatIsWrong) {
  expect_refusal("a.vtu", replaced(kVtuText, "0 1 2 3<", "0 1 2 5<"),
                 {"a.vtu", "cell 1", "point 5", "0 to 4"});
  expect_refusal("a.vtu", replaced(kVtuText, "0 1 2 3<", "0 1 2 -1<"), {"cell 1", "point -1"});
  expect_refusal("a.vtu", replaced(kVtuText, "0 65535", "0 1.5"), {"label", "1.5"});
  expect_refusal("a.vtu", replaced(kVtuText, "-2.5", "nan"), {"Points", "nan"});
  expect_refusal("a.vtu", replaced(kVtuText, "-2.5", ""), {"Points", "14 numbers, expected 15"});
  expect_refusal("a.vtu", replaced(kVtuText, "-2.5", "1 1"), {"Points", "behind 15 numbers"});
  expect_refusal("a.vtu", replaced(kVtuText, "3 7", "8 7"), {"offsets", "cell 1"});
  expect_refusal("a.vtu", replaced(kVtuText, "5 10", "5 5"), {"no linear tetrahedra"});
  expect_refusal("a.vtu", replaced(kVtuText, "UnstructuredGrid'", "PolyData'"),
                 {"PolyData", "UnstructuredGrid"});
  expect_refusal("a.vtu", replaced(kVtuText, "</Cells>", ""), {"line 23", "</Piece>"});
  expect_refusal("a.vtu", replaced(kVtuText, "Points=\"5\"", "Points=\"4000000000\""),
                 {"Points", "12000000000"});
  expect_refusal("a.vtu", replaced(kVtuText, "version=\"0.1\"", "byte_order=\"BigEndian\""),
                 {"byte_order", "BigEndian"});
  expect_refusal("a.vtu", replaced(kVtuText, "version=\"0.1\"", "compressor=\"vtkLZ4DataCompressor\""),
                 {"vtkLZ4"});
}

}  // namespace
}  // namespace voxtet::test
