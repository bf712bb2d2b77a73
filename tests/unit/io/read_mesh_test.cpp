#include "io/read_mesh.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "io/write_mesh.h"
#include "support/check_tets.h"
#include "support/labelled_mesh.h"

namespace voxtet {
namespace {

Bytes bytes_of(const std::string& text) {
  return {text.begin(), text.end()};
}

Result<TetMesh> read_text(const std::string& name, const std::string& text) {
  const Bytes bytes = bytes_of(text);
  return read_tet_mesh({name, bytes, {}});
}

/// Reads the files of one export as if they stood in one folder.
Result<TetMesh> read_export(const std::vector<OutputFile>& files) {
  std::map<std::string, Bytes> folder;
  for (const OutputFile& file : files) folder["mesh" + file.suffix] = file.bytes;
  const SiblingReader sibling = [&](const std::string& name) -> Result<Bytes> {
    if (const auto found = folder.find(name); found != folder.end()) return found->second;
    return Error{ErrorCode::kBadInput, "test", name + " is missing", {}};
  };
  return read_tet_mesh({"folder/mesh" + files.front().suffix, files.front().bytes, sibling});
}

void expect_same(const TetMesh& read, const TetMesh& written) {
  EXPECT_TRUE(read.points == written.points);
  EXPECT_TRUE(read.tets == written.tets);
  EXPECT_TRUE(read.labels == written.labels);
  EXPECT_TRUE(read.faces.empty());
}

/// The message of a failure; its code is kBadInput.
std::string refusal(const Result<TetMesh>& result) {
  EXPECT_FALSE(result.ok());
  if (result.ok()) return {};
  EXPECT_EQ(result.error().code, ErrorCode::kBadInput);
  return result.error().message;
}

void expect_refusal(const std::string& name, const std::string& text, const std::vector<std::string>& parts) {
  const std::string message = refusal(read_text(name, text));
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
}

TEST(KuhnCube, IsAValidLabelledMesh) {
  const TetMesh mesh = test::kuhn_cube(4);
  ASSERT_EQ(mesh.tets.size(), 384U);
  test::check_tets(mesh);
}

TEST(ReadTetMesh, GivesExactlyWhatWasWritten) {
  const TetMesh mesh = test::kuhn_cube(5);
  for (const MeshFormat format : {MeshFormat::kVtu, MeshFormat::kMsh, MeshFormat::kMedit})
    for (const PatientSpace space : {PatientSpace::kRas, PatientSpace::kLps}) {
      const auto files = write_tet_mesh(mesh, format, {space, test::cube_infos()});
      ASSERT_TRUE(files.ok());
      const auto read = read_export(*files);
      ASSERT_TRUE(read.ok()) << read.error().message;
      expect_same(*read, mesh);
    }
}

TEST(ReadTetMesh, KeepsPointsThatNoTetrahedronUses) {
  TetMesh mesh = test::kuhn_cube(2);
  mesh.points.insert(mesh.points.begin(), Eigen::Vector3d(1, 2, 3));
  for (Tet& tet : mesh.tets)
    for (std::uint32_t& corner : tet) ++corner;
  for (Triangle& face : mesh.faces)
    for (std::uint32_t& corner : face) ++corner;
  for (const MeshFormat format : {MeshFormat::kVtu, MeshFormat::kMsh, MeshFormat::kMedit}) {
    const auto files = write_tet_mesh(mesh, format, {});
    ASSERT_TRUE(files.ok());
    const auto read = read_export(*files);
    ASSERT_TRUE(read.ok()) << read.error().message;
    expect_same(*read, mesh);
  }
}

TEST(ReadTetMesh, ReadsOpenCarpFromEitherFile) {
  const TetMesh mesh = test::kuhn_cube(3);
  auto files = write_tet_mesh(mesh, MeshFormat::kCarp, {});
  ASSERT_TRUE(files.ok());
  for (int turn = 0; turn < 3; ++turn, std::rotate(files->begin(), files->begin() + 1, files->end())) {
    const auto read = read_export(*files);
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_TRUE(read->tets == mesh.tets);
    EXPECT_TRUE(read->labels == mesh.labels);
    ASSERT_EQ(read->points.size(), mesh.points.size());
    // Two roundings, of the product and of the quotient.
    for (std::size_t p = 0; p < mesh.points.size(); ++p)
      EXPECT_LT((read->points[p] - mesh.points[p]).norm(), 1e-14);
  }
  EXPECT_NE(refusal(read_tet_mesh({"a.elem", files->back().bytes, {}})).find("a.pts"), std::string::npos);
}

TEST(ReadTetMeshFile, FindsTheFilesOfAMeshByAnyOfTheirNames) {
  const auto folder = std::filesystem::temp_directory_path() / "voxtet_read_mesh_file";
  std::filesystem::create_directories(folder);
  const TetMesh mesh = test::kuhn_cube(2);
  const auto files = write_tet_mesh(mesh, MeshFormat::kCarp, {});
  ASSERT_TRUE(files.ok());
  ASSERT_TRUE(write_files((folder / "a.carp").string(), *files).ok());
  for (const char* name : {"a.carp", "a.elem", "a.pts", "a.lon"}) {
    const auto read = read_tet_mesh_file((folder / name).string());
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_TRUE(read->tets == mesh.tets);
  }
  std::filesystem::remove(folder / "a.pts");
  EXPECT_NE(refusal(read_tet_mesh_file((folder / "a.elem").string())).find("a.pts"), std::string::npos);
  EXPECT_NE(refusal(read_tet_mesh_file((folder / "b.vtu").string())).find("b.vtu"), std::string::npos);
  std::filesystem::remove_all(folder);
}

const std::string kMesh = R"(MeshVersionFormatted 2
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

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(ReadMedit, SkipsOtherSectionsAndCommentsInAnyOrder) {
  const auto mesh = read_text("a.mesh", kMesh);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->points.size(), 5U);
  EXPECT_EQ(mesh->tets, (std::vector<Tet>{{0, 1, 2, 4}}));
  EXPECT_EQ(mesh->labels, std::vector<Label>{9});
}

TEST(ReadMedit, NamesWhatIsWrong) {
  expect_refusal("a.mesh", replaced(kMesh, "1 2 3 5 9", "1 2 3 6 9"),
                 {"a.mesh", "tetrahedron 1", "vertex 6", "1 to 5"});
  expect_refusal("a.mesh", replaced(kMesh, "1 2 3 5 9", "1 2 3 0 9"), {"line 5", "\"0\""});
  expect_refusal("a.mesh", replaced(kMesh, "1 2 3 5 9", "1 2 3 5 0"), {"tetrahedron 1", "reference is 0"});
  expect_refusal("a.mesh", replaced(kMesh, "1e0", "nan"), {"line 12", "nan", "finite"});
  expect_refusal("a.mesh", replaced(kMesh, "5\n0 0", "4000000000\n0 0"), {"4000000000 vertices"});
  expect_refusal("a.mesh", replaced(kMesh, "End\n", ""), {"ends", "End"});
  expect_refusal("a.mesh", replaced(kMesh, "Tetrahedra 1\n1 2 3 5 9\n", ""), {"no linear tetrahedra"});
  expect_refusal("a.mesh", replaced(kMesh, "Dimension 3", "Dimension 2"), {"line 3", "Dimension"});
  expect_refusal("a.txt", "hello", {"a.txt", "VTU", "MSH", "MEDIT", "openCARP"});
}

const std::string kMsh22 = R"($MeshFormat
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

TEST(ReadMsh, Reads22WithSparseTagsInAnyOrder) {
  const auto mesh = read_text("a.msh", kMsh22);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->points, (std::vector<Eigen::Vector3d>{{0, 0, 1}, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}}));
  EXPECT_EQ(mesh->tets, (std::vector<Tet>{{1, 3, 2, 0}}));
  EXPECT_EQ(mesh->labels, std::vector<Label>{4});
}

