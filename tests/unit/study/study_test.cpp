#include "study/study.h"

#include "study_folder.h"

namespace voxtet {
namespace {

TEST_F(StudyTest, FormsEveryCombination) {
  const Result<Study> study = study_with(
      R"("title":"Spheres","list":[{"name":"plain","set":{}},{"name":"rough","set":{"smooth.iterations":0}}],)"
      R"("grid":{"sizing.edge_mm":[3,4],"sizing.gradation":[0.2,0.3,0.4]},"stages":["smooth","quality"],"keep":["vtu"])");
  ASSERT_TRUE(study.ok()) << study.error().message;
  EXPECT_EQ(study->title, "Spheres");
  EXPECT_EQ(study->plan.stages, (std::vector<Stage>{Stage::kSmooth, Stage::kQuality}));
  ASSERT_EQ(study->cases.size(), 12U);
  const StudyCase& last = study->cases.back();
  EXPECT_EQ(last.number, 12U);
  EXPECT_EQ(last.name, "rough, sizing.edge_mm 4, sizing.gradation 0.4");
  EXPECT_EQ(last.recipe.sizing.edge_mm, 4);
  EXPECT_EQ(last.recipe.sizing.gradation, 0.4);
  EXPECT_EQ(last.varied,
            (FieldValues{{"change", "rough"}, {"sizing.edge_mm", 4}, {"sizing.gradation", 0.4}}));
}

TEST_F(StudyTest, TakesVolumesByPattern) {
  for (const char* name : {"b.nii", "a.nii", "c.nrrd", ".d.nii"}) write(name, "");
  const Result<Study> study =
      study_with(R"("volumes":["*.nii","c.nrrd","missing.nii"])", R"({"sizing":{"edge_mm":4}})");
  ASSERT_TRUE(study.ok()) << study.error().message;
  ASSERT_EQ(study->cases.size(), 4U);
  EXPECT_EQ(study->cases[0].volume_path, at("a.nii"));
  EXPECT_EQ(study->cases[1].name, "b.nii");
  EXPECT_EQ(study->cases[2].recipe.source.file->name, "c.nrrd");
  EXPECT_EQ(study->cases[3].name, "missing.nii");  // becomes a row that says so
  const Result<Study> none = study_with(R"("volumes":["*.mha"])");
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().message.find("volumes: found no file"), std::string::npos);
}

TEST_F(StudyTest, TellsVolumesOfOneNameApart) {
  for (const char* patient : {"v1", "v2", "w"}) {
    std::filesystem::create_directories(at(patient));
    write(std::string(patient) + "/seg[1].nii", "");
  }
  const Result<Study> study =
      study_with(R"("volumes":["v*/seg*.nii","w/seg[1].nii"])", R"({"sizing":{"edge_mm":4}})");
  ASSERT_TRUE(study.ok()) << study.error().message;
  ASSERT_EQ(study->cases.size(), 3U);
  EXPECT_EQ(study->cases[0].name, "v1/seg[1].nii");
  EXPECT_EQ(study->cases[1].varied, (FieldValues{{"source.file", "v2/seg[1].nii"}}));
  EXPECT_EQ(study->cases[1].recipe.source.file->name, "seg[1].nii");
  EXPECT_EQ(study->cases[2].volume_path, at("w/seg[1].nii"));
}

TEST_F(StudyTest, TakesACaseFileFromElsewhere) {
  std::filesystem::create_directories(at("cases"));
  write("cases/ball.json", kSphere);
  const Result<Study> study = read_study(write("study.json", R"({"study":1,"case":"cases/ball.json"})"));
  ASSERT_TRUE(study.ok()) << study.error().message;
  EXPECT_EQ(study->plan.folder, at("cases"));
  EXPECT_EQ(study->title, "study");
  EXPECT_EQ(study->cases[0].recipe.source.phantom->radius_mm, 8);
  EXPECT_EQ(study->cases[0].name, "case");
}

TEST_F(StudyTest, SaysWhichFieldIsWrong) {
  const std::pair<const char*, const char*> wrong[] = {
      {R"("grids":{})", "found the field grids, expected some of"},
      {R"("grid":{"sizing.edge":[1]})", "grid: sizing.edge: unknown field"},
      {R"("grid":{"sizing.edge_mm":2})", "grid.sizing.edge_mm: found 2, expected a list of values"},
      {R"("grid":{"sizing.edge_mm":[-2]})", "sizing.edge_mm"},
      {R"("list":[{"name":"a"}])", "list[0]: found"},
      {R"("list":[{"name":"a","set":{}},{"name":"a","set":{}}])", "list[1].name: found a twice"},
      {R"("list":[{"name":"a","set":{"sizing.edge_mm":"x"}}])", "list, a: sizing.edge_mm"},
      {R"("cohort":{"hearts":0})", "cohort.hearts: found 0"},
      {R"("cohort":{"hearts":1.5})", "cohort.hearts: found 1.5"},
      {R"("cohort":{"hearts":2,"seed":-1})", "cohort.seed: found -1"},
      {R"("cohort":{"hearts":2,"draw":[]})", "cohort.draw: found []"},
      {R"("cohort":{"hearts":2,"draw":{"source.phantom.scale":{"from":100,"to":200}}})",
       "cohort, heart 1: source.phantom.scale"},
      {R"("cohort":{"hearts":200000})", "expected a whole number from 1 to 100000"},
      {R"("list":[{"name":"a","set":{"sizing.edge_mm":3}}],"grid":{"sizing.edge_mm":[2]})",
       "grid: found sizing.edge_mm, which list sets too"},
      {R"("cohort":{"hearts":2,"draw":{"sizing.edge_mm":{"from":2,"to":3}}},"grid":{"sizing.edge_mm":[2]})",
       "which cohort.draw sets too"},
      {R"("stages":["eikonal"])", "stages: found a simulation"},
      {R"("keep":["../vtu"])", "keep: found \"../vtu\", expected an ending"},
      {R"("stages":["mesh"])", "stages: "},
      {R"("stages":"quality")", "stages: found \"quality\", expected a list of texts"},
      {R"("keep":["jpg"])", "keep: "},
      {R"("keep":["vtu"],"stages":["sizing"])", "keep: found vtu, a mesh"},
      {R"("title":3)", "title: found 3"},
  };
  for (const auto& [fields, message] : wrong) {
    const Result<Study> study = study_with(fields);
    ASSERT_FALSE(study.ok()) << fields;
    EXPECT_EQ(study.error().message.find(at("study.json") + ": "), 0U) << study.error().message;
    EXPECT_NE(study.error().message.find(message), std::string::npos) << study.error().message;
  }
  for (const auto& [text, message] : {std::pair{"{", "found no JSON"},
                                      {"{}", "study: found none, expected 1"},
                                      {R"({"study":1,})", "column 12"},
                                      {R"({"study":2})", "study: found 2"},
                                      {R"({"study":1})", "case: found none"},
                                      {R"({"study":1,"case":{}})", "case.source: found none"},
                                      {"[]", "expected an object"}}) {
    const Result<Study> study = read_study(write("study.json", text));
    ASSERT_FALSE(study.ok()) << text;
    EXPECT_NE(study.error().message.find(message), std::string::npos) << study.error().message;
  }
}

}  // namespace
}  // namespace voxtet
