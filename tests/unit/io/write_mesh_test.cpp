#include "io/mesh/write_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#ifndef __EMSCRIPTEN__
#include <sys/resource.h>

#include <csignal>
#endif

#include "io/bytes/files.h"
#include "io/mesh/shared/mesh_groups.h"
#include "mesh_texts.h"
#include "support/labelled_mesh.h"

namespace voxtet {
namespace {

constexpr std::array<MeshFormat, 14> kFormats{
    MeshFormat::kVtu,    MeshFormat::kVtk,    MeshFormat::kMsh,      MeshFormat::kMsh22, MeshFormat::kMedit,
    MeshFormat::kCarp,   MeshFormat::kAbaqus, MeshFormat::kNastran,  MeshFormat::kFebio, MeshFormat::kXdmf,
    MeshFormat::kTetgen, MeshFormat::kStl,    MeshFormat::kLabelStl, MeshFormat::kPly};

std::size_t file_count(MeshFormat format) {
  if (format == MeshFormat::kXdmf) return 4;
  // Of the cube's labels there are three.
  const bool three =
      format == MeshFormat::kCarp || format == MeshFormat::kTetgen || format == MeshFormat::kLabelStl;
  return three ? 3 : 1;
}

template <class T>
T value_at(const Bytes& bytes, std::size_t at) {
  T value;
  EXPECT_LE(at + sizeof(T), bytes.size());
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

SurfaceMesh surface_of(const TetMesh& mesh) {
  return {mesh.points, mesh.faces, mesh.face_sides};
}

/// An empty folder of this test's own.
class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / ("voxtet_" + name)) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
      result.push_back(entry.path().filename().string());
    std::sort(result.begin(), result.end());
    return result;
  }

 private:
  std::filesystem::path path_;
};

TEST(MeshFormatOf, KnowsEveryEndingInAnyCaseAndListsThemOtherwise) {
  for (const auto& [path, format] :
       std::vector<std::pair<std::string, MeshFormat>>{{"a.vtu", MeshFormat::kVtu},
                                                       {"a.vtk", MeshFormat::kVtk},
                                                       {"a.bdf", MeshFormat::kNastran},
                                                       {"a.nas", MeshFormat::kNastran},
                                                       {"a.node", MeshFormat::kTetgen},
                                                       {"a.ele", MeshFormat::kTetgen},
                                                       {"a.face", MeshFormat::kTetgen},
                                                       {"x/b.c.MSH", MeshFormat::kMsh},
                                                       {"a.mesh", MeshFormat::kMedit},
                                                       {"a.pts", MeshFormat::kCarp},
                                                       {"a.elem", MeshFormat::kCarp},
                                                       {"a.lon", MeshFormat::kCarp},
                                                       {"a.carp", MeshFormat::kCarp},
                                                       {"a.inp", MeshFormat::kAbaqus},
                                                       {"a.feb", MeshFormat::kFebio},
                                                       {"a.Xdmf", MeshFormat::kXdmf},
                                                       {"a.stl", MeshFormat::kStl},
                                                       {"a.ply", MeshFormat::kPly}}) {
    const auto found = mesh_format_of(path);
    ASSERT_TRUE(found.ok()) << path;
    EXPECT_EQ(*found, format) << path;
  }
  for (const char* path : {"a.obj", "a", "folder.vtu/a", ""}) {
    const auto found = mesh_format_of(path);
    ASSERT_FALSE(found.ok()) << path;
    EXPECT_EQ(found.error().code, ErrorCode::kUsage);
    EXPECT_NE(found.error().message.find(
                  ".vtu .vtk .msh .mesh .pts .elem .lon .carp .inp .bdf .nas .feb .xdmf .node .ele "
                  ".face .stl .ply"),
              std::string::npos);
  }
}

