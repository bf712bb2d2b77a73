// The words of the command line: labels, lengths, standard input and output, errors as JSON.
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/cli.h"
#include "cli/words/label_words.h"
#include "cli/words/option_texts.h"
#include "io/bytes/files.h"
#include "io/mesh/read_mesh.h"
#include "recipe/recipe.h"
#include "support/printed.h"
#include "unit/cli/cli_fixture.h"

namespace voxtet {
namespace {

using nlohmann::json;

/// One voxel each of the labels 1 to 3 and 7; two share a name.
LabelVolume four_labels() {
  LabelVolume volume;
  volume.size = {5, 1, 1};
  volume.labels = {0, 1, 2, 3, 7};
  volume.infos = {{1, "Wall", {}}, {2, "Left-blood", {}}, {3, "scar", {}}, {7, "Scar", {}}};
  return volume;
}

TEST(LabelWords, FindNumbersRangesNamesAndAll) {
  const LabelVolume volume = four_labels();
  const LabelWords words(&volume);
  using Labels = std::vector<Label>;
  for (const auto& [text, labels] : std::vector<std::pair<std::string, Labels>>{{"3,1", {3, 1}},
                                                                                {"9", {9}},
                                                                                {"Wall,1-3", {1, 2, 3}},
                                                                                {"2-100", {2, 3, 7}},
                                                                                {"wall", {1}},
                                                                                {"Scar", {7}},
                                                                                {"scar", {3}},
                                                                                {"left-blood,1", {2, 1}},
                                                                                {"all", {1, 2, 3, 7}}}) {
    const Result<Labels> found = words.labels_of("--labels", text);
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_EQ(*found, labels) << text;
  }
  for (const auto& [text, said] : std::vector<std::pair<std::string, std::string>>{
           {"", "--labels: found nothing, expected labels: numbers as 1,2,5, ranges as 1-3, names, or all"},
           {"1,", "found '1,', expected labels"},
           {"0", "found '0', expected labels from 1 to 65535"},
           {"65536", "found '65536', expected labels from 1 to 65535"},
           {"SCAR", "'SCAR' is the name of the labels 3 and 7, expected one of these numbers"},
           {"4-6", "found no label '4-6' in the volume, which has 1 (Wall), 2 (Left-blood)"},
           {"lung", "found no label 'lung' in the volume"},
           {"1-x", "found no label '1-x' in the volume"}}) {
    const Result<Labels> found = words.labels_of("--labels", text);
    ASSERT_FALSE(found.ok()) << text;
    EXPECT_EQ(found.error().code, ErrorCode::kUsage);
    EXPECT_NE(found.error().message.find(said), std::string::npos) << found.error().message;
  }
}

TEST(LabelWords, KnowOnlyNumbersBeforeTheVolumeIsRead) {
  const LabelWords words(nullptr);
  EXPECT_EQ(*words.labels_of("--labels", "5,Wall,1-3,all"), std::vector<Label>{5});
  EXPECT_FALSE(words.labels_of("--labels", "0").ok());
}

TEST(OptionTexts, ReadLengthsWithUnits) {
  for (const auto& [text, mm] : std::vector<std::pair<std::string, double>>{
           {"2", 2}, {"2mm", 2}, {"0.2cm", 2}, {"800um", 0.8}, {"0.8 mm", 0.8}, {"800\xc2\xb5m", 0.8}}) {
    const Result<double> read = to_mm("--edge-mm", text);
    ASSERT_TRUE(read.ok()) << text;
    EXPECT_EQ(*read, mm) << text;
  }
  for (const char* text : {"", "mm", "2 apples", "2,5", "nan", "1e999"}) {
    const Result<double> read = to_mm("--edge-mm", text);
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_NE(read.error().message.find("expected a length as 2, 2mm, 0.2cm or 800um"), std::string::npos);
  }
}

TEST_F(CliTest, TakesLabelsByNameRangeAndAll) {
  ASSERT_EQ(run({"phantom", "nested_boxes", "--set", "radius_mm=8", "--set", "spacing_mm=[1,1,1]", "-o",
                 at("boxes.nii.gz")}),
            kExitOk);
  write("case.json",
        R"({"source":{"phantom":{"kind":"nested_boxes","radius_mm":8,"spacing_mm":[1,1,1]}},"labels":[2]})");
  const auto recipe_of = [&](const std::string& input, const std::vector<std::string>& options) {
    std::vector<std::string> words{"mesh", at(input), "--until", "volume", "--report", at("report.json")};
    words.insert(words.end(), options.begin(), options.end());
    EXPECT_EQ(run(words), kExitOk);
    return read_json("report.json")["recipe"];
  };
  EXPECT_EQ(recipe_of("boxes.nii.gz", {"--labels", "1-2"})["labels"], json({1, 2}));
  EXPECT_EQ(recipe_of("boxes.nii.gz", {"--labels", "all"})["labels"], json({1, 2, 3}));
  EXPECT_EQ(recipe_of("case.json", {"--labels", "all"})["labels"], json({1, 2, 3}));
  EXPECT_EQ(recipe_of("case.json", {"--labels", "outer box,3"})["labels"], json({1, 3}));
  EXPECT_EQ(recipe_of("case.json", {"--merge"})["merge"], json::parse("[[2]]"));
  EXPECT_EQ(recipe_of("boxes.nii.gz", {"--merge", "2-9"})["merge"], json::parse("[[2,3]]"));
  const json sizing =
      recipe_of("boxes.nii.gz", {"--edge-mm", "0.2cm", "--edge-label", "2-3=800um"})["sizing"];
  EXPECT_EQ(sizing["edge_mm"], 2);
  EXPECT_EQ(sizing["labels"], json::parse(R"([{"label":2,"edge_mm":0.8},{"label":3,"edge_mm":0.8}])"));
}

// A plane of the command line becomes a field of the recipe, and a surface of its name in every kind of file.
TEST_F(CliTest, CutsAtAPlane) {
  write(
      "boxes.json",
      R"({"source":{"phantom":{"kind":"nested_boxes","radius_mm":8,"inner_radius_mm":5,"spacing_mm":[1,1,1]}},
            "sizing":{"edge_mm":3}})");
  const auto has = [&](const std::string& name, const std::string& text) {
    const Result<Bytes> bytes = read_file(at(name));
    return bytes.ok() && std::string(bytes->begin(), bytes->end()).find(text) != std::string::npos;
  };
  for (const std::string name : {"a.msh", "a.inp", "a.vtu", "a.feb", "a.bdf"})
    ASSERT_EQ(run({"mesh", at("boxes.json"), "--cut", "all:0,0,1.3:0.2,0.1,1:base", "--cut",
                   "outer box,2:0,0,-4:0,0,-1", "-o", at(name), "--report", at("report.json")}),
              kExitOk)
        << name;
  EXPECT_TRUE(has("a.msh", "\"base\"") && has("a.msh", "\"cut\""));
  EXPECT_TRUE(has("a.inp", "NAME=base") && has("a.inp", "NAME=cut"));
  EXPECT_TRUE(has("a.surfaces.vtu", "base") && has("a.surfaces.vtu", "cut"));
  EXPECT_TRUE(has("a.feb", "\"base\"") && has("a.bdf", "base"));
  const json report = read_json("report.json");
  EXPECT_EQ(report["recipe"]["volume"]["cut"][0]["name"], "base");
  EXPECT_EQ(report["recipe"]["volume"]["cut"][0]["labels"], json::array());
  EXPECT_EQ(report["recipe"]["volume"]["cut"][1]["labels"], json({1, 2}));
  EXPECT_EQ(report["recipe"]["volume"]["cut"][1]["normal"], json({0, 0, -1}));
  const json taken = report["stages"][0]["counts"]["cut"];
  EXPECT_EQ(taken[0]["name"], "base");
  EXPECT_GT(taken[0]["labels"][0]["voxels"], 100);
  EXPECT_EQ(taken[1]["name"], "cut");
  for (const json& item : report["quality"]["checklist"]) {
    EXPECT_TRUE(item["passed"] || !item["hard"]) << item;
  }
}

TEST_F(CliTest, SaysWhatFormWasExpected) {
  write("case.json", kSphere);
  for (const auto& [options, said] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"--labels"}, "--labels: found nothing, expected labels: numbers as 1,2,5, ranges as 1-3"},
           {{"--labels", "heart"}, "--labels: found no label 'heart' in the volume, which has 1"},
           {{"--edge-label", "2:1"}, "--edge-label 2:1: expected 2=1, with = for :"},
           {{"--edge-label", "2"}, "--edge-label 2: expected LABEL=LENGTH, as 5=0.8"},
           {{"--edge-label", "1=x"}, "--edge-label 1=x: found 'x', expected a length as 2, 2mm"},
           {{"--mask-edge", "Wall=2"}, "--mask-edge Wall=2: expected labels of the mask by number, as 1=0.8"},
           {{"--cut", "1"}, "--cut 1: found 1 parts, expected LABELS:X,Y,Z:NX,NY,NZ or"},
           {{"--cut", "1:0,0:0,0,1"}, "--cut 1:0,0:0,0,1: found '0,0', expected LABELS:X,Y,Z:NX,NY,NZ"},
           {{"--cut", "heart:0,0,0:0,0,1"}, "found no label 'heart' in the volume, which has 1"},
           {{"--threads", "x"}, "--threads: found 'x', expected a whole number as 2; 0 for one a core"},
           {{"--threads", "1.5"}, "--threads: found '1.5', expected a whole number as 2"},
           {{"--time-limit", "1min"}, "--time-limit: found '1min', expected seconds as 60; 0 for no limit"},
           {{"--frame", "x"}, "--frame: found 'x', expected a whole number as 0"},
           {{"--edge-mm", "2 apples"}, "--edge-mm: found '2 apples', expected a length as 2, 2mm"},
           {{"--set", "sizing.edge_mm:2"}, "--set sizing.edge_mm:2: expected sizing.edge_mm=2"},
           {{"--report", "-"}, "--report -: found standard output, expected the name of a file"},
           {{"-o", "-"}, "-o -: expected --output-format with vtu, vtk, msh, mesh"},
           {{"-o", "-", "--output-format", "carp"}, "--output-format: found 'carp', expected vtu, vtk, msh"},
           {{"-o", "-", "--output-format", "vtu", "--json"}, "--json: found -o -"},
           {{"-o", at("a.vtu"), "--output-format", "vtu"}, "whose ending says the format; expected -o -"},
           {{"--input-format", "vtu"}, "which has a name; expected - for standard input"}}) {
    std::vector<std::string> words{"mesh", at("case.json")};
    words.insert(words.end(), options.begin(), options.end());
    test::CaughtErrors errors;
    EXPECT_EQ(run(words), kExitUsage) << said;
    EXPECT_TRUE(errors.say(said)) << said;
  }
  EXPECT_EQ(files(), 1U);
}

