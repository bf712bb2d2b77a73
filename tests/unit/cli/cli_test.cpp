#include "cli/cli.h"

#include <gtest/gtest.h>

#ifndef __EMSCRIPTEN__
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "geometry/topology/adjacency.h"
#include "io/bytes/files.h"
#include "io/mesh/read_mesh.h"
#include "pipeline/report.h"
#include "pipeline/version/engine_version.h"
#include "recipe/link.h"
#include "support/check_tets.h"
#include "support/printed.h"

namespace voxtet {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class CliTest : public testing::Test {
 protected:
  void SetUp() override {
    const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / ("voxtet_cli_" + std::string(info->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  static int run(const std::vector<std::string>& words) {
    std::vector<const char*> argv{"voxtet"};
    for (const std::string& word : words) argv.push_back(word.c_str());
    return run_cli(static_cast<int>(argv.size()), argv.data());
  }
  json read_json(const std::string& name) const {
    const Result<Bytes> bytes = read_file(at(name));
    return bytes.ok() ? json::parse(bytes->begin(), bytes->end()) : json();
  }
  void write(const std::string& name, const std::string& text) const {
    ASSERT_TRUE(write_text_file(at(name), text).ok());
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}));
  }

  fs::path folder_;
};

constexpr const char* kSphere =
    R"({"source":{"phantom":{"kind":"sphere","radius_mm":8,"spacing_mm":[1,1,1]}},"sizing":{"edge_mm":3}})";

TEST_F(CliTest, MeshesAPhantomWrittenAsAVolume) {
  ASSERT_EQ(run({"phantom", "nested_boxes", "--set", "radius_mm=8", "--set", "spacing_mm=[1,1,1]", "-o",
                 at("boxes.nii.gz")}),
            kExitOk);
  ASSERT_EQ(run({"mesh", at("boxes.nii.gz"), "--labels", "1,2", "--edge-mm", "3", "--edge-label", "2=2", "-o",
                 at("a.vtu"), "--report", at("report.json")}),
            kExitOk);
  Result<TetMesh> mesh = read_tet_mesh_file(at("a.vtu"));
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  add_label_faces(*mesh);
  test::check_tets(*mesh);
  const json report = read_json("report.json");
  EXPECT_EQ(report["recipe"]["labels"], json({1, 2}));
  EXPECT_EQ(report["recipe"]["sizing"]["labels"][0]["edge_mm"], 2);
  for (const char* part : {"digest", "tets", "stages", "quality", "fidelity", "recipe", "engine"})
    EXPECT_TRUE(report.contains(part)) << part;
  EXPECT_EQ(run({"check", at("a.vtu")}), kExitOk);
  EXPECT_EQ(run({"convert", at("a.vtu"), at("b.msh")}), kExitOk);
  EXPECT_EQ(read_tet_mesh_file(at("b.msh"))->tets, mesh->tets);
  EXPECT_EQ(run({"convert", at("b.msh"), at("b.stl")}), kExitOk);
}

TEST_F(CliTest, LooksLabelsUpThatTheMeshDoesNotFollow) {
  ASSERT_EQ(run({"phantom", "nested_boxes", "--set", "radius_mm=8", "--set", "spacing_mm=[1,1,1]", "-o",
                 at("boxes.nii.gz")}),
            kExitOk);
  ASSERT_EQ(run({"mesh", at("boxes.nii.gz"), "--merge", "--edge-mm", "3", "--transfer", "3,2", "-o",
                 at("a.carp"), "--report", at("report.json")}),
            kExitOk);
  const json report = read_json("report.json");
  EXPECT_EQ(report["recipe"]["transfer"]["labels"], json({3, 2}));
  ASSERT_EQ(report["transfer"].size(), 2U);
  EXPECT_EQ(report["transfer"][0]["label"], 2);
  EXPECT_NEAR(report["transfer"][0]["by_fraction"]["error_percent"].get<double>(), 0, 5);
  for (const char* name : {"a.pts", "a.elem", "a.lon.txt", "a.centroid_label.dat", "a.majority_label.dat",
                           "a.fraction_2.dat", "a.fraction_3.dat"})
    EXPECT_TRUE(fs::exists(at(name))) << name;
  EXPECT_EQ(run({"mesh", at("boxes.nii.gz"), "--edge-mm", "3", "--transfer", "9"}), kExitUsage);
  // What was looked up goes with the mesh into another format.
  ASSERT_EQ(
      run({"mesh", at("boxes.nii.gz"), "--merge", "--edge-mm", "3", "--look-up", "3,2", "-o", at("b.vtu")}),
      kExitOk);
  ASSERT_EQ(run({"convert", at("b.vtu"), at("b.carp")}), kExitOk);
  for (const char* name : {"centroid_label.dat", "majority_label.dat", "fraction_2.dat", "fraction_3.dat"})
    EXPECT_EQ(*read_file(at(std::string("b.") + name)), *read_file(at(std::string("a.") + name))) << name;
}

TEST_F(CliTest, WritesNoFibresForOpenCarpAndSaysSo) {
  ASSERT_EQ(run({"phantom", "sphere", "--set", "radius_mm=8", "--set", "spacing_mm=[1,1,1]", "-o",
                 at("ball.nii.gz")}),
            kExitOk);
  ASSERT_EQ(run({"mesh", at("ball.nii.gz"), "--edge-mm", "4", "-o", at("a.vtu")}), kExitOk);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"mesh", at("ball.nii.gz"), "--edge-mm", "4", "-o", at("b.carp")},
        {"convert", at("a.vtu"), at("c.carp")}}) {
    test::CaughtErrors errors;
    EXPECT_EQ(run(words), kExitOk);
    EXPECT_TRUE(errors.say("warning: " + words.back() + ": no fibres"));
  }
  EXPECT_FALSE(fs::exists(at("b.lon")));
  // Those of another mesh would be taken for this one's.
  write("c.lon", "1\n1 0 0\n");
  EXPECT_EQ(run({"convert", at("a.vtu"), at("c.carp")}), kExitUsage);
  EXPECT_EQ(run({"convert", at("a.vtu"), at("c.pts")}), kExitUsage);
  EXPECT_EQ(run({"convert", at("c.lon"), at("d.vtu")}), kExitOk);
}

