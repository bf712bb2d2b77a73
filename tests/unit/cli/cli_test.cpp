// What the commands do and write.
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
#include "pipeline/version/engine_version.h"
#include "recipe/link.h"
#include "support/check_tets.h"
#include "support/printed.h"
#include "unit/cli/cli_fixture.h"

namespace voxtet {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

TEST_F(CliTest, TellsByItsExitCodeThatExactLayersWereGivenUp) {
  const auto mesh_with = [this](const char* distance_voxels) {
    write("case.json",
          R"({"source":{"phantom":{"kind":"shell","radius_mm":18,"inner_radius_mm":8,"spacing_mm":[1,1,1]}},
          "sizing":{"edge_mm":10,"thickness":[{"wall":[1],"layers":1,"layering":"exact"}]},
          "remesh":{"max_distance_voxels":)" +
              std::string(distance_voxels) + "}}");
    return run({"mesh", at("case.json"), "-o", at("layers.vtu"), "--report", at("report.json")});
  };
  EXPECT_EQ(mesh_with("0.5"), kExitOk);
  EXPECT_FALSE(read_json("report.json").contains("error"));
  EXPECT_EQ(mesh_with("0.03"), kExitMeshing);
  EXPECT_NE(
      read_json("report.json")["error"]["message"].get<std::string>().find("exact layers were given up"),
      std::string::npos);
  EXPECT_TRUE(fs::exists(at("layers.vtu")));
}

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

TEST_F(CliTest, TransfersLabelsThatTheMeshDoesNotFollow) {
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
  // What was transferred goes with the mesh into another format.
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
  test::CaughtErrors errors;
  EXPECT_EQ(run({"convert", at("c.lon"), at("d.vtu")}), kExitBadInput);
  EXPECT_TRUE(errors.say("c.lon: line 3: found 1 rows, expected"));
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

TEST_F(CliTest, WarnsOfOverlappingSegmentsAndOfLostOnes) {
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
  EXPECT_EQ(run({"mesh", at("lost.seg.nrrd"), "--until", "volume"}), kExitOk);
  EXPECT_TRUE(
      errors.say("SEGMENT LOST: segment inner (label 1) loses all of its 8 voxels to outer (label 2)"));
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

#ifndef __EMSCRIPTEN__  // there are no pipes, and what is printed cannot be caught
TEST_F(CliTest, TellsACaseOfAnotherEngineFromOneThatDiffers) {
  json promise = json::parse(kSphere);
  const auto verdict = [&](const std::string& engine, const std::string& digest) {
    promise["expected"] = {{"engine", engine}, {"digest", digest}, {"tets", 1}};
    write("case.json", promise.dump());
    testing::internal::CaptureStdout();
    const int code = run({"verify", at("case.json"), "--json"});
    json told = json::parse(testing::internal::GetCapturedStdout());
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

TEST_F(CliTest, WritesBehindLinks) {
  write("case.json", kSphere);
  write("old.json", "old");
  fs::create_symlink("old.json", at("link.json"));
  ASSERT_EQ(run({"mesh", at("case.json"), "--report", at("link.json")}), kExitOk);
  EXPECT_TRUE(fs::is_symlink(at("link.json")));
  EXPECT_TRUE(read_json("old.json").contains("digest"));
  EXPECT_EQ(files(), 3U);
}

#ifndef __EMSCRIPTEN__  // there are no pipes, and what is printed cannot be caught
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
#endif

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

}  // namespace
}  // namespace voxtet
