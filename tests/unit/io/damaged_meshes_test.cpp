// Mesh files cut short and damaged at seeded places.
#include <algorithm>

#include "support/labelled_mesh.h"
#include "unit/io/mesh_texts.h"

namespace voxtet::test {
namespace {

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
  const TetMesh mesh = kuhn_cube(2);
  std::vector<std::vector<OutputFile>> exports;
  for (const MeshFormat format :
       {MeshFormat::kVtu, MeshFormat::kVtk, MeshFormat::kMsh, MeshFormat::kMsh22, MeshFormat::kMedit,
        MeshFormat::kCarp, MeshFormat::kAbaqus, MeshFormat::kNastran, MeshFormat::kFebio, MeshFormat::kXdmf,
        MeshFormat::kTetgen}) {
    auto files = write_tet_mesh(mesh, format, {PatientSpace::kLps, cube_infos()});
    EXPECT_TRUE(files.ok());
    // The .elem first: it is the file whose cuts are read below.
    if (files->size() > 1 && format != MeshFormat::kXdmf) std::swap((*files)[0], (*files)[1]);
    exports.push_back(std::move(files).value());
  }
  // Of our own we know that labels must follow.
  exports.push_back({{".vtk", binary_vtk("voxtet mesh, space RAS")}});
  exports.push_back({{".xdmf", bytes_of(kXdmfText)}});
  exports.push_back({{".mesh", bytes_of(kMeditText)}});
  exports.push_back({{".msh", bytes_of(kMsh22Text)}});
  exports.push_back({{".msh", bytes_of(kMsh41Text)}});
  exports.push_back({{".vtu", bytes_of(kVtuText)}});
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
}  // namespace voxtet::test