/// Two cubes, one within the other, in 6 x 6 x 6 voxels; with their places in the list of segments.
std::string two_segments(int inner, int outer) {
  std::string text =
      "NRRD0004\ntype: uint8\ndimension: 4\nsizes: 2 6 6 6\nspace: right-anterior-superior\n"
      "space directions: none (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n"
      "kinds: list domain domain domain\nencoding: raw\n";
  const auto segment = [&](int number, const std::string& name, int layer) {
    const std::string key = "Segment" + std::to_string(number);
    text += key + "_Name:=" + name + "\n" + key + "_LabelValue:=1\n" + key +
            "_Layer:=" + std::to_string(layer) + "\n";
  };
  segment(inner, "inner", 0);
  segment(outer, "outer", 1);
  text += "\n";
  for (int v = 0; v < 216; ++v) {
    const auto within = [v](int margin) {
      const auto inside = [margin](int i) { return i >= margin && i < 6 - margin; };
      return static_cast<char>(inside(v % 6) && inside(v / 6 % 6) && inside(v / 36));
    };
    text += {within(2), within(1)};
  }
  return text;
}

TEST_F(CliTest, WarnsOfOverlappingSegmentsAndRefusesLostOnes) {
  write("kept.seg.nrrd", two_segments(1, 0));
  write("lost.seg.nrrd", two_segments(0, 1));
  const std::string warning =
      "kept.seg.nrrd: segments outer (label 1) and inner (label 2) overlap in 8 voxels: of the two the later "
      "one "
      "wins, inner (label 2)";
  {
    test::CaughtErrors errors;
    EXPECT_EQ(run({"mesh", at("kept.seg.nrrd"), "--merge", "--edge-mm", "2", "--report", at("report.json")}),
              kExitOk);
    EXPECT_TRUE(errors.say("warning: volume: " + warning));
  }
  const json warnings = read_json("report.json")["warnings"];
  EXPECT_NE(std::find(warnings.begin(), warnings.end(), "volume: " + warning), warnings.end()) << warnings;
  {
    test::CaughtErrors errors;
    EXPECT_EQ(run({"convert", at("kept.seg.nrrd"), at("a.nii.gz")}), kExitOk);
    EXPECT_TRUE(errors.say("inner (label 2)"));
  }
  test::CaughtErrors errors;
  EXPECT_EQ(run({"mesh", at("lost.seg.nrrd"), "--edge-mm", "2"}), kExitBadInput);
  EXPECT_TRUE(errors.say("segment inner (label 1) loses all of its 8 voxels to outer (label 2)"));
}

