// Second-order tetrahedra in the files of every format that has a place for them. What other readers make of
// them: tests/integration/written_second_order.py.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/mesh/write_mesh.h"
#include "mesh_texts.h"
#include "support/labelled_mesh.h"

namespace voxtet {
namespace {

using test::nodes_of_two_tets;
using test::read_export;
using test::text_of;
using test::two_tets;
using test::written;

constexpr MeshFormat kSecondOrder[] = {MeshFormat::kVtu,    MeshFormat::kMsh,   MeshFormat::kMsh22,
                                       MeshFormat::kAbaqus, MeshFormat::kFebio, MeshFormat::kXdmf};

TEST(SecondOrder, IsReadBackByItsCorners) {
  const TetMesh mesh = two_tets();
  for (const MeshFormat format : kSecondOrder) {
    const Result<TetMesh> read = read_export(written(mesh, format, {.midside = nodes_of_two_tets()}));
    ASSERT_TRUE(read.ok()) << read.error().message;
    ASSERT_EQ(read->points.size(), 5U);
    ASSERT_EQ(read->tets.size(), 2U);
    for (std::size_t t = 0; t < 2; ++t)
      for (std::size_t c = 0; c < 4; ++c)
        EXPECT_EQ(read->points[read->tets[t][c]], mesh.points[mesh.tets[t][c]]) << static_cast<int>(format);
    EXPECT_EQ(read->labels, mesh.labels);
  }
}

TEST(SecondOrder, HasTheNodesOfEachFormatInItsOrder) {
  // The second tetrahedron is 0 1 2 3 (from 0); the nodes on edges follow the five corners.
  const TetMesh mesh = two_tets();
  const WriteMeshOptions options{.midside = nodes_of_two_tets()};
  const auto expect = [&](MeshFormat format, const std::string& suffix, const std::string& line) {
    const std::string text = text_of(written(mesh, format, options), suffix);
    EXPECT_NE(text.find(line), std::string::npos) << suffix << " has no " << line << " in\n" << text;
  };
  expect(MeshFormat::kAbaqus, ".inp",
         "*ELEMENT, TYPE=C3D10, ELSET=label_5\n2, 1, 2, 3, 4, 6, 10, 7, 8, 11, 13\n");
  expect(MeshFormat::kFebio, ".feb",
         "<Elements type=\"tet10\" name=\"label_5\">\n<elem id=\"2\">1,2,3,4,6,10,7,8,11,13</elem>");
  expect(MeshFormat::kMsh22, ".msh", "\n2 11 2 5 5 1 2 3 4 6 10 7 8 13 11\n");
  expect(MeshFormat::kXdmf, ".xdmf", "TopologyType=\"Tetrahedron_10\" NodesPerElement=\"10\"");
  expect(MeshFormat::kXdmf, ".facets.xdmf", "TopologyType=\"Triangle_6\" NodesPerElement=\"6\"");
  expect(MeshFormat::kFebio, ".feb", "<tri6 id=\"1\">");
}

TEST(SecondOrder, GivesNodesOnEdgesTheMeanOfTheirEnds) {
  const TetMesh mesh = two_tets();
  const Field values{"time", "", "ms", On::kPoints, Scale::kSequential, 1, {1, 2, 4, 8, 16}};
  const std::string text = text_of(
      written(mesh, MeshFormat::kVtu, {.point_data = {values}, .midside = nodes_of_two_tets()}), ".vtu");
  const std::vector<float> wanted{1, 2, 4, 8, 16, 1.5, 2.5, 4.5, 8.5, 3, 5, 9, 6, 10};
  const std::string bytes(reinterpret_cast<const char*>(wanted.data()), 4 * wanted.size());
  EXPECT_NE(text.find(bytes), std::string::npos);
}

TEST(SecondOrder, KeepsNamedSurfaces) {
  const TetMesh mesh = two_tets();
  const WriteMeshOptions options{.surfaces = {{"top", {0, 1}}}, .midside = nodes_of_two_tets()};
  const std::string inp = text_of(written(mesh, MeshFormat::kAbaqus, options), ".inp");
  EXPECT_NE(inp.find("*SURFACE, NAME=top, TYPE=ELEMENT\n"), std::string::npos);
  const std::string vtu = text_of(written(mesh, MeshFormat::kVtu, options), ".surfaces.vtu");
  EXPECT_NE(vtu.find("<Piece NumberOfPoints=\"14\" NumberOfCells=\"7\">"), std::string::npos)
      << "five corners, nine nodes on edges, seven faces";
}

TEST(SecondOrder, IsRefusedWhereItHasNoPlace) {
  for (const MeshFormat format :
       {MeshFormat::kVtk, MeshFormat::kMedit, MeshFormat::kCarp, MeshFormat::kNastran, MeshFormat::kTetgen,
        MeshFormat::kStl, MeshFormat::kLabelStl, MeshFormat::kPly}) {
    const auto files = write_tet_mesh(two_tets(), format, {.midside = nodes_of_two_tets()});
    ASSERT_FALSE(files.ok());
    EXPECT_EQ(files.error().code, ErrorCode::kUsage);
    EXPECT_NE(files.error().message.find("expected .vtu, .msh, .inp, .feb or .xdmf"), std::string::npos);
  }
}

TEST(SecondOrder, IsRefusedWhereNodesAreOfAnotherMesh) {
  for (const auto& spoil :
       std::vector<void (*)(MidsideNodes&)>{[](MidsideNodes& nodes) { nodes.tets.pop_back(); },
                                            [](MidsideNodes& nodes) { nodes.faces.pop_back(); },
                                            [](MidsideNodes& nodes) { nodes.points.pop_back(); },
                                            [](MidsideNodes& nodes) { nodes.tets[1][5] = 9; },
                                            [](MidsideNodes& nodes) { nodes.edges[0][1] = 5; }}) {
    MidsideNodes nodes = nodes_of_two_tets();
    spoil(nodes);
    const auto files = write_tet_mesh(two_tets(), MeshFormat::kVtu, {.midside = nodes});
    ASSERT_FALSE(files.ok());
    EXPECT_EQ(files.error().code, ErrorCode::kInternal);
  }
}

}  // namespace
}  // namespace voxtet