TEST(WriteTetMesh, GivesTheSameBytesEachTime) {
  const TetMesh mesh = test::kuhn_cube(3);
  for (const MeshFormat format : kFormats) {
    const auto first = write_tet_mesh(mesh, format, {PatientSpace::kRas, test::cube_infos()});
    const auto second = write_tet_mesh(test::kuhn_cube(3), format, {PatientSpace::kRas, test::cube_infos()});
    ASSERT_TRUE(first.ok() && second.ok());
    ASSERT_EQ(first->size(), file_count(format));
    for (std::size_t i = 0; i < first->size(); ++i) {
      EXPECT_FALSE((*first)[i].bytes.empty());
      EXPECT_EQ((*first)[i].suffix, (*second)[i].suffix);
      EXPECT_TRUE((*first)[i].bytes == (*second)[i].bytes) << (*first)[i].suffix;
    }
  }
}

TEST(WriteTetMesh, RefusesMeshesThatBreakTheirInvariants) {
  const auto code_of = [](const TetMesh& mesh, MeshFormat format) {
    const auto written = write_tet_mesh(mesh, format, {});
    EXPECT_FALSE(written.ok());
    return written.ok() ? ErrorCode::kCancelled : written.error().code;
  };
  for (const MeshFormat format : kFormats) {
    TetMesh mesh = test::kuhn_cube(2);
    mesh.tets[5][2] = static_cast<std::uint32_t>(mesh.points.size());
    EXPECT_EQ(code_of(mesh, format), ErrorCode::kInternal);
    mesh = test::kuhn_cube(2);
    mesh.labels.pop_back();
    EXPECT_EQ(code_of(mesh, format), ErrorCode::kInternal);
    mesh = test::kuhn_cube(2);
    mesh.face_sides.push_back({1, 0});
    EXPECT_EQ(code_of(mesh, format), ErrorCode::kInternal);
    mesh = test::kuhn_cube(2);
    mesh.points[4].y() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(code_of(mesh, format), ErrorCode::kInternal);
    EXPECT_EQ(code_of({}, format), ErrorCode::kUsage);
  }
  TetMesh mesh = test::kuhn_cube(2);
  mesh.faces.clear();
  mesh.face_sides.clear();
  EXPECT_EQ(code_of(mesh, MeshFormat::kStl), ErrorCode::kUsage);
  EXPECT_EQ(code_of(mesh, MeshFormat::kPly), ErrorCode::kUsage);
}

TEST(WriteTetMesh, NamesThePhysicalGroupsOfMsh) {
  const auto files =
      write_tet_mesh(test::kuhn_cube(2), MeshFormat::kMsh, {PatientSpace::kRas, test::cube_infos()});
  ASSERT_TRUE(files.ok());
  const std::string text = test::text_of(files->front().bytes);
  for (const char* line :
       {"$PhysicalNames\n9\n", "3 1 \"LV myocardium\"\n", "3 7 \"label 7\"\n",
        "3 300 \"veine 'cave' / sup\xc3\xa9rieure\"\n", "2 1 \"LV myocardium|background\"\n",
        "2 2 \"label 7|background\"\n", "2 3 \"label 7|LV myocardium\"\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line;
}

TEST(GroupNames, AreDistinctAndShort) {
  std::string long_name = "a";
  for (int i = 0; i < 50; ++i) long_name += "\xc3\xa9";
  const auto names =
      group_names({1, 2, 3, 4}, {{1, "wall", {}}, {2, "wall", {}}, {3, long_name, {}}, {4, " \n ", {}}});
  EXPECT_EQ(names[0], "wall (1)");
  EXPECT_EQ(names[1], "wall (2)");
  EXPECT_EQ(names[2], long_name.substr(0, 59));
  EXPECT_EQ(names[3], "label 4");
  // A segment that is called as the sides without a label are.
  EXPECT_EQ(group_names({1, 2}, {{1, "background", {}}, {2, "wall", {}}})[0], "background (1)");
}

TEST(WriteTetMesh, WritesOpenCarpInMicrometres) {
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 0.25, 0}, {0, 0, -3.5}};
  mesh.tets = {{0, 2, 1, 3}};
  mesh.labels = {12};
  const auto files = write_tet_mesh(mesh, MeshFormat::kCarp, {PatientSpace::kLps, {}});
  ASSERT_TRUE(files.ok());
  EXPECT_EQ(test::text_of((*files)[0].bytes), "4\n0 0 0\n-1000 0 0\n0 -250 0\n0 0 -3500\n");
  EXPECT_EQ(test::text_of((*files)[1].bytes), "1\nTt 0 2 1 3 12\n");
}

