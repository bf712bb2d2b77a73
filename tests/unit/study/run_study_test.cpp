#include "study/run_study.h"

#include <csignal>

#include "recipe/link.h"
#include "study/case_key.h"
#include "study/child_process.h"
#include "study/table.h"
#include "study_folder.h"

namespace voxtet {
namespace {

using Json = nlohmann::ordered_json;

struct Told {
  std::size_t done = 0, failed = 0, were_there = 0, not_written = 0;
};

Told run(const Study& study, const std::string& out, Chunk chunk = {}, int jobs = 1, CaseLimits limits = {}) {
  Told told;
  const Status done = run_study(study, {.out = out,
                                        .chunk = chunk,
                                        .jobs = jobs,
                                        .limits = limits,
                                        .on_case = [&](const StudyCase&, const Json& record, bool was_there) {
                                          if (was_there) ++told.were_there;
                                          if (record.is_null())
                                            ++told.not_written;
                                          else if (record["status"] == "done")
                                            ++told.done;
                                          else
                                            ++told.failed;
                                        }});
  EXPECT_EQ(done.ok(), told.not_written == 0);
  return told;
}

std::size_t count_files(const std::string& folder, const std::string& ending) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    count += entry.path().string().ends_with(ending) ? 1 : 0;
  return count;
}

constexpr const char* kFour = R"("grid":{"sizing.edge_mm":[3,4,5,6]},"keep":["vtu","report"])";

TEST_F(StudyTest, TheTableIsTheSameHoweverItWasRun) {
  const Study study = study_with(kFour).value();
  const Told once = run(study, at("one"));
  EXPECT_EQ(once.done, 4U);
  EXPECT_EQ(once.were_there, 0U);
  EXPECT_EQ(run(study, at("chunks"), {2, 3}, 2, {.threads = 2}).done, 1U);
  const std::vector<Json> part = read_table(study, at("chunks")).rows;
  EXPECT_EQ(part[0]["status"], "missing");
  EXPECT_EQ(part[1]["status"], "done");
  run(study, at("chunks"), {3, 3}, 2, {.threads = 2});
  run(study, at("chunks"), {1, 3}, 2, {.threads = 2});
  const StudyTable one = read_table(study, at("one")), chunks = read_table(study, at("chunks"));
  EXPECT_EQ(csv_of(one.rows), csv_of(chunks.rows));
  EXPECT_EQ(json_lines_of(one.rows), json_lines_of(chunks.rows));
  EXPECT_EQ(count_files(at("one/pictures"), ".png"), 4U);
  EXPECT_EQ(count_files(at("one/files"), ".vtu"), 4U);
  EXPECT_EQ(count_files(at("one/files"), ".report.json"), 4U);
  EXPECT_EQ(count_files(at("one"), ".json"), 0U);
  for (const Json& cost : one.costs)
    for (const char* field : {"seconds", "peak_mb", "forecast_seconds", "forecast_mb"})
      EXPECT_GT(cost[field].get<double>(), 0) << field;
}

TEST_F(StudyTest, WhatIsDoneIsNotDoneAgain) {
  const Study study = study_with(kFour).value();
  run(study, at("out"));
  const std::string table = csv_of(read_table(study, at("out")).rows);
  EXPECT_EQ(run(study, at("out")).were_there, 4U);
  // A record that is damaged counts as none, however it is damaged.
  const std::string record = "out/cases/" + CaseKeys(study.plan).of(study.cases[2]) + ".json";
  write(record, text_of(record).substr(0, 100));
  EXPECT_EQ(read_table(study, at("out")).rows[2]["status"], "missing");
  EXPECT_EQ(run(study, at("out")).were_there, 3U);
  EXPECT_EQ(csv_of(read_table(study, at("out")).rows), table);
  for (const char* field : {"figures", "link", "again", "cost", "status", "key"}) {
    Json damaged = Json::parse(text_of(record));
    damaged[field] = nullptr;
    write(record, damaged.dump());
    EXPECT_EQ(read_table(study, at("out")).rows[2]["status"], "missing") << field;
    EXPECT_EQ(run(study, at("out")).were_there, 3U) << field;
  }
  // Another recipe is another case.
  const Study other = study_with(R"("grid":{"sizing.edge_mm":[3,7]},"keep":["vtu","report"])").value();
  EXPECT_EQ(run(other, at("out")).were_there, 1U);
}

TEST_F(StudyTest, FailuresAreRowsAndTheRestIsDone) {
  Study study = study_with(R"("grid":{"sizing.edge_mm":[4,5]})").value();
  write("broken.nii", "no image");
  StudyCase broken = study.cases[0], absent = study.cases[0];
  for (StudyCase* one : {&broken, &absent}) one->recipe.source.phantom.reset();
  broken.volume_path = at("broken.nii");
  broken.recipe.source.file = FileSource{"broken.nii", {}, {}};
  absent.volume_path = at("absent.nii");
  absent.recipe.source.file = FileSource{"absent.nii", {}, {}};
  StudyCase beyond = study.cases[0];
  beyond.recipe.limits.tets = 10;
  study.cases.insert(study.cases.begin() + 1, {broken, absent, beyond});
  const Told told = run(study, at("out"));
  EXPECT_EQ(told.done, 2U);
  EXPECT_EQ(told.failed, 3U);
  const std::vector<Json> rows = read_table(study, at("out")).rows;
  const auto reason = [&](std::size_t row) { return rows[row]["reason"].get<std::string>(); };
  EXPECT_NE(reason(1).find("broken.nii: "), std::string::npos) << reason(1);
  EXPECT_NE(reason(2).find("absent.nii: cannot be opened"), std::string::npos) << reason(2);
  EXPECT_NE(reason(3).find("limits.tets"), std::string::npos) << reason(3);
  EXPECT_EQ(rows[3]["stage"], "forecast");
  for (const std::size_t row : {1U, 2U, 3U}) EXPECT_TRUE(rows[row]["mesh_digest"].is_null());
  // They are the cases', and stay.
  EXPECT_EQ(run(study, at("out")).were_there, 5U);
  // The file is another now, and so is its case.
  write("broken.nii", "no image either");
  EXPECT_EQ(run(study, at("out")).were_there, 4U);
}

// What a header names is in the key, and nothing else that lies beside it.
TEST_F(StudyTest, AnotherVoxelFileIsAnotherCase) {
  const std::string header =
      "ObjectType = Image\nNDims = 3\nDimSize = 6 6 6\nElementSpacing = 2 2 2\nElementType = MET_UCHAR\n"
      "ElementDataFile = voxels.raw\n";
  std::string voxels(216, '\0');
  for (const std::size_t k : {2U, 3U})
    for (const std::size_t j : {2U, 3U})
      for (const std::size_t i : {2U, 3U}) voxels[36 * k + 6 * j + i] = 1;
  write("ball.1.mhd", header);
  write("voxels.raw", voxels);
  const auto keys = [&] {
    const Study study = study_with(R"("volumes":["ball.1.mhd"])", R"({"sizing":{"edge_mm":4}})").value();
    return CaseKeys(study.plan).of(study.cases[0]);
  };
  const std::string key = keys();
  write("ball.2.mhd", header);
  EXPECT_EQ(keys(), key);
  voxels[36] = 1;
  write("voxels.raw", voxels);
  EXPECT_NE(keys(), key);
}

TEST_F(StudyTest, AnotherVoxelFileOfAMaskIsAnotherCase) {
  write("mask.mhd",
        "ObjectType = Image\nNDims = 3\nDimSize = 2 2 2\nElementSpacing = 2 2 2\nElementType = MET_UCHAR\n"
        "ElementDataFile = mask.bytes\n");
  write("mask.bytes", std::string(8, '\1'));
  const Study study =
      study_with(
          "",
          R"({"source":{"phantom":{"kind":"sphere"}},"sizing":{"masks":[{"name":"mask.mhd","edges":[]}]}})")
          .value();
  const std::string key = CaseKeys(study.plan).of(study.cases[0]);
  write("mask.bytes", std::string(8, '\2'));
  EXPECT_NE(CaseKeys(study.plan).of(study.cases[0]), key);
}

TEST_F(StudyTest, WhatAnotherRunHasDoneIsNotUndoneByAFailure) {
  const Study study = study_with(R"("grid":{"sizing.edge_mm":[4,5]})").value();
  run(study, at("other"));
  const std::string record = "/cases/" + CaseKeys(study.plan).of(study.cases[1]) + ".json";
  const std::string done = text_of("other" + record);
  // When the first case has failed, the second has been looked for and not found.
  const auto another_run = [&](const StudyCase& one, const Json&, bool) {
    if (one.number == 1) write("out" + record, done);
  };
  const Status ended =
      run_study(study, {.out = at("out"), .limits = {.time_limit_s = 1e-9}, .on_case = another_run});
  EXPECT_TRUE(ended.ok());
  const std::vector<Json> rows = read_table(study, at("out")).rows;
  EXPECT_EQ(rows[0]["status"], "failed");
  EXPECT_EQ(rows[1]["status"], kHasProcesses ? "done" : "failed");
}

// Where the study lies, and from where it is called, is not in its table.
TEST_F(StudyTest, TheTableIsTheSameFromEverywhere) {
  const std::string text = R"({"study":1,"case":{"sizing":{"edge_mm":4}},"volumes":["none.nii"]})";
  std::filesystem::create_directories(at("here"));
  std::filesystem::create_directories(at("there/deep"));
  std::string first;
  for (const char* folder : {"here", "there/deep"}) {
    const Study study = read_study(write(std::string(folder) + "/study.json", text)).value();
    run(study, at(std::string(folder) + "/out"));
    const StudyTable table = read_table(study, at(std::string(folder) + "/out"));
    EXPECT_EQ(table.rows[0]["reason"], "none.nii: cannot be opened: No such file or directory");
    if (first.empty()) first = csv_of(table.rows);
    EXPECT_EQ(csv_of(table.rows), first);
  }
}

TEST_F(StudyTest, FailuresOfTheMachineAreTriedAgain) {
  const Study study = study_with("").value();
  EXPECT_EQ(run(study, at("out"), {}, 1, {.time_limit_s = 1e-9}).failed, 1U);
  EXPECT_EQ(read_table(study, at("out")).rows[0]["reason"], "given up after the 1e-09 s of --time-limit");
  const Told again = run(study, at("out"));
  EXPECT_EQ(again.done, 1U);
  EXPECT_EQ(again.were_there, 0U);
}

TEST_F(StudyTest, ALinkPromisesWhatTheCaseGave) {
  const Study study = study_with("").value();
  run(study, at("out"));
  const Json row = read_table(study, at("out")).rows[0];
  const Result<Recipe> recipe = recipe_of_link(row["link"].get<std::string>());
  ASSERT_TRUE(recipe.ok()) << recipe.error().message;
  EXPECT_EQ(recipe->expected.digest, row["mesh_digest"]);
  EXPECT_EQ(recipe->expected.tets, row["tets"]);
  EXPECT_EQ(recipe->source.phantom->radius_mm, 8);
}

TEST_F(StudyTest, ARecordThatCannotBeWrittenIsSaid) {
  const Study study = study_with("").value();
  run(study, at("out"), {}, 1, {.time_limit_s = 1e-9});
  const std::string record = at("out/cases/" + CaseKeys(study.plan).of(study.cases[0]) + ".json");
  std::filesystem::remove(record);
  std::filesystem::create_directories(record);
  EXPECT_EQ(run(study, at("out")).not_written, 1U);
  const Status done = run_study(study, {.out = at("out"), .on_case = {}});
  ASSERT_FALSE(done.ok());
  EXPECT_NE(done.error().message.find("the records of 1 cases could not be written (" + record),
            std::string::npos)
      << done.error().message;
}

TEST_F(StudyTest, AFolderThatCannotBeMadeIsSaid) {
  const Study study = study_with("").value();
  write("file", "");
  const Status done = run_study(study, {.out = at("file/out")});
  ASSERT_FALSE(done.ok());
  EXPECT_NE(done.error().message.find("file/out"), std::string::npos) << done.error().message;
}

#ifndef __EMSCRIPTEN__

TEST_F(StudyTest, APlaceThatIsFullIsSaidInTheRow) {
  const Study study = study_with(R"("keep":["vtu"])").value();
  run(study, at("out"));
  const std::string key = CaseKeys(study.plan).of(study.cases[0]), mesh = at("out/files/" + key + ".vtu");
  // A folder where the mesh should be: it cannot be placed there, but the record can.
  std::filesystem::remove(at("out/cases/" + key + ".json"));
  std::filesystem::remove(mesh);
  std::filesystem::create_directories(mesh);
  EXPECT_EQ(run(study, at("out")).failed, 1U);
  const Json row = read_table(study, at("out")).rows[0];
  EXPECT_NE(row["reason"].get<std::string>().find("files/" + key + ".vtu: "), std::string::npos)
      << row["reason"];
  EXPECT_TRUE(row["tets"].is_null());
  std::filesystem::remove(mesh);
  EXPECT_EQ(run(study, at("out")).done, 1U);
}

TEST_F(StudyTest, ADeadProcessIsSaid) {
  std::signal(SIGCHLD, SIG_IGN);  // as a caller may have left it
  const Result<int> id = start_process([] { return raise(SIGKILL); }, 0);
  ASSERT_TRUE(id.ok());
  const std::optional<ProcessEnd> end = wait_for_process();
  ASSERT_TRUE(end);
  EXPECT_EQ(end->id, *id);
  EXPECT_EQ(end->signal, SIGKILL);
  EXPECT_EQ(name_of_signal(end->signal), "signal 9 (Killed)");
  EXPECT_FALSE(wait_for_process());
}

// The address sanitizer's own memory would count.
#ifndef VOXTET_SANITIZE
TEST_F(StudyTest, ACaseBeyondItsMemoryFails) {
  const Study study = study_with(R"("grid":{"sizing.edge_mm":[0.25,5]})").value();
  const Told told = run(study, at("out"), {}, 1, {.memory_mb = 150});
  EXPECT_EQ(told.done, 1U);
  EXPECT_EQ(told.failed, 1U);
  const Json row = read_table(study, at("out")).rows[0];
  EXPECT_NE(row["reason"].get<std::string>().find("with the 150 MB of --memory-mb"), std::string::npos)
      << row["reason"];
}
#endif

#endif

}  // namespace
}  // namespace voxtet
