// Meshes written and read back are the same.
#include "io/mesh/read_mesh.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "io/bytes/files.h"
#include "io/mesh/write_mesh.h"
#include "support/check_tets.h"
#include "support/labelled_mesh.h"
#include "unit/io/mesh_texts.h"

namespace voxtet {
namespace {

using test::read_export;
using test::refusal;

void expect_same(const TetMesh& read, const TetMesh& written) {
  EXPECT_TRUE(read.points == written.points);
  EXPECT_TRUE(read.tets == written.tets);
  EXPECT_TRUE(read.labels == written.labels);
  EXPECT_TRUE(read.faces.empty());
}

TEST(KuhnCube, IsAValidLabelledMesh) {
  const TetMesh mesh = test::kuhn_cube(4);
  ASSERT_EQ(mesh.tets.size(), 384U);
  test::check_tets(mesh);
}

TEST(ReadTetMesh, GivesExactlyWhatWasWritten) {
  const TetMesh mesh = test::kuhn_cube(5);
  for (const MeshFormat format :
       {MeshFormat::kVtu, MeshFormat::kVtk, MeshFormat::kMsh, MeshFormat::kMsh22, MeshFormat::kMedit,
        MeshFormat::kFebio, MeshFormat::kXdmf, MeshFormat::kTetgen})
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

TEST(ReadTetMesh, GivesWhatWasWrittenWithinTheDigitsOfAFormat) {
  const TetMesh mesh = test::kuhn_cube(4);
  for (const MeshFormat format : {MeshFormat::kAbaqus, MeshFormat::kNastran})
    for (const PatientSpace space : {PatientSpace::kRas, PatientSpace::kLps}) {
      const auto files = write_tet_mesh(mesh, format, {space, test::cube_infos()});
      ASSERT_TRUE(files.ok());
      const auto read = read_export(*files);
      ASSERT_TRUE(read.ok()) << read.error().message;
      EXPECT_TRUE(read->tets == mesh.tets);
      EXPECT_TRUE(read->labels == mesh.labels);
      ASSERT_EQ(read->points.size(), mesh.points.size());
      // Fields of 16 characters hold twelve decimals of "-12.".
      for (std::size_t p = 0; p < mesh.points.size(); ++p)
        EXPECT_LT((read->points[p] - mesh.points[p]).cwiseAbs().maxCoeff(), 0.51e-12);
    }
}

TEST(ReadTetMesh, ReadsOpenCarpFromEitherFile) {
  const TetMesh mesh = test::kuhn_cube(3);
  auto files = write_tet_mesh(mesh, MeshFormat::kCarp, {});
  ASSERT_TRUE(files.ok());
  // With fibres of somebody else's.
  files->back() = {".lon", test::bytes_of("2\n1 0 0 0 1 0\n")};
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
  ASSERT_TRUE(write_text_file((folder / "a.lon").string(), "2\n1 0 0 0 1 0\n").ok());
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

}  // namespace
}  // namespace voxtet
