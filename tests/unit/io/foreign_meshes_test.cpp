// Meshes as other programs write them: without labels, with labels that are none of ours, quadratic.
#include <cmath>
#include <string>
#include <vector>

#include "unit/io/mesh_texts.h"

namespace voxtet::test {
namespace {

/// A mesh from text, and what is said of it.
struct Read {
  TetMesh mesh;
  MeshArrays arrays;
  std::string notes() const {
    std::string all;
    for (const std::string& note : arrays.notes) all += note + "\n";
    return all;
  }
};

Read read(const std::string& name, const std::string& text, const std::string& label_array = {}) {
  const Bytes bytes = bytes_of(text);
  Read out;
  Result<TetMesh> mesh = read_tet_mesh({name, bytes, {}}, &out.arrays, label_array);
  EXPECT_TRUE(mesh) << mesh.error().message;
  if (mesh) out.mesh = std::move(mesh).value();
  return out;
}

std::string error_of(const std::string& name, const std::string& text, const std::string& label_array = {}) {
  const Bytes bytes = bytes_of(text);
  const Result<TetMesh> mesh = read_tet_mesh({name, bytes, {}}, nullptr, label_array);
  EXPECT_FALSE(mesh);
  return mesh ? "" : mesh.error().message;
}

const std::vector<Tet> kOneTet{{0, 1, 2, 3}};
const std::vector<Eigen::Vector3d> kCorners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

TEST(ForeignMsh, WithoutGroupsHasTheLabelsOfGeometricEntities) {
  const Read v22 = read("a.msh", replaced(kMsh22Text, "2 4 2 4 1", "2 4 2 0 8"));
  EXPECT_EQ(v22.mesh.labels, std::vector<Label>{8});
  EXPECT_EQ(v22.notes(), "no physical groups of volumes: the labels are the tags of geometric entities\n");
  EXPECT_TRUE(v22.arrays.infos.empty());
  const Read v41 = read("a.msh", replaced(kMsh41Text, "2 6 8 0", "0 0"));
  EXPECT_EQ(v41.mesh.labels, std::vector<Label>{3});
  EXPECT_EQ(v41.notes(), v22.notes());
}

TEST(ForeignMsh, TakesTheArrayThatIsAskedFor) {
  EXPECT_EQ(read("a.msh", kMsh22Text, "gmsh:geometrical").mesh.labels, std::vector<Label>{1});
  EXPECT_EQ(read("a.msh", kMsh22Text, "gmsh:physical").mesh.labels, std::vector<Label>{4});
  EXPECT_NE(error_of("a.msh", kMsh22Text, "tag").find("\"tag\""), std::string::npos);
}

TEST(ForeignLabels, ThatAreNoneBecomeFreeOnes) {
  const Read zero = read("a.mesh", replaced(kMeditText, "1 2 3 5 9", "1 2 3 5 0"));
  EXPECT_EQ(zero.mesh.labels, std::vector<Label>{1});
  EXPECT_EQ(zero.notes(), "reference 0 becomes label 1 (labels are 1 to 65535)\n");
  const Read mixed =
      read("a.mesh", replaced(kMeditText, "Tetrahedra 1\n1 2 3 5 9",
                              "Tetrahedra 4\n1 2 3 5 1\n1 2 3 5 70000\n1 2 3 5 -5\n1 2 3 5 3"));
  EXPECT_EQ(mixed.mesh.labels, (std::vector<Label>{1, 4, 2, 3}));
  EXPECT_EQ(mixed.notes(), "reference -5 becomes label 2, 70000 becomes label 4 (labels are 1 to 65535)\n");
}

TEST(ForeignVtu, WithoutLabelsIsOneRegionOrHasThoseOfAnotherArray) {
  const std::string text = replaced(kVtuText, "\"label\" format", "\"tag\" format");
  const Read one = read("a.vtu", text);
  EXPECT_EQ(one.mesh.labels, std::vector<Label>{1});
  EXPECT_EQ(one.notes(),
            "no cell array \"label\", found \"other\" \"tag\" (--label-array NAME takes one): all tetrahedra "
            "are one region, label 1\n");
  EXPECT_EQ(read("a.vtu", text, "tag").mesh.labels, std::vector<Label>{65535});
  EXPECT_NE(error_of("a.vtu", text, "nothing").find("no CellData array \"nothing\", found \"other\" \"tag\""),
            std::string::npos);
}

const std::string kVtkText = R"(# vtk DataFile Version 2.0
of somebody else
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 5 float
0 0 0  1 0 0  0 1 0
0 0 1  7 7 7
CELLS 2 9
3 0 1 2
4 0 1 2 3
CELL_TYPES 2
5
10
POINT_DATA 5
SCALARS height double
LOOKUP_TABLE mine
0 1 2 nan 4
LOOKUP_TABLE mine 1
0.5 0.5 0.5 1
CELL_DATA 2
SCALARS tag int 1
LOOKUP_TABLE default
3 8
VECTORS way float
0 0 1  0 1 0
FIELD FieldData 2
names 1 2 string
a triangle
a tetrahedron
area 1 2 float
0.5 nan
)";

TEST(ForeignVtk, IsReadWithItsOtherCellsAndArrays) {
  const Read one = read("a.vtk", kVtkText);
  EXPECT_EQ(one.mesh.tets, kOneTet);
  EXPECT_EQ(one.mesh.points.size(), 5U);
  EXPECT_EQ(one.mesh.labels, std::vector<Label>{1});
  EXPECT_EQ(one.notes(),
            "no cell array \"label\", found \"tag\" \"way\" \"area\" (--label-array NAME takes one): all "
            "tetrahedra are one region, label 1\n");
  EXPECT_EQ(one.arrays.left_out, std::vector<std::string>{"area"});
  ASSERT_EQ(one.arrays.cell_data.size(), 2U);
  EXPECT_EQ(one.arrays.cell_data[1].values, (std::vector<float>{0, 1, 0}));
  const Read tag = read("a.vtk", kVtkText, "tag");
  EXPECT_EQ(tag.mesh.labels, std::vector<Label>{8});
  EXPECT_TRUE(tag.notes().empty());
}

TEST(ForeignVtk, IsReadInBinary) {
  for (const bool version_5 : {true, false}) {
    const Bytes bytes = binary_vtk("vtk output", version_5);
    MeshArrays arrays;
    const Result<TetMesh> mesh = read_tet_mesh({"a.vtk", bytes, {}}, &arrays);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh->tets, kOneTet);
    EXPECT_EQ(mesh->labels, std::vector<Label>{12});
    EXPECT_EQ(mesh->points[3], Eigen::Vector3d(0, 0, 1));
    ASSERT_EQ(arrays.cell_data.size(), 1U);
    EXPECT_EQ(arrays.cell_data[0].values, std::vector<float>{2.25F});
  }
}

