// `convert` with fibres and values of openCARP.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cli/cli.h"
#include "io/bytes/files.h"
#include "io/mesh/read_mesh.h"
#include "io/mesh/write_igb.h"
#include "io/volume/read_volume.h"
#include "support/printed.h"
#include "unit/cli/cli_fixture.h"

namespace voxtet {
namespace {

/// Two tetrahedra with fibres, an activation of their points, and two frames of a voltage.
class ConvertTest : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    write("a.pts", "5\n0 0 0\n1000 0 0\n0 1000 0\n0 0 1000\n0 0 -1000\n");
    write("a.elem", "2\nTt 0 1 2 3 1\nTt 0 2 1 4 2\n");
    write("a.lon", "2\n1 0 0 0 1 0\n0 0.6 0.8 1 0 0\n");
    write("lat.dat", "1\n2\n3.5\n-1\n5\n");
    IgbWriter frames(5, "mV", 0, 10, -80);
    frames.add({-80, -79, -78, -77, -76});
    frames.add({20, 19, 18, 17, 16});
    ASSERT_TRUE(place_files({{at("vm.igb"), frames.take()}}).ok());
  }
  std::string text(const std::string& name) const {
    const Result<Bytes> bytes = read_file(at(name));
    return bytes.ok() ? std::string(bytes->begin(), bytes->end()) : "";
  }
};

