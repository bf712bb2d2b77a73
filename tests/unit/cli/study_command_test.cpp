// `voxtet study`, and the cohorts of `voxtet phantom`.
#include "base/digest.h"
#include "cli_fixture.h"
#include "io/volume/read_volume.h"

namespace voxtet {
namespace {

using nlohmann::json;

constexpr const char* kTwoBalls =
    R"({"study":1,"case":{"source":{"phantom":{"kind":"sphere","radius_mm":8,"spacing_mm":[2,2,2]}}},"grid":{"sizing.edge_mm":[3,5]}})";

TEST_F(CliTest, StudyRunsInChunksAndWritesItsTable) {
  write("study.json", kTwoBalls);
  EXPECT_EQ(run({"study", at("study.json"), "--chunk", "2/2", "-o", at("out")}), kExitOk);
  EXPECT_FALSE(std::filesystem::exists(at("out/table.csv")));
  EXPECT_EQ(run({"study", at("study.json"), "--table", "-o", at("out")}), kExitOk);
  const Result<Bytes> part = read_file(at("out/table.csv"));
  ASSERT_TRUE(part.ok());
  const std::string text(part->begin(), part->end());
  EXPECT_NE(text.find(",missing,"), std::string::npos);
  EXPECT_NE(text.find(",done,"), std::string::npos);
  EXPECT_EQ(run({"study", at("study.json"), "-o", at("out"), "--jobs", "2", "--threads", "1"}), kExitOk);
  EXPECT_EQ(run({"study", at("study.json"), "-o", at("other")}), kExitOk);
  for (const char* file : {"table.csv", "table.jsonl"}) {
    const Result<Bytes> one = read_file(at(std::string("out/") + file)),
                        two = read_file(at(std::string("other/") + file));
    ASSERT_TRUE(one.ok() && two.ok());
    EXPECT_EQ(*one, *two) << file;
  }
  EXPECT_TRUE(std::filesystem::exists(at("out/index.html")));
}

TEST_F(CliTest, StudyPlansItsChunks) {
  write("study.json", kTwoBalls);
  EXPECT_EQ(run({"study", at("study.json"), "--plan", "2", "-o", at("out")}), kExitOk);
  const json plan = read_json("out/plan.json");
  EXPECT_EQ(plan["cases"], 2);
  ASSERT_EQ(plan["chunks"].size(), 2U);
  EXPECT_EQ(plan["chunks"][1]["chunk"], "2/2");
  EXPECT_EQ(plan["chunks"][1]["cases"], 1);
  EXPECT_GT(plan["chunks"][0]["seconds"], plan["chunks"][1]["seconds"]);  // of smaller edges
  EXPECT_FALSE(std::filesystem::exists(at("out/cases")));
}

TEST_F(CliTest, StudyRefusesWhatMakesNoSense) {
  write("study.json", kTwoBalls);
  for (const char* chunk :
       {"3/2", "0/2", "2", "2/2x", "-1/2", "1/-2", "a/b", "", " 1/2", "+1/2", "1/2/2", "1/99999999999"})
    EXPECT_EQ(run({"study", at("study.json"), "--chunk", chunk, "-o", at("out")}), kExitUsage) << chunk;
  EXPECT_EQ(run({"study", at("study.json"), "--chunk", "1/2", "--table", "-o", at("out")}), kExitUsage);
  EXPECT_EQ(run({"study", at("study.json"), "--plan", "0", "-o", at("out")}), kExitUsage);
  EXPECT_EQ(run({"study", at("study.json"), "--jobs", "0", "-o", at("out")}), kExitUsage);
  EXPECT_EQ(run({"study", at("study.json")}), kExitUsage);
  EXPECT_EQ(run({"study", at("none.json"), "-o", at("out")}), kExitBadInput);
  EXPECT_FALSE(std::filesystem::exists(at("out")));
}

TEST_F(CliTest, PhantomDrawsTheHeartsOfAStudy) {
  EXPECT_EQ(run({"phantom", "biventricle", "--set", "spacing_mm=[4,4,4]", "--hearts", "2", "--seed", "5",
                 "--draw", "scale=0.9:1.1", "--draw", "scar=true,false", "-o", at("hearts")}),
            kExitOk);
  write(
      "study.json",
      R"({"study":1,"case":{"source":{"phantom":{"kind":"biventricle","spacing_mm":[4,4,4]}},"sizing":{"edge_mm":8}},"stages":["volume"],)"
      R"("cohort":{"hearts":2,"seed":5,"draw":{"source.phantom.scale":{"from":0.9,"to":1.1},"source.phantom.scar":{"among":[true,false]}}},"keep":["report"]})");
  EXPECT_EQ(run({"study", at("study.json"), "-o", at("out")}), kExitOk);
  const Result<Bytes> table = read_file(at("out/table.jsonl"));
  ASSERT_TRUE(table.ok());
  std::istringstream lines(std::string(table->begin(), table->end()));
  std::string line;
  for (int heart = 1; std::getline(lines, line); ++heart) {
    const json row = json::parse(line);
    EXPECT_EQ(run({"url", row["link"].get<std::string>()}), kExitOk);
    const json report = read_json("out/files/" + row["key"].get<std::string>() + ".report.json");
    const Result<LabelVolume> volume =
        read_volume_file(at("hearts/heart_000" + std::to_string(heart) + ".nii.gz"));
    ASSERT_TRUE(volume.ok()) << volume.error().message;
    EXPECT_EQ(report["source"]["digest"], digest_of(*volume)) << heart;
  }
}

TEST_F(CliTest, PhantomRefusesDrawsThatItCannotMake) {
  EXPECT_EQ(run({"phantom", "biventricle", "--draw", "scale=0.9:1.1", "-o", at("a.nii.gz")}), kExitUsage);
  EXPECT_EQ(run({"phantom", "biventricle", "--seed", "3", "-o", at("a.nii.gz")}), kExitUsage);
  for (const char* draw : {"scale", "scale=", "scale=1.1:0.9", "scale=a:b", "size=1:2", "scale=50:60"})
    EXPECT_EQ(run({"phantom", "biventricle", "--hearts", "1", "--draw", draw, "-o", at("hearts")}),
              kExitUsage)
        << draw;
}

}  // namespace
}  // namespace voxtet