TEST_F(CliTest, NotesBeforeTheRunThatNoMeshWillBeWritten) {
  write("case.json", kSphere);
  const std::string note = "note: no -o: the report will be printed, and no mesh written";
  test::CaughtErrors errors;
  EXPECT_EQ(run({"mesh", at("case.json"), "--threads", "0"}), kExitOk);
  EXPECT_TRUE(errors.say(note));
}

#ifndef __EMSCRIPTEN__  // what is printed cannot be caught, nor standard input replaced
TEST_F(CliTest, PrintsOneObjectForAnErrorWithJson) {
  write("case.json", kSphere);
  const auto error_of = [&](std::vector<std::string> words) {
    words.push_back("--json");
    testing::internal::CaptureStdout();
    EXPECT_NE(run(words), kExitOk) << words[0];
    const json told = json::parse(testing::internal::GetCapturedStdout(), nullptr, false);
    EXPECT_FALSE(told.is_discarded()) << words[0];
    return told.value("error", json());
  };
  EXPECT_EQ(error_of({"mesh", at("none.nii")})["code"], "bad_input");
  EXPECT_EQ(error_of({"mesh", at("case.json"), "--labels", "x"})["stage"], "cli");
  EXPECT_EQ(error_of({"mesh", at("case.json"), "--threads", "x"})["code"], "usage");
  EXPECT_EQ(error_of({"mesh"})["code"], "usage");
  EXPECT_EQ(error_of({"check", at("none.vtu")})["code"], "bad_input");
  EXPECT_EQ(error_of({"verify", at("case.json")})["stage"], "verify");
  EXPECT_EQ(error_of({"simulate", at("case.json")})["code"], "usage");
  for (const char* command : {"mesh", "forecast", "field"}) {
    std::vector<std::string> words{command, at("case.json"), "--time-limit", "1e-9"};
    if (words[0] == "field") words.insert(words.end(), {"-o", at("a.nii")});
    EXPECT_EQ(error_of(words)["message"], "given up after the 1e-09 s of --time-limit") << command;
  }
}