TEST_F(CliTest, MergesAllLabelsOrGroups) {
  ASSERT_EQ(run({"phantom", "nested_boxes", "--set", "radius_mm=8", "--set", "spacing_mm=[1,1,1]", "-o",
                 at("boxes.nii.gz")}),
            kExitOk);
  const auto merged = [&](std::vector<std::string> options) {
    std::vector<std::string> words{"mesh", at("boxes.nii.gz"), "--edge-mm",
                                   "4",    "--report",         at("report.json")};
    words.insert(words.end(), options.begin(), options.end());
    EXPECT_EQ(run(words), kExitOk);
    return read_json("report.json")["recipe"]["merge"];
  };
  EXPECT_EQ(merged({}), json::array());
  EXPECT_EQ(merged({"--merge"}), json::parse("[[1,2,3]]"));
  EXPECT_EQ(merged({"--labels", "1,3", "--merge"}), json::parse("[[1,3]]"));
  EXPECT_EQ(merged({"--merge", "1,2", "--merge", "3"}), json::parse("[[1,2],[3]]"));
  EXPECT_EQ(run({"mesh", at("boxes.nii.gz"), "--merge", "1,x"}), kExitUsage);
  EXPECT_EQ(run({"mesh", at("boxes.nii.gz"), "--merge", "1,2", "--merge"}), kExitUsage);
  EXPECT_EQ(run({"mesh", at("boxes.nii.gz"), "--merge", "1,9"}), kExitUsage);
}

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

TEST_F(CliTest, VerifiesThePromisedDigest) {
  write("case.json", kSphere);
  ASSERT_EQ(run({"mesh", at("case.json"), "--report", at("report.json")}), kExitOk);
  json promise = json::parse(kSphere);
  promise["expected"] = {{"digest", read_json("report.json")["digest"]}};
  write("case.json", promise.dump());
  EXPECT_EQ(run({"verify", at("case.json")}), kExitOk);
  EXPECT_EQ(run({"verify", at("case.json"), "--edge-mm", "2.5"}), kExitDiffers);
  write("other.json", kSphere);
  EXPECT_EQ(run({"verify", at("other.json")}), kExitUsage);
  write("expected.json", json{{"digest", promise["expected"]["digest"]}}.dump());
  EXPECT_EQ(run({"verify", at("other.json")}), kExitOk);
  for (const char* poor : {"[]", "{}", R"({"digest": 1})", R"({"digest": "ab", "tets": "many"})", "{"}) {
    write("expected.json", poor);
    EXPECT_EQ(run({"verify", at("other.json")}), kExitBadInput) << poor;
  }
  EXPECT_EQ(run({"verify", link_fragment(*parse_recipe(promise))}), kExitOk);
}

// The types of the web are made from it: scripts/update_contract writes both.
TEST(SchemaJson, IsTheOneThatTheContractOfTheWebIsMadeFrom) {
  const Result<Bytes> committed = read_file(VOXTET_SOURCE_DIR "/web/src/engine/schema.json");
  ASSERT_TRUE(committed.ok());
  json schema = schema_json();
  schema.erase("version");
  EXPECT_EQ(json::parse(committed->begin(), committed->end()), schema) << "run scripts/update_contract";
}