const std::string kMsh41 = R"($MeshFormat
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

TEST(ReadMsh, Reads41WithParametricNodesAndTakesTheFirstGroup) {
  const auto mesh = read_text("a.msh", kMsh41);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->points, (std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(mesh->tets, (std::vector<Tet>{{0, 1, 2, 3}}));
  EXPECT_EQ(mesh->labels, std::vector<Label>{6});
}

TEST(ReadMsh, NamesWhatIsWrong) {
  expect_refusal("a.msh", replaced(kMsh22, "20 15 5\n", "20 15 6\n"), {"element 2", "node 6", "4 nodes"});
  expect_refusal("a.msh", replaced(kMsh22, "2 4 2 4 1", "2 4 2 0 1"),
                 {"tetrahedron 2", "physical group is 0"});
  expect_refusal("a.msh", replaced(kMsh22, "5 0 0 1", "10 0 0 1"), {"node tag 10", "twice"});
  expect_refusal("a.msh", replaced(kMsh22, "0 0 1\n", "0 0 inf\n"), {"line 12", "inf"});
  expect_refusal("a.msh", replaced(kMsh22, "$EndElements\n", ""), {"$EndElements"});
  expect_refusal("a.msh", replaced(kMsh22, "2.2 0 8", "3.0 0 8"), {"line 2", "3.0", "4.1 or 2.2"});
  expect_refusal("a.msh", replaced(kMsh22, "8 2 2 1 1", "8 77 2 1 1"), {"element type 77"});
  expect_refusal("a.msh", replaced(kMsh41, "2 6 8 0", "0 0"), {"tetrahedron 2", "physical group is 0"});
  expect_refusal("a.msh", replaced(kMsh41, "2 4 1 4", "2 5 1 4"), {"4 nodes", "says 5"});
  expect_refusal("a.msh", replaced(kMsh41, "2 2 1 2", "2 3 1 2"), {"2 elements", "says 3"});
  expect_refusal("a.msh", replaced(kMsh41, "$EndNodeData\n", ""), {"$EndNodeData"});
}

const std::string kVtu = R"(<?xml version="1.0"?>
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

TEST(ReadVtu, ReadsAsciiMixedCellsAndTheSpace) {
  const auto mesh = read_text("a.vtu", kVtu);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->points,
            (std::vector<Eigen::Vector3d>{{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {2.5, -4, 8}}));
  EXPECT_EQ(mesh->tets, (std::vector<Tet>{{0, 1, 2, 3}}));
  EXPECT_EQ(mesh->labels, std::vector<Label>{65535});
}

TEST(ReadVtu, JoinsPieces) {
  const std::size_t begin = kVtu.find("<Piece"), end = kVtu.find("</Piece>") + 8;
  const std::string piece = kVtu.substr(begin, end - begin);
  const auto mesh = read_text("a.vtu", kVtu.substr(0, end) + piece + kVtu.substr(end));
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->points.size(), 10U);
  EXPECT_EQ(mesh->tets, (std::vector<Tet>{{0, 1, 2, 3}, {5, 6, 7, 8}}));
}