TEST_F(CliTest, ReadsStandardInputAndWritesStandardOutput) {
  ASSERT_EQ(run({"phantom", "sphere", "--set", "radius_mm=6", "--set", "spacing_mm=[1,1,1]", "-o",
                 at("ball.nii.gz")}),
            kExitOk);
  const auto with_input = [&](const std::string& name, const std::vector<std::string>& words) {
    EXPECT_NE(std::freopen(at(name).c_str(), "rb", stdin), nullptr);
    testing::internal::CaptureStdout();
    EXPECT_EQ(run(words), kExitOk) << words[0];
    return testing::internal::GetCapturedStdout();
  };
  ASSERT_EQ(run({"mesh", at("ball.nii.gz"), "--edge-mm", "3", "-o", at("a.vtu")}), kExitOk);
  const Bytes file = *read_file(at("a.vtu"));
  EXPECT_EQ(with_input("ball.nii.gz", {"mesh", "-", "--edge-mm", "3", "-o", "-", "--output-format", "vtu"}),
            std::string(file.begin(), file.end()));
  EXPECT_EQ(
      with_input("ball.nii.gz", {"mesh", "-", "--edge-mm", "3", "-o", at("b.vtu"), "--report", at("b.json")})
              .find("tetrahedra") == std::string::npos,
      false);
  EXPECT_EQ(read_json("b.json")["recipe"]["source"]["file"]["name"], "stdin");
  EXPECT_NE(with_input("a.vtu", {"check", "-"}).find("tetrahedra"), std::string::npos);
  EXPECT_NE(with_input("a.vtu", {"mesh", "-", "--input-format", "vtu"}).find("tetrahedra"),
            std::string::npos);
  // A mask too, and what is no plain file.
  with_input("ball.nii.gz", {"mesh", at("ball.nii.gz"), "--mask", "-", "--mask-edge", "1=1.5", "--edge-mm",
                             "3", "--report", at("c.json")});
  EXPECT_EQ(read_json("c.json")["recipe"]["sizing"]["masks"][0]["name"], "stdin");
  with_input("ball.nii.gz", {"mesh", at("ball.nii.gz"), "--mask", "/dev/stdin", "--mask-edge", "1=1.5",
                             "--edge-mm", "3", "--report", at("d.json")});
  EXPECT_EQ(read_json("c.json")["digest"], read_json("d.json")["digest"]);
  EXPECT_NE(read_json("c.json")["digest"], read_json("b.json")["digest"]);
}
#endif