// Under node the output of the process cannot be caught: GoogleTest swaps file descriptors for it.
#ifndef __EMSCRIPTEN__
TEST_F(CliTest, TellsACaseOfAnotherEngineFromOneThatDiffers) {
  json promise = json::parse(kSphere);
  const auto verdict = [&](const std::string& engine, const std::string& digest) {
    promise["expected"] = {{"engine", engine}, {"digest", digest}, {"tets", 1}};
    write("case.json", promise.dump());
    testing::internal::CaptureStdout();
    const int code = run({"verify", at("case.json"), "--json"});
    const json told = json::parse(testing::internal::GetCapturedStdout());
    EXPECT_EQ(code, told["verdict"] == "reproduced" ? kExitOk : kExitDiffers);
    EXPECT_EQ(told["engine"], engine_version());
    EXPECT_EQ(told["expected_engine"], engine);
    return told;
  };
  const std::string other(64, 'a');
  EXPECT_EQ(verdict("0.1.0", other)["verdict"], "made with another engine");
  EXPECT_EQ(verdict(engine_version(), other)["verdict"], "differs");
  const std::string found = verdict("", other)["digest"];
  EXPECT_EQ(verdict("0.1.0", found)["verdict"], "reproduced") << "the same bytes, whoever made them";
}
#endif

TEST_F(CliTest, StopsAtTheTimeLimitWith6) {
  write("case.json", kSphere);
  EXPECT_EQ(run({"mesh", at("case.json"), "--time-limit", "1e-9", "-o", at("a.vtu")}), kExitLimits);
  EXPECT_EQ(files(), 1U);
}

TEST_F(CliTest, FindsTheVolumeBesideItsCase) {
  ASSERT_EQ(run({"phantom", "sphere", "--set", "radius_mm=8", "-o", at("ball.nii")}), kExitOk);
  write("case.json", R"({"source":{"file":{"name":"ball.nii"}},"sizing":{"edge_mm":3}})");
  EXPECT_EQ(run({"mesh", at("case.json"), "-o", at("a.vtu")}), kExitOk);
  write("wrong.json", R"({"source":{"file":{"name":"ball.nii","sha256":"00"}},"sizing":{"edge_mm":3}})");
  EXPECT_EQ(run({"mesh", at("wrong.json")}), kExitBadInput);
}

TEST_F(CliTest, MakesLinksThatComeBack) {
  write("case.json", kSphere);
  EXPECT_EQ(run({"url", at("case.json")}), kExitOk);
  EXPECT_EQ(run({"url", "#c1=broken"}), kExitUsage);
}