TEST_F(ConvertTest, TakesFibresAndValuesAlong) {
  ASSERT_EQ(run({"convert", at("a.elem"), at("b.vtu"), "--values", at("lat.dat"), "--values", at("vm.igb")}),
            kExitOk);
  for (const char* part : {"Name=\"fibre\" NumberOfComponents=\"3\"",
                           "Name=\"sheet\" NumberOfComponents=\"3\"", "Name=\"lat\"", "Name=\"vm\""})
    EXPECT_NE(text("b.vtu").find(part), std::string::npos) << part;
  // As text they can be compared.
  ASSERT_EQ(run({"convert", at("a.carp"), at("c.carp"), "--values", at("lat.dat"), "--values", at("vm.igb")}),
            kExitOk);
  EXPECT_EQ(text("c.lat.dat"), "1\n2\n3.5\n-1\n5\n");
  EXPECT_EQ(text("c.vm.dat"), "20\n19\n18\n17\n16\n");
  EXPECT_EQ(text("c.elem"), text("a.elem"));
  EXPECT_EQ(text("c.pts"), text("a.pts"));
  MeshArrays before, after;
  ASSERT_TRUE(read_tet_mesh_file(at("a.elem"), &before).ok());
  ASSERT_TRUE(read_tet_mesh_file(at("c.elem"), &after).ok());
  ASSERT_EQ(after.cell_data.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(after.cell_data[i].values, before.cell_data[i].values);
  ASSERT_EQ(run({"convert", at("a.carp"), at("c.carp"), "--values", at("vm.igb"), "--time", "4"}), kExitOk);
  EXPECT_EQ(text("c.vm.dat"), "-80\n-79\n-78\n-77\n-76\n");
}

TEST_F(ConvertTest, LeavesOutWhatAFormatHasNoPlaceFor) {
  test::CaughtErrors errors;
  ASSERT_EQ(run({"convert", at("a.elem"), at("b.mesh")}), kExitOk);
  EXPECT_TRUE(errors.say("b.mesh: left out fibre, for which this format has no place"));
}

TEST_F(ConvertTest, RefusesValuesOfAnotherMesh) {
  write("short.dat", "1\n2\n");
  for (const auto& [words, code, said] : std::vector<std::tuple<std::vector<std::string>, int, std::string>>{
           {{"convert", at("a.elem"), at("b.vtu"), "--values", at("short.dat")},
            kExitBadInput,
            "short.dat: found 2 values, expected 5, one for each point of the mesh"},
           {{"convert", at("a.elem"), at("b.vtu"), "--values", at("a.pts")},
            kExitBadInput,
            "a.pts: ending \".pts\", expected .dat or .igb"},
           {{"convert", at("a.elem"), at("b.inp"), "--values", at("lat.dat")},
            kExitUsage,
            "values at points (lat): this format has no place for them"}}) {
    test::CaughtErrors errors;
    EXPECT_EQ(run(words), code) << said;
    EXPECT_TRUE(errors.say(said)) << said;
  }
}

/// 2 x 2 x 2 voxels of bytes with what a header says besides.
std::string nrrd_text(const std::string& fields, const std::string& data) {
  return "NRRD0004\ntype: uchar\nencoding: raw\n" + fields + "\n" + data;
}

class ReadOptionsTest : public CliTest {
 protected:
  /// The labels of a volume file, and its spacing.
  std::vector<Label> labels(const std::string& name) const {
    const Result<LabelVolume> volume = read_volume_file(at(name));
    EXPECT_TRUE(volume.ok()) << volume.error().message;
    return volume ? volume->labels : std::vector<Label>{};
  }
};

TEST_F(ReadOptionsTest, SayHowAVolumeIsConvertedAndMeshed) {
  write("a.nrrd", nrrd_text("dimension: 3\nsizes: 2 2 2\nspacings: 5 5 5\n", "\1\1\1\1\1\1\1\2"));
  ASSERT_EQ(run({"convert", at("a.nrrd"), at("b.nii"), "--unit", "cm", "--background", "1"}), kExitOk);
  EXPECT_EQ(labels("b.nii"), (std::vector<Label>{0, 0, 0, 0, 0, 0, 0, 2}));
  EXPECT_DOUBLE_EQ(read_volume_file(at("b.nii"))->spacing_mm()[0], 50);
  write("f.nrrd", nrrd_text("dimension: 4\nsizes: 2 2 2 2\nkinds: domain domain domain list\n",
                            "\1\1\1\1\1\1\1\1\2\2\2\2\2\2\2\3"));
  EXPECT_EQ(run({"convert", at("f.nrrd"), at("c.nii")}), kExitBadInput);
  ASSERT_EQ(run({"convert", at("f.nrrd"), at("c.nii"), "--frame", "1"}), kExitOk);
  EXPECT_EQ(labels("c.nii"), (std::vector<Label>{2, 2, 2, 2, 2, 2, 2, 3}));
  EXPECT_EQ(run({"convert", at("a.nrrd"), at("d.nii"), "--unit", "ly"}), kExitUsage);

  ASSERT_EQ(run({"mesh", at("a.nrrd"), "--until", "volume", "--unit", "cm", "--background", "2", "--report",
                 at("report.json")}),
            kExitOk);
  const nlohmann::json source = read_json("report.json")["recipe"]["source"];
  EXPECT_EQ(source["unit"], "cm");
  EXPECT_EQ(source["background"], 2);
  // The case of the report reads it in the same way.
  write("case.json", nlohmann::json{{"source", source}}.dump());
  EXPECT_EQ(run({"mesh", at("case.json"), "--until", "volume"}), kExitOk);
  EXPECT_EQ(run({"mesh", at("case.json"), "--until", "volume", "--unit", "mm"}), kExitBadInput);
}

TEST_F(ReadOptionsTest, SayWhichSegmentWins) {
  write("a.seg.nrrd",
        nrrd_text("dimension: 4\nsizes: 2 2 2 2\nkinds: list domain domain domain\nSegment0_Name:=in, side\n"
                  "Segment0_Layer:=0\nSegment1_Name:=out\nSegment1_Layer:=1\n",
                  "\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1\1"));
  ASSERT_EQ(run({"convert", at("a.seg.nrrd"), at("b.nii")}), kExitOk);
  EXPECT_EQ(labels("b.nii"), std::vector<Label>(8, 2));
  ASSERT_EQ(run({"convert", at("a.seg.nrrd"), at("b.nii"), "--precedence", "1,out"}), kExitOk);
  EXPECT_EQ(labels("b.nii"), std::vector<Label>(8, 1));
  EXPECT_EQ(run({"convert", at("a.seg.nrrd"), at("b.nii"), "--precedence", "inside"}), kExitUsage);
  EXPECT_EQ(
      run({"mesh", at("a.seg.nrrd"), "--until", "volume", "--set", R"(source.precedence=["in, side"])"}),
      kExitOk);
}

}  // namespace
}  // namespace voxtet