TEST(WriteTetMesh, WritesNoFibresForOpenCarpAndSaysSo) {
  const auto files = write_tet_mesh(test::kuhn_cube(2), MeshFormat::kCarp, {});
  ASSERT_TRUE(files.ok());
  std::vector<std::string> suffixes;
  for (const OutputFile& file : *files) suffixes.push_back(file.suffix);
  EXPECT_EQ(suffixes, (std::vector<std::string>{".pts", ".elem", ".lon.txt"}));
  EXPECT_EQ(test::text_of(files->back().bytes), std::string(kNoFibres) + "\n");
  EXPECT_EQ(files_of_mesh("a.carp"), (std::vector<std::string>{"a.pts", "a.elem", "a.lon", "a.lon.txt"}));
}

TEST(WriteTetMesh, WritesStlFacetsWithTheirNormals) {
  const TetMesh mesh = test::kuhn_cube(2);
  for (const PatientSpace space : {PatientSpace::kRas, PatientSpace::kLps}) {
    const auto files = write_tet_mesh(mesh, MeshFormat::kStl, {space, {}});
    ASSERT_TRUE(files.ok());
    const Bytes& bytes = files->front().bytes;
    ASSERT_EQ(bytes.size(), 84 + 50 * mesh.faces.size());
    EXPECT_NE(test::text_of(bytes).find(to_string(space)), std::string::npos);
    EXPECT_EQ(value_at<std::uint32_t>(bytes, 80), mesh.faces.size());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      std::array<Eigen::Vector3f, 4> rows;
      for (std::size_t i = 0; i < 12; ++i)
        rows[i / 3][static_cast<int>(i % 3)] = value_at<float>(bytes, 84 + 50 * f + 4 * i);
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_EQ(rows[c + 1], in_space(mesh.points[mesh.faces[f][c]], space).cast<float>());
      const Eigen::Vector3f normal = (rows[2] - rows[1]).cross(rows[3] - rows[1]).normalized();
      EXPECT_LT((normal - rows[0]).norm(), 1e-4F);
    }
  }
}

TEST(WriteSurface, WritesPlyWithSidesAndOnlyTheFormatsOfSurfaces) {
  const SurfaceMesh surface = surface_of(test::kuhn_cube(2));
  const auto files = write_surface(surface, MeshFormat::kPly, {PatientSpace::kRas, test::cube_infos()});
  ASSERT_TRUE(files.ok());
  const Bytes& bytes = files->front().bytes;
  const std::string end = "end_header\n";
  const std::size_t begin = test::text_of(bytes).find(end) + end.size();
  ASSERT_EQ(bytes.size(), begin + 24 * surface.points.size() + 17 * surface.triangles.size());
  for (std::size_t p = 0; p < surface.points.size(); ++p)
    for (std::size_t d = 0; d < 3; ++d)
      EXPECT_EQ(value_at<double>(bytes, begin + 24 * p + 8 * d), surface.points[p][static_cast<int>(d)]);
  const std::size_t faces = begin + 24 * surface.points.size();
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    EXPECT_EQ(bytes[faces + 17 * t], 3);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(value_at<std::uint32_t>(bytes, faces + 17 * t + 1 + 4 * c), surface.triangles[t][c]);
    EXPECT_EQ(value_at<Label>(bytes, faces + 17 * t + 13), surface.sides[t][0]);
    EXPECT_EQ(value_at<Label>(bytes, faces + 17 * t + 15), surface.sides[t][1]);
  }
  EXPECT_TRUE(write_surface(surface, MeshFormat::kVtu, {}).ok());
  EXPECT_TRUE(write_surface(surface, MeshFormat::kVtk, {}).ok());
  EXPECT_TRUE(write_surface(surface, MeshFormat::kStl, {}).ok());
  EXPECT_TRUE(write_surface(surface, MeshFormat::kLabelStl, {}).ok());
  for (const MeshFormat format :
       {MeshFormat::kMsh, MeshFormat::kMsh22, MeshFormat::kMedit, MeshFormat::kCarp, MeshFormat::kAbaqus,
        MeshFormat::kNastran, MeshFormat::kFebio, MeshFormat::kXdmf, MeshFormat::kTetgen}) {
    const auto refused = write_surface(surface, format, {});
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::kUsage);
  }
}

