// What the commands refuse, by which exit code, and what they leave as it was.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/cli.h"
#include "io/bytes/files.h"
#include "unit/cli/cli_fixture.h"

namespace voxtet {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

TEST_F(CliTest, AnswersBadUsageWith2AndWritesNothing) {
  write("case.json", kSphere);
  EXPECT_EQ(run({"mesh"}), kExitUsage);
  EXPECT_EQ(run({"nothing"}), kExitUsage);
  EXPECT_EQ(run({"mesh", at("case.json"), "-o", at("a.xyz")}), kExitUsage);
  EXPECT_EQ(run({"mesh", at("case.json"), "--labels", "9", "-o", at("a.vtu")}), kExitUsage);
  EXPECT_EQ(run({"mesh", at("case.json"), "--set", "sizing.edge_mm", "-o", at("a.vtu")}), kExitUsage);
  EXPECT_EQ(run({"mesh", at("case.json"), "--set", "sizing.edge=2", "-o", at("a.vtu")}), kExitUsage);
  EXPECT_EQ(run({"mesh", at("case.json"), "--edge-label", "1=x", "-o", at("a.vtu")}), kExitUsage);
  EXPECT_EQ(run({"mesh", at("case.json"), "--edge-mm", "0", "-o", at("a.vtu")}), kExitUsage);
  EXPECT_EQ(run({"phantom", "cow", "-o", at("cow.nii")}), kExitUsage);
  EXPECT_EQ(files(), 1U);
}

TEST_F(CliTest, AnswersBadInputWith3AndWritesNothing) {
  write("heart.nii", "this is no heart");
  EXPECT_EQ(run({"mesh", at("heart.nii"), "-o", at("a.vtu")}), kExitBadInput);
  EXPECT_EQ(run({"mesh", at("absent.nii"), "-o", at("a.vtu")}), kExitBadInput);
  EXPECT_EQ(run({"check", at("heart.nii")}), kExitBadInput);
  EXPECT_EQ(files(), 1U);
}

TEST_F(CliTest, StopsAtTheTimeLimitWith6) {
  write("case.json", kSphere);
  EXPECT_EQ(run({"mesh", at("case.json"), "--time-limit", "1e-9", "-o", at("a.vtu")}), kExitLimits);
  EXPECT_EQ(files(), 1U);
}

TEST_F(CliTest, RefusesFieldsAndSideFilesThatAreNotThere) {
  write("case.json", kSphere);
  EXPECT_EQ(run({"field", at("case.json"), "--what", "thickness", "-o", at("a.nii")}), kExitUsage);
  EXPECT_EQ(run({"field", at("case.json"), "-o", at("a.vtk")}), kExitUsage);
  EXPECT_EQ(run({"mesh", at("case.json"), "--mask", at("none.nii")}), kExitBadInput);
  EXPECT_EQ(run({"mesh", at("case.json"), "--mask-edge", "1=2"}), kExitUsage);
  EXPECT_EQ(run({"mesh", at("case.json"), "--size-image", at("case.json")}), kExitBadInput);
  EXPECT_EQ(files(), 1U);
}

#ifndef __EMSCRIPTEN__  // there are no pipes, and what is printed cannot be caught
TEST_F(CliTest, RefusesBeforeMeshingWhatCannotBeWritten) {
  write("case.json", kSphere);
  for (const char* option : {"-o", "--report"}) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(run({"mesh", at("case.json"), option, at("none/mesh.vtu")}), kExitBadInput);
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_NE(said.find("none/mesh.vtu: cannot be created"), std::string::npos) << said;
    EXPECT_EQ(said.find("remesh"), std::string::npos) << said;
  }
  EXPECT_EQ(files(), 1U);
}
#endif

#ifndef __EMSCRIPTEN__  // there are no pipes, and what is printed cannot be caught
TEST_F(CliTest, SaysWhichTimeLimitIsOver) {
  write("case.json", kSphere);
  testing::internal::CaptureStderr();
  EXPECT_EQ(run({"mesh", at("case.json"), "--time-limit", "1e-6"}), kExitLimits);
  EXPECT_NE(testing::internal::GetCapturedStderr().find("given up after the 1e-06 s of --time-limit"),
            std::string::npos);
  EXPECT_EQ(run({"mesh", at("case.json"), "--time-limit", "-1"}), kExitUsage);
  EXPECT_EQ(run({"mesh", at("case.json"), "--threads", "-1"}), kExitUsage);
}
#endif

TEST_F(CliTest, RefusesWhatNoMachineCanMesh) {
  write(
      "case.json",
      R"({"source":{"phantom":{"kind":"sphere","radius_mm":200,"spacing_mm":[10,10,10]}},"sizing":{"edge_mm":0.01}})");
  EXPECT_EQ(run({"mesh", at("case.json")}), kExitLimits);
}

TEST_F(CliTest, RefusesMarchingCubesForSeveralLabels) {
  ASSERT_EQ(run({"phantom", "nested_boxes", "--set", "radius_mm=8", "--set", "spacing_mm=[1,1,1]", "-o",
                 at("boxes.nii.gz")}),
            kExitOk);
  const std::vector<std::string> command{
      "mesh", at("boxes.nii.gz"), "--edge-mm", "3", "--set", "surface.method=marching_cubes"};
  EXPECT_EQ(run(command), kExitUsage);
  std::vector<std::string> merged = command;
  merged.push_back("--merge");
  EXPECT_EQ(run(merged), kExitOk);
}

