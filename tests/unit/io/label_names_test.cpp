// Names of labels travel from format to format.
#include <gtest/gtest.h>

#include <string>

#include "io/mesh/read_mesh.h"
#include "io/mesh/write_mesh.h"

namespace voxtet::test {
namespace {

/// Two tetrahedra of the labels 1 and 7.
TetMesh two_tets() {
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  mesh.tets = {{0, 1, 2, 3}, {1, 4, 2, 3}};
  mesh.labels = {1, 7};
  return mesh;
}

const std::vector<LabelInfo> kInfos{{1, "Herz \"wand\", links/", {1, 0, 0}},
                                    {2, "of no tetrahedron", {0, 1, 0}},
                                    {7, "*END, a=b <x>& --\xc3\xa4", {0, 0, 1}}};

Bytes file_with_names(MeshFormat format, const std::vector<LabelInfo>& infos) {
  WriteMeshOptions options;
  options.infos = infos;
  const Result<std::vector<OutputFile>> files = write_tet_mesh(two_tets(), format, options);
  EXPECT_TRUE(files) << files.error().message;
  return files->front().bytes;
}

std::vector<LabelInfo> names_back(MeshFormat format, const std::vector<LabelInfo>& infos) {
  const Bytes bytes = file_with_names(format, infos);
  MeshArrays arrays;
  const Result<TetMesh> mesh = read_tet_mesh({"a", bytes, {}}, &arrays);
  EXPECT_TRUE(mesh) << mesh.error().message;
  return arrays.infos;
}

TEST(LabelNames, ComeBackFromFilesThatHoldThem) {
  for (const MeshFormat format :
       {MeshFormat::kVtu, MeshFormat::kVtk, MeshFormat::kMsh, MeshFormat::kMsh22, MeshFormat::kMedit}) {
    const std::vector<LabelInfo> back = names_back(format, kInfos);
    ASSERT_EQ(back.size(), 2U);
    EXPECT_EQ(back[0].label, 1);
    EXPECT_EQ(back[1].label, 7);
    // In quotes there are none.
    EXPECT_EQ(back[0].name, format == MeshFormat::kVtu || format == MeshFormat::kVtk ? kInfos[0].name
                                                                                     : "Herz 'wand', links/");
    EXPECT_EQ(back[1].name, kInfos[2].name);
    // From there to the others, as if they came from the volume.
    for (const MeshFormat other : {MeshFormat::kAbaqus, MeshFormat::kFebio, MeshFormat::kXdmf})
      EXPECT_EQ(file_with_names(other, back), file_with_names(other, {kInfos[0], kInfos[2]}));
  }
  const Bytes abaqus = file_with_names(MeshFormat::kAbaqus, names_back(MeshFormat::kMsh, kInfos));
  const std::string text(abaqus.begin(), abaqus.end());
  EXPECT_NE(text.find("ELSET=Herz_wand_links_1\n"), std::string::npos);
  EXPECT_NE(text.find("ELSET=END_a_b_x_7\n"), std::string::npos);
}

TEST(LabelNames, AreWordsInFormatsOfWords) {
  for (const MeshFormat format : {MeshFormat::kAbaqus, MeshFormat::kFebio}) {
    const std::vector<LabelInfo> back = names_back(format, kInfos);
    ASSERT_EQ(back.size(), 2U);
    EXPECT_EQ(back[0].label, 1);
    EXPECT_EQ(back[0].name, "Herz_wand_links");
    EXPECT_EQ(back[1].label, 7);
    EXPECT_EQ(back[1].name, "END_a_b_x");
    // A second time they are the same.
    EXPECT_EQ(file_with_names(format, back), file_with_names(format, kInfos));
  }
}

TEST(LabelNames, AreAsciiInNastran) {
  const std::vector<LabelInfo> back = names_back(MeshFormat::kNastran, kInfos);
  ASSERT_EQ(back.size(), 2U);
  EXPECT_EQ(back[0].name, "Herz 'wand', links/");
  EXPECT_EQ(back[1].name, "*END, a=b <x>& --_");
}

TEST(LabelNames, ThoseThatAFileMakesUpAreNone) {
  for (const MeshFormat format :
       {MeshFormat::kVtu, MeshFormat::kVtk, MeshFormat::kMsh, MeshFormat::kMsh22, MeshFormat::kMedit,
        MeshFormat::kAbaqus, MeshFormat::kNastran, MeshFormat::kFebio})
    EXPECT_TRUE(names_back(format, {}).empty());
}

TEST(LabelNames, OfOtherPeopleAreRead) {
  const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n";
  const std::string rest =
      "$EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n$Elements\n1\n1 4 2 3 1 "
      "1 2 3 "
      "4\n$EndElements\n";
  const auto names = [&](const std::string& lines) {
    const std::string text = head + lines + rest;
    MeshArrays arrays;
    const Result<TetMesh> mesh = read_tet_mesh({"a.msh", Bytes(text.begin(), text.end()), {}}, &arrays);
    EXPECT_TRUE(mesh) << mesh.error().message;
    return arrays.infos;
  };
  const std::vector<LabelInfo> found = names("3\n2 3 \"a face\"\n3 3 \"wall of the LV\"\n3 70000 \"far\"\n");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].label, 3);
  EXPECT_EQ(found[0].name, "wall of the LV");
  EXPECT_TRUE(names("1\n3 3 unquoted\n").empty());
  EXPECT_TRUE(names("").empty());
}

TEST(LabelNames, DoNotChangeFilesThatHaveNone) {
  for (const MeshFormat format : {MeshFormat::kVtu, MeshFormat::kXdmf})
    EXPECT_EQ(file_with_names(format, {}), file_with_names(format, {{3, "of no tetrahedron", {0, 0, 0}}}));
}

}  // namespace
}  // namespace voxtet::test