TEST(ReadVtu, NamesWhatIsWrong) {
  expect_refusal("a.vtu", replaced(kVtu, "0 1 2 3<", "0 1 2 5<"), {"a.vtu", "cell 1", "point 5", "0 to 4"});
  expect_refusal("a.vtu", replaced(kVtu, "0 1 2 3<", "0 1 2 -1<"), {"cell 1", "point -1"});
  expect_refusal("a.vtu", replaced(kVtu, "0 65535", "0 65536"), {"cell 1", "label is 65536"});
  expect_refusal("a.vtu", replaced(kVtu, "0 65535", "0 1.5"), {"label", "1.5"});
  expect_refusal("a.vtu", replaced(kVtu, "-2.5", "nan"), {"Points", "nan"});
  expect_refusal("a.vtu", replaced(kVtu, "-2.5", ""), {"Points", "14 numbers, expected 15"});
  expect_refusal("a.vtu", replaced(kVtu, "-2.5", "1 1"), {"Points", "behind 15 numbers"});
  expect_refusal("a.vtu", replaced(kVtu, "\"label\" format", "\"tag\" format"),
                 {"\"label\"", "\"other\"", "\"tag\""});
  expect_refusal("a.vtu", replaced(kVtu, "3 7", "8 7"), {"offsets", "cell 1"});
  expect_refusal("a.vtu", replaced(kVtu, "5 10", "5 5"), {"no linear tetrahedra"});
  expect_refusal("a.vtu", replaced(kVtu, "UnstructuredGrid'", "PolyData'"), {"PolyData", "UnstructuredGrid"});
  expect_refusal("a.vtu", replaced(kVtu, "</Cells>", ""), {"line 23", "</Piece>"});
  expect_refusal("a.vtu", replaced(kVtu, "Points=\"5\"", "Points=\"4000000000\""), {"Points", "12000000000"});
  expect_refusal("a.vtu", replaced(kVtu, "version=\"0.1\"", "byte_order=\"BigEndian\""),
                 {"byte_order", "BigEndian"});
  expect_refusal("a.vtu", replaced(kVtu, "version=\"0.1\"", "compressor=\"vtkLZ4DataCompressor\""),
                 {"vtkLZ4"});
}