TEST_F(CliTest, MasksAndSizeImagesSitBesideTheCaseOrComeByOption) {
  write("case.json", kSphere);
  ASSERT_EQ(run({"field", at("case.json"), "-o", at("sizes.nii.gz")}), kExitOk);
  ASSERT_EQ(run({"phantom", "sphere", "--set", "radius_mm=3", "-o", at("paint.nii.gz")}), kExitOk);
  ASSERT_EQ(run({"mesh", at("case.json"), "--report", at("plain.json")}), kExitOk);
  ASSERT_EQ(run({"mesh", at("case.json"), "--size-image", at("sizes.nii.gz"), "--mask", at("paint.nii.gz"),
                 "--mask-edge", "1=1.5", "--report", at("options.json")}),
            kExitOk);
  json named = json::parse(kSphere);
  named["sizing"]["images"] = {{{"name", "sizes.nii.gz"}}};
  named["sizing"]["masks"] = {{{"name", "paint.nii.gz"}, {"edges", {{{"label", 1}, {"edge_mm", 1.5}}}}}};
  write("named.json", named.dump());
  ASSERT_EQ(run({"mesh", at("named.json"), "--report", at("named_report.json")}), kExitOk);
  EXPECT_EQ(read_json("options.json")["digest"], read_json("named_report.json")["digest"]);
  EXPECT_GT(read_json("options.json")["tets"].get<int>(), read_json("plain.json")["tets"].get<int>());
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

TEST_F(CliTest, WritesBehindLinks) {
  write("case.json", kSphere);
  write("old.json", "old");
  fs::create_symlink("old.json", at("link.json"));
  ASSERT_EQ(run({"mesh", at("case.json"), "--report", at("link.json")}), kExitOk);
  EXPECT_TRUE(fs::is_symlink(at("link.json")));
  EXPECT_TRUE(read_json("old.json").contains("digest"));
  EXPECT_EQ(files(), 3U);
}

#ifndef __EMSCRIPTEN__  // there are no pipes, and standard error cannot be caught
TEST_F(CliTest, WritesIntoPipesAndLeavesThemThere) {
  write("case.json", kSphere);
  ASSERT_EQ(mkfifo(at("pipe").c_str(), 0600), 0);
  const int reader = open(at("pipe").c_str(), O_RDWR | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  ASSERT_EQ(run({"mesh", at("case.json"), "-o", at("sphere.vtu"), "--report", at("pipe")}), kExitOk);
  char text[2] = {};
  EXPECT_EQ(read(reader, text, 1), 1);
  EXPECT_STREQ(text, "{");
  close(reader);
  EXPECT_TRUE(fs::is_fifo(at("pipe")));
}

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

TEST_F(CliTest, SaysWhichTimeLimitIsOver) {
  write("case.json", kSphere);
  testing::internal::CaptureStderr();
  EXPECT_EQ(run({"mesh", at("case.json"), "--time-limit", "1e-6"}), kExitLimits);
  EXPECT_NE(testing::internal::GetCapturedStderr().find("given up after the 1e-06 s of --time-limit"),
            std::string::npos);
  EXPECT_EQ(run({"mesh", at("case.json"), "--time-limit", "-1"}), kExitUsage);
  EXPECT_EQ(run({"mesh", at("case.json"), "--threads", "0"}), kExitUsage);
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

TEST_F(CliTest, ReportsTheLayersOfAWall) {
  write("case.json",
        R"({"source":{"phantom":{"kind":"shell","radius_mm":14,"inner_radius_mm":8,"spacing_mm":[1,1,1]}},)"
        R"("sizing":{"thickness":[{"wall":[1],"layers":2}]}})");
  ASSERT_EQ(run({"mesh", at("case.json"), "--report", at("report.json")}), kExitOk);
  const json layers = read_json("report.json")["layers"];
  ASSERT_EQ(layers.size(), 1U);
  EXPECT_EQ(layers[0]["wall"], json({1}));
  EXPECT_EQ(layers[0]["target_layers"], 2);
  EXPECT_GT(layers[0]["by_edges"]["exact"], 0.8);
  EXPECT_EQ(layers[0]["by_lines"]["at_least"], 1);
}

TEST_F(CliTest, EndsWithAStageAndWritesWhatEachGave) {
  write("case.json", kSphere);
  ASSERT_EQ(run({"mesh", at("case.json"), "--until", "remesh", "--dump", at("a"), "--report", at("a.json")}),
            kExitOk);
  for (const char* name : {"volume.nii.gz", "surface.ply", "smooth.ply", "sizing.nii.gz", "remesh.ply"})
    EXPECT_TRUE(fs::exists(at("a/" + std::string(name)))) << name;
  EXPECT_FALSE(fs::exists(at("a/tetra.vtu")));
  EXPECT_EQ(read_json("a/report.json"), read_json("a.json"));
  EXPECT_EQ(read_json("a.json")["stages"].size(), 7U);
  ASSERT_EQ(run({"mesh", at("case.json"), "--dump", at("a"), "--report", at("a.json")}), kExitOk);
  EXPECT_EQ(read_tet_mesh_file(at("a/tetra.vtu"))->tets.size(),
            read_json("a.json")["stages"][7]["counts"]["tets"]);
  EXPECT_EQ(read_tet_mesh_file(at("a/optimise.vtu"))->tets.size(), read_json("a.json")["tets"]);
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