TEST(ForeignVtk, NamesWhatIsWrong) {
  EXPECT_NE(
      error_of("a.vtk", replaced(kVtkText, "4 0 1 2 3", "4 0 1 2 5")).find("cell 1: point 5, expected 0"),
      std::string::npos);
  EXPECT_NE(
      error_of("a.vtk", replaced(kVtkText, "UNSTRUCTURED_GRID", "POLYDATA")).find("POLYDATA, expected UNS"),
      std::string::npos);
  EXPECT_NE(error_of("a.vtk", replaced(kVtkText, "CELLS 2 9", "CELLS 2 8")).find("line"), std::string::npos);
  EXPECT_NE(error_of("a.vtk", replaced(kVtkText, "0 0 1  7", "0 0 x  7")).find("\"x\""), std::string::npos);
  EXPECT_NE(error_of("a.vtk", replaced(kVtkText, "POINTS 5 float", "POINTS 5 real")).find("\"real\""),
            std::string::npos);
}

TEST(ForeignXdmf, IsReadFromItsText) {
  const Read one = read("a.xdmf", kXdmfText);
  EXPECT_EQ(one.mesh.tets, kOneTet);
  EXPECT_EQ(one.mesh.labels, std::vector<Label>{1});
  EXPECT_NE(one.notes().find("found \"tag\""), std::string::npos);
  EXPECT_EQ(read("a.xdmf", kXdmfText, "tag").mesh.labels, std::vector<Label>{9});
  EXPECT_NE(
      error_of("a.xdmf", replaced(kXdmfText, "0 1 2 3<", "0 1 2 5<")).find("the point 5, expected 0 to 4"),
      std::string::npos);
  EXPECT_NE(error_of("a.xdmf", replaced(kXdmfText, "Tetrahedron", "Triangle")).find("\"triangle\""),
            std::string::npos);
  EXPECT_NE(error_of("a.xdmf", replaced(kXdmfText, "Format=\"XML\"", "Format=\"Binary\"")).find("\"binary\""),
            std::string::npos);
}