TEST(WriteFiles, PutsASetInPlaceAndReplacesWhatWasThere) {
  const Folder folder("write_files_set");
  const std::vector<OutputFile> files{{".pts", {1}}, {".elem", {2, 2}}, {".lon", {3}}};
  ASSERT_TRUE(write_text_file(folder / "heart.v1.pts", "old").ok());
  for (const char* name : {"heart.v1.carp", "heart.v1.elem"}) {
    const Status status = write_files(folder / name, files);
    ASSERT_TRUE(status.ok()) << status.error().message;
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"heart.v1.elem", "heart.v1.lon", "heart.v1.pts"}));
  }
  const auto read = read_file(folder / "heart.v1.elem");
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(*read, (Bytes{2, 2}));
  ASSERT_TRUE(write_files(folder / "B.VTU", {{".vtu", {9}}}).ok());
  EXPECT_EQ(folder.names().front(), "B.VTU");
}

TEST(WriteFiles, LeavesNothingBehindWhenAFileCannotBePlaced) {
  const Folder folder("write_files_failure");
  const std::vector<OutputFile> files{{".pts", {1}}, {".elem", {2}}, {".lon", {3}}};
  const Status missing = write_files(folder / "no_such_folder/a.carp", files);
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().code, ErrorCode::kBadInput);
  EXPECT_NE(missing.error().message.find("no_such_folder/a.pts"), std::string::npos)
      << missing.error().message;
  std::filesystem::create_directories(folder / "a.elem/inside");
  const Status blocked = write_files(folder / "a.carp", files);
  ASSERT_FALSE(blocked.ok());
  EXPECT_NE(blocked.error().message.find("a.elem"), std::string::npos) << blocked.error().message;
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.elem"});
  const Status unknown = write_files(folder / "a.xyz", files);
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().code, ErrorCode::kUsage);
}

TEST(WriteFiles, NeverTouchesAnotherFileOfItsTemporaryName) {
  const Folder folder("write_files_temporary");
  ASSERT_TRUE(write_text_file(folder / "other", "mine").ok());
  std::filesystem::rename(folder / "other", folder / "a.vtu.part");
  ASSERT_TRUE(write_files(folder / "a.vtu", {{".vtu", {5}}}).ok());
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.vtu", "a.vtu.part"}));
  const auto kept = read_file(folder / "a.vtu.part");
  ASSERT_TRUE(kept.ok());
  EXPECT_EQ(test::text_of(*kept), "mine");
}

#ifndef __EMSCRIPTEN__
TEST(WriteFiles, KeepsTheOldFileWhenTheDiskIsFull) {
  const Folder folder("write_files_full");
  ASSERT_TRUE(write_files(folder / "a.vtu", {{".vtu", {5}}}).ok());
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit small = before;
  small.rlim_cur = 1000;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const Status status = write_files(folder / "a.vtu", {{".vtu", Bytes(100000, 7)}});
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("a.vtu"), std::string::npos);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.vtu"});
  const auto kept = read_file(folder / "a.vtu");
  ASSERT_TRUE(kept.ok());
  EXPECT_EQ(*kept, Bytes{5});
}
#endif

}  // namespace
}  // namespace voxtet