TEST_F(CliTest, ForecastsAndRefusesBeyondALimit) {
  write("case.json", kSphere);
  EXPECT_EQ(run({"forecast", at("case.json"), "--elements", "2000", "--json"}), kExitOk);
  EXPECT_EQ(run({"forecast", at("case.json"), "--elements", "-5"}), kExitUsage);
  EXPECT_EQ(run({"mesh", at("case.json"), "--set", "limits.tets=200"}), kExitLimits);
  EXPECT_EQ(run({"mesh", at("case.json"), "--set", "limits.tets=2000"}), kExitOk);
}

TEST_F(CliTest, WritesOverNothingThatItReads) {
  write("case.json", kSphere);
  ASSERT_EQ(run({"phantom", "sphere", "--set", "radius_mm=6", "-o", at("ball.nii")}), kExitOk);
  write("of_file.json", R"({"source":{"file":{"name":"ball.nii","sha256":""}}})");
  const Bytes before = *read_file(at("ball.nii"));
  const std::size_t count = files();
  const auto refused = [&](const std::vector<std::string>& words) {
    EXPECT_EQ(run(words), kExitUsage) << words.back();
    EXPECT_EQ(*read_file(at("ball.nii")), before);
    EXPECT_EQ(files(), count);
  };
  refused({"mesh", at("ball.nii"), "--report", at("ball.nii")});
  refused({"mesh", at("ball.nii"), "--report", (folder_ / "." / "ball.nii").string()});
  refused({"mesh", at("of_file.json"), "--report", at("ball.nii")});
  refused({"mesh", at("case.json"), "--report", at("case.json")});
  refused({"field", at("ball.nii"), "-o", at("ball.nii")});
  refused({"field", at("case.json"), "--size-image", at("ball.nii"), "-o", at("ball.nii")});
  refused({"field", at("case.json"), "--mask", at("ball.nii"), "-o", at("ball.nii")});
  refused({"convert", at("ball.nii"), at("ball.nii")});
  refused({"mesh", at("case.json"), "-o", at("a.vtu"), "--report", at("a.vtu")});
  refused({"mesh", at("case.json"), "-o", at("a.carp"), "--report", at("a.elem")});
  EXPECT_EQ(run({"mesh", at("case.json"), "-o", at("a.vtu"), "--report", at("a.json")}), kExitOk);
  EXPECT_EQ(run({"mesh", at("case.json"), "-o", at("a.vtu"), "--report", at("a.json")}), kExitOk) << "again";
}

TEST_F(CliTest, RefusesWhatIsMissingDoubledOrTooLarge) {
  write("case.json", kSphere);
  EXPECT_EQ(run({"mesh", at("case.json"), "-o", ""}), kExitUsage);
  EXPECT_EQ(run({"mesh", at("case.json"), "--report", ""}), kExitUsage);
  EXPECT_EQ(run({"mesh", at("case.json"), "--edge-mm", ""}), kExitUsage);
  EXPECT_EQ(run({"mesh", at("case.json"), "--edge-label", "1=1", "--edge-label", "1=2"}), kExitUsage);
  write("large.json", R"({"sizing":{"edge_mm":1e999}})");
  EXPECT_EQ(run({"mesh", at("large.json")}), kExitUsage);
  EXPECT_EQ(run({"url", at("case.nii")}), kExitUsage);
  EXPECT_EQ(run({"url", at("case.json")}), kExitOk);
}

TEST_F(CliTest, DumpsWhatStandsBeforeTheStageThatFails) {
  write("case.json", kSphere);
  EXPECT_EQ(run({"mesh", at("case.json"), "--set", "limits.tets=200", "--dump", at("a")}), kExitLimits);
  EXPECT_TRUE(fs::exists(at("a/sizing.nii.gz")));
  EXPECT_FALSE(fs::exists(at("a/remesh.ply")));
  EXPECT_EQ(read_json("a/report.json")["stages"].size(), 6U);
}

TEST_F(CliTest, RefusesStagesAndFoldersThatCannotBe) {
  write("case.json", kSphere);
  EXPECT_EQ(run({"mesh", at("case.json"), "--until", "paint"}), kExitUsage);
  EXPECT_EQ(run({"mesh", at("case.json"), "--until", "optimise", "-o", at("a.vtu")}), kExitUsage);
  EXPECT_EQ(run({"mesh", at("case.json"), "--until", "volume", "--dump", at("case.json")}), kExitBadInput);
  ASSERT_EQ(run({"phantom", "sphere", "--set", "radius_mm=6", "-o", at("volume.nii.gz")}), kExitOk);
  EXPECT_EQ(run({"mesh", at("volume.nii.gz"), "--until", "volume", "--dump", folder_.string()}), kExitUsage);
  EXPECT_EQ(files(), 2U);
}

}  // namespace
}  // namespace voxtet