const std::string kNastranText = R"($ of somebody else
SOL 101
CEND
BEGIN BULK
GRID           1              0.      0.      0.
GRID,2,,1.,0.,.0
GRID*                  3                              0.         1.0D+00
*                     0.
GRID           4              0.      0.     1.0-0
GRID          15             7.1     7.2   7.3+1
CTETRA        10       3       1       2       3       4
CTETRA,11,3,2,1,3,15
CQUAD4         9       1       1       2       3       4
PSOLID         3       1
ENDDATA
what follows is not read
)";

TEST(ForeignNastran, IsReadInAllItsForms) {
  const Read bulk = read("a.bdf", kNastranText);
  EXPECT_EQ(bulk.mesh.tets, (std::vector<Tet>{{0, 1, 2, 3}, {1, 0, 2, 4}}));
  EXPECT_EQ(bulk.mesh.labels, (std::vector<Label>{3, 3}));
  EXPECT_EQ(bulk.mesh.points[2], Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(bulk.mesh.points[4], Eigen::Vector3d(7.1, 7.2, 73));
  const std::string alone = kNastranText.substr(kNastranText.find("GRID"));
  EXPECT_EQ(read("a.nas", alone).mesh.tets, bulk.mesh.tets);
  EXPECT_NE(error_of("a.bdf", replaced(kNastranText, "3       4\nCTETRA,11", "3      44\nCTETRA,11"))
                .find("node 44"),
            std::string::npos);
  EXPECT_NE(
      error_of("a.bdf", replaced(kNastranText, "GRID,2,,", "GRID,2,7,")).find("line 6: GRID 2 is in the coo"),
      std::string::npos);
  EXPECT_NE(error_of("a.bdf", replaced(kNastranText, "GRID,2,,1.", "GRID,2,,one")).find("\"one\""),
            std::string::npos);
}

const std::string kAbaqusText = R"(** of somebody else
*Heading
a part
*Node
1, 0, 0, 0
2, 1., 0, 0
3, 0, 1, 0
4, 0, 0, 1
5, 5, 5, 5
*Element, type=S3, elset=skin
7, 1, 2, 3
*Element, type=C3D4
10, 1, 2, 3, 4
11, 2, 1,
3, 5
*Elset, elset=Whole, generate
10, 11, 1
*Elset, elset=Rest
11
*Solid Section, elset=Whole, material=soft
,
*Solid Section, elset=Rest,
 material=hard
,
)";

TEST(ForeignAbaqus, HasALabelForEachSection) {
  const Read part = read("a.inp", kAbaqusText);
  EXPECT_EQ(part.mesh.tets, (std::vector<Tet>{{0, 1, 2, 3}, {1, 0, 2, 4}}));
  EXPECT_EQ(part.mesh.labels, (std::vector<Label>{1, 2}));
  ASSERT_EQ(part.arrays.infos.size(), 2U);
  EXPECT_EQ(part.arrays.infos[0].name, "Whole");
  EXPECT_EQ(part.arrays.infos[1].name, "Rest");
  const Read sets = read("a.inp", replaced(kAbaqusText, "type=C3D4", "elset=Muscle, type=C3D4H"));
  EXPECT_EQ(sets.mesh.labels, (std::vector<Label>{1, 1}));
  EXPECT_EQ(sets.arrays.infos.at(0).name, "Muscle");
  const Read none = read("a.inp", kAbaqusText.substr(0, kAbaqusText.find("*Solid")));
  EXPECT_EQ(none.mesh.labels, (std::vector<Label>{1, 1}));
  EXPECT_EQ(none.notes(), "no element sets: all tetrahedra are one region, label 1\n");
  EXPECT_NE(error_of("a.inp", replaced(kAbaqusText, "10, 1, 2, 3, 4", "10, 1, 2, 3, 9")).find("node 9"),
            std::string::npos);
  EXPECT_NE(error_of("a.inp", replaced(kAbaqusText, "2, 1., 0, 0", "2, 1., 0, zero")).find("line 6"),
            std::string::npos);
}