/// The result must be an error or a mesh whose indices and labels are in range: in both cases there was no
/// crash.
void expect_no_harm(const std::vector<OutputFile>& files, int& read) {
  const auto mesh = read_export(files);
  if (!mesh.ok()) {
    EXPECT_EQ(mesh.error().code, ErrorCode::kBadInput);
    EXPECT_FALSE(mesh.error().message.empty());
    return;
  }
  ++read;
  ASSERT_EQ(mesh->labels.size(), mesh->tets.size());
  for (const Eigen::Vector3d& p : mesh->points) ASSERT_TRUE(p.allFinite());
  for (const Label label : mesh->labels) ASSERT_NE(label, kBackground);
  for (const Tet& tet : mesh->tets)
    for (const std::uint32_t corner : tet) ASSERT_LT(corner, mesh->points.size());
}

std::vector<std::vector<OutputFile>> sample_exports() {
  const TetMesh mesh = test::kuhn_cube(2);
  std::vector<std::vector<OutputFile>> exports;
  for (const MeshFormat format :
       {MeshFormat::kVtu, MeshFormat::kMsh, MeshFormat::kMedit, MeshFormat::kCarp}) {
    auto files = write_tet_mesh(mesh, format, {PatientSpace::kLps, test::cube_infos()});
    EXPECT_TRUE(files.ok());
    // The .elem first: it is the file whose cuts are read below.
    if (files->size() > 1) std::swap((*files)[0], (*files)[1]);
    exports.push_back(std::move(files).value());
  }
  exports.push_back({{".mesh", bytes_of(kMesh)}});
  exports.push_back({{".msh", bytes_of(kMsh22)}});
  exports.push_back({{".msh", bytes_of(kMsh41)}});
  exports.push_back({{".vtu", bytes_of(kVtu)}});
  return exports;
}

TEST(ReadTetMesh, RefusesEveryCutFile) {
  for (const std::vector<OutputFile>& whole : sample_exports()) {
    std::vector<OutputFile> cut = whole;
    const std::size_t size = whole.front().bytes.size();
    std::size_t kept = 0;
    for (std::size_t length = 0; length < size; length += 1 + size / 3000) {
      cut.front().bytes.assign(whole.front().bytes.begin(),
                               whole.front().bytes.begin() + static_cast<std::ptrdiff_t>(length));
      int read = 0;
      expect_no_harm(cut, read);
      kept += static_cast<std::size_t>(read);
      if (read > 0) {
        // Only the end of the file, which says nothing of the mesh, may be missing.
        const auto mesh = read_export(cut);
        const auto wanted = read_export(whole);
        EXPECT_TRUE(mesh->points == wanted->points && mesh->tets == wanted->tets &&
                    mesh->labels == wanted->labels)
            << whole.front().suffix << " cut to " << length << " of " << size;
      }
    }
    EXPECT_LT(kept, 100U) << whole.front().suffix;
  }
}

TEST(ReadTetMesh, SurvivesDamagedFiles) {
  std::uint64_t state = 99;
  const auto random = [&](std::size_t below) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::size_t>((state >> 33) % below);
  };
  const std::string spice = "0123456789-+.e<>/\"=$# \n\xff\x80";
  for (const std::vector<OutputFile>& whole : sample_exports()) {
    int read = 0;
    for (int round = 0; round < 3000; ++round) {
      std::vector<OutputFile> damaged = whole;
      Bytes& bytes = damaged[random(damaged.size())].bytes;
      for (std::size_t hits = 1 + random(4); hits > 0; --hits) {
        // The first bytes hold the headers: hit them as often as all the rest.
        const std::size_t at =
            random(random(2) == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 1500));
        if (random(2) == 0) {
          bytes[at] = static_cast<std::uint8_t>(random(256));
        } else if (random(3) > 0) {
          bytes[at] = static_cast<std::uint8_t>(spice[random(spice.size())]);
        } else {
          bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                      bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), at + random(20))));
        }
        if (bytes.empty()) bytes.push_back(0);
      }
      expect_no_harm(damaged, read);
      if (HasFatalFailure()) return;
    }
    EXPECT_LT(read, 3000) << whole.front().suffix;
  }
}

}  // namespace
}  // namespace voxtet
