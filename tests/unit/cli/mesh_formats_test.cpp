// Formats of meshes on the command line: written, read back, measured.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cli/cli.h"
#include "io/mesh/read_mesh.h"
#include "support/printed.h"
#include "unit/cli/cli_fixture.h"

namespace voxtet {
namespace {

/// Two tetrahedra of labels 1 and 2, as .elem, and one without a label that Gmsh would give it.
class MeshFormatsTest : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    write("a.pts", "5\n0 0 0\n1000 0 0\n0 1000 0\n0 0 1000\n0 0 -1000\n");
    write("a.elem", "2\nTt 0 1 2 3 1\nTt 0 2 1 4 2\n");
    write("bare.msh",
          "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
          "$Elements\n1\n1 4 2 0 6 1 2 3 4\n$EndElements\n");
    write("tags.vtk",
          "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0 0 1 "
          "0 0 0 "
          "1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\nCELL_DATA 1\nSCALARS part int\nLOOKUP_TABLE "
          "default\n7\n");
  }
  std::vector<Label> labels_of(const std::string& name) const {
    const Result<TetMesh> mesh = read_tet_mesh_file(at(name));
    EXPECT_TRUE(mesh) << mesh.error().message;
    return mesh ? mesh->labels : std::vector<Label>{};
  }
  std::string first_line_of(const std::string& name) const {
    const Result<Bytes> bytes = read_file(at(name));
    if (!bytes) return "";
    const std::string text(bytes->begin(), bytes->end());
    return text.substr(0, text.find('\n', text.find('\n') + 1));
  }
};

TEST_F(MeshFormatsTest, AllThatIsWrittenWithTetrahedraIsReadBack) {
  for (const char* name : {"b.vtu", "b.vtk", "b.msh", "b.mesh", "b.carp", "b.inp", "b.bdf", "b.nas", "b.feb",
                           "b.xdmf", "b.ele", "b.node"}) {
    ASSERT_EQ(run({"convert", at("a.elem"), at(name)}), kExitOk) << name;
    EXPECT_EQ(labels_of(name), (std::vector<Label>{1, 2})) << name;
    ASSERT_EQ(run({"convert", at(name), at("c.vtu")}), kExitOk) << name;
    EXPECT_EQ(labels_of("c.vtu"), (std::vector<Label>{1, 2})) << name;
  }
}

TEST_F(MeshFormatsTest, AnOptionSaysWhichMsh) {
  ASSERT_EQ(run({"convert", at("a.elem"), at("b.msh"), "--msh", "2.2"}), kExitOk);
  EXPECT_EQ(first_line_of("b.msh"), "$MeshFormat\n2.2 0 8");
  EXPECT_EQ(labels_of("b.msh"), (std::vector<Label>{1, 2}));
  ASSERT_EQ(run({"convert", at("a.elem"), at("b.msh"), "--msh", "4.1"}), kExitOk);
  EXPECT_EQ(first_line_of("b.msh"), "$MeshFormat\n4.1 1 8");
  test::CaughtErrors errors;
  EXPECT_EQ(run({"convert", at("a.elem"), at("b.vtu"), "--msh", "2.2"}), kExitUsage);
  EXPECT_TRUE(errors.say("--msh 2.2: found " + at("b.vtu") + ", expected a name.msh"));
}

TEST_F(MeshFormatsTest, AnOptionMakesAnStlForEachLabel) {
  const std::size_t before = files();
  ASSERT_EQ(run({"convert", at("a.elem"), at("b.stl"), "--stl-per-label"}), kExitOk);
  EXPECT_EQ(files(), before + 2);
  for (const char* name : {"b.label_1.stl", "b.label_2.stl"}) {
    const Result<Bytes> bytes = read_file(at(name));
    ASSERT_TRUE(bytes) << bytes.error().message;
    EXPECT_EQ(bytes->size(), 84U + 4 * 50) << name;  // all sides of a tetrahedron
  }
  test::CaughtErrors errors;
  EXPECT_EQ(run({"convert", at("a.elem"), at("b.ply"), "--stl-per-label"}), kExitUsage);
  EXPECT_TRUE(errors.say("--stl-per-label: found " + at("b.ply") + ", expected a name.stl"));
}

TEST_F(MeshFormatsTest, AnOptionMakesTetrahedraOfTenNodes) {
  for (const char* name : {"b.vtu", "b.msh", "b.inp", "b.feb", "b.xdmf"}) {
    ASSERT_EQ(run({"convert", at("a.elem"), at(name), "--order", "2"}), kExitOk) << name;
    test::CaughtErrors notes;
    EXPECT_EQ(run({"check", at(name)}), kExitOk) << name;
    EXPECT_TRUE(notes.say("2 of 2 tetrahedra have points on their edges: their corners are read, 9 other"))
        << name;
  }
  ASSERT_EQ(run({"convert", at("b.vtu"), at("c.vtu"), "--order", "1"}), kExitOk);
  EXPECT_EQ(labels_of("c.vtu"), (std::vector<Label>{1, 2}));
  test::CaughtErrors errors;
  EXPECT_EQ(run({"convert", at("a.elem"), at("b.mesh"), "--order", "2"}), kExitUsage);
  EXPECT_TRUE(errors.say("--order 2: found " + at("b.mesh") +
                         ", expected a name that ends with .vtu, .msh, .inp, .feb or .xdmf"));
  EXPECT_EQ(run({"convert", at("a.elem"), at("b.vtu"), "--order", "3"}), kExitUsage);
}

TEST_F(MeshFormatsTest, AMeshWithoutLabelsIsMeasuredAndThatIsSaid) {
  {
    test::CaughtErrors notes;
    EXPECT_EQ(run({"check", at("bare.msh")}), kExitOk);
    EXPECT_TRUE(notes.say("no physical groups of volumes: the labels are the tags of geometric entities"));
  }
  test::CaughtErrors notes;
  EXPECT_EQ(run({"check", at("tags.vtk")}), kExitOk);
  EXPECT_TRUE(notes.say("no cell array \"label\", found \"part\" (--label-array NAME takes one)"));
}

TEST_F(MeshFormatsTest, TheArrayOfLabelsMayHaveAnotherName) {
  ASSERT_EQ(run({"convert", at("tags.vtk"), at("b.vtu"), "--label-array", "part"}), kExitOk);
  EXPECT_EQ(labels_of("b.vtu"), std::vector<Label>{7});
  EXPECT_EQ(run({"check", at("tags.vtk"), "--label-array", "part"}), kExitOk);
  EXPECT_EQ(run({"check", at("a.elem"), "--label-array", "part"}), kExitUsage);
  test::CaughtErrors errors;
  EXPECT_EQ(run({"check", at("tags.vtk"), "--label-array", "none"}), kExitBadInput);
  EXPECT_TRUE(errors.say("no cell array \"none\" of one number for each cell, found \"part\""));
}

}  // namespace
}  // namespace voxtet