TEST(ForeignTetgen, CountsFromZeroAndMayHaveNoAttributes) {
  const std::string node = "4 3 0 1\n0 0 0 0 1\n1 1 0 0 1\n2 0 1 0 1\n3 0 0 1 1\n# Generated by tetgen\n";
  const auto ele = [&](const std::string& text) {
    const Bytes bytes = bytes_of(text);
    const SiblingReader sibling = [&](const std::string& name) -> Result<Bytes> {
      if (name == "a.1.node") return bytes_of(node);
      return Error{ErrorCode::kBadInput, "test", name + " is missing", {}};
    };
    Read out;
    Result<TetMesh> mesh = read_tet_mesh({"there/a.1.ele", bytes, sibling}, &out.arrays);
    EXPECT_TRUE(mesh) << mesh.error().message;
    if (mesh) out.mesh = std::move(mesh).value();
    return out;
  };
  const Read none = ele("1 4 0\n0 0 1 2 3\n");
  EXPECT_EQ(none.mesh.tets, kOneTet);
  EXPECT_EQ(none.mesh.points, kCorners);
  EXPECT_EQ(none.notes(), "no attributes in .ele: all tetrahedra are one region, label 1\n");
  const Read two = ele("1 4 2\n0 0 1 2 3 -10 0.5\n");
  EXPECT_EQ(two.mesh.labels, std::vector<Label>{1});
  EXPECT_EQ(two.notes(), "attribute -10 becomes label 1 (labels are 1 to 65535)\n");
  ASSERT_EQ(two.arrays.cell_data.size(), 1U);
  EXPECT_EQ(two.arrays.cell_data[0].name, "attribute_2");
  EXPECT_NE(error_of("a.ele", "1 4 0\n0 0 1 2 3\n").find("needs a.node beside it"), std::string::npos);
}

/// Ten points: corners, then the middles of edges.
std::string ten_points(const std::string& before, const std::string& separator, const std::string& after) {
  std::string text;
  const std::vector<Eigen::Vector3d> corners = kCorners;
  std::vector<Eigen::Vector3d> all = corners;
  for (const auto& [a, b] :
       std::vector<std::pair<std::size_t, std::size_t>>{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}})
    all.push_back(0.5 * (corners[a] + corners[b]));
  for (std::size_t p = 0; p < all.size(); ++p) {
    std::string number = std::to_string(p + 1), line = before;
    if (const std::size_t at = line.find('#'); at != std::string::npos) line.replace(at, 1, number);
    text += line;
    for (Eigen::Index d = 0; d < 3; ++d) text += (d == 0 ? "" : separator) + std::to_string(all[p][d]);
    text += after;
  }
  return text;
}

TEST(QuadraticTetrahedra, GiveTheirCorners) {
  const std::vector<std::pair<std::string, std::string>> files{
      {"a.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 10 double\n" +
                    ten_points("", " ", "\n") + "CELLS 1 11\n10 0 1 2 3 4 5 6 7 8 9\nCELL_TYPES 1\n24\n"},
      {"a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n" + ten_points("# ", " ", "\n") +
                    "$EndNodes\n$Elements\n1\n1 11 2 1 1 1 2 3 4 5 6 7 8 9 10\n$EndElements\n"},
      {"a.bdf", ten_points("GRID,#,,", ",", "\n") + "CTETRA,1,1,1,2,3,4,5,6,\n,7,8,9,10\nENDDATA\n"},
      {"a.inp", "*NODE\n" + ten_points("#, ", ", ", "\n") +
                    "*ELEMENT, TYPE=C3D10, ELSET=a_1\n1, 1, 2, 3, 4, 5, 6,\n7, 8, 9, 10\n"},
      {"a.feb", "<febio_spec version=\"4.0\"><Mesh><Nodes>" +
                    ten_points("<node id=\"#\">", ",", "</node>\n") +
                    "</Nodes><Elements type=\"tet10\" name=\"a_1\"><elem id=\"1\">1,2,3,4,5,6,7,8,9,10</elem>"
                    "</Elements></Mesh></febio_spec>"}};
  for (const auto& [name, text] : files) {
    const Read one = read(name, text);
    EXPECT_EQ(one.mesh.points, kCorners) << name;
    EXPECT_EQ(one.mesh.tets, kOneTet) << name;
    EXPECT_EQ(one.mesh.labels, std::vector<Label>{1}) << name;
    EXPECT_NE(
        one.notes().find("1 of 1 tetrahedra have points on their edges: their corners are read, 6 other "
                         "points left out"),
        std::string::npos)
        << name;
  }
}

TEST(LabelArray, IsRefusedWhereThereAreNoNames) {
  EXPECT_NE(error_of("a.mesh", kMeditText, "tag").find("only .vtu, .vtk, .xdmf and .msh have"),
            std::string::npos);
}

}  // namespace
}  // namespace voxtet::test