TEST_F(CliTest, TakesWhatAStackOfThickSlicesNeeds) {
  write("case.json", R"({"source":{"phantom":{"kind":"sphere","radius_mm":8,"spacing_mm":[1,1,4]}},)"
                     R"("volume":{"slice_ratio":0}})");
  const auto recipe = [&](const std::string& option) {
    EXPECT_EQ(run({"mesh", at("case.json"), option, "--until", "volume", "--report", at("report.json")}), 0);
    return read_json("report.json")["recipe"];
  };
  EXPECT_EQ(recipe("--align-slices")["volume"]["align_slices"], true);
  EXPECT_EQ(recipe("--align-slices")["volume"]["slice_ratio"], 0);
  const nlohmann::json preset = thick_stack_preset();
  for (const auto& [group, fields] : preset.items())
    for (const auto& [name, value] : fields.items())
      EXPECT_EQ(recipe("--stack")[group][name], value) << group << "." << name;
}

TEST_F(CliTest, NamesOfTheRecipeAreUnderstoodAndWritten) {
  json recipe = json::parse(kSphere);
  recipe["legend"] = {{{"label", 1}, {"name", "Kugel"}}};
  write("case.json", recipe.dump());
  ASSERT_EQ(run({"mesh", at("case.json"), "--labels", "kugel", "-o", at("ball.msh")}), 0);
  const Result<Bytes> mesh = read_file(at("ball.msh"));
  ASSERT_TRUE(mesh.ok());
  EXPECT_NE(std::string(mesh->begin(), mesh->end()).find("\"Kugel\""), std::string::npos);
}

}  // namespace
}  // namespace voxtet
