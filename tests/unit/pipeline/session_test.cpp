#include "pipeline/session.h"

#include <gtest/gtest.h>

#include <regex>

#include "base/digest.h"
#include "io/volume/write_volume.h"
#include "pipeline/report.h"
#include "pipeline/version/engine_version.h"
#include "support/check_tets.h"
#include "unit/pipeline/small_case.h"

namespace voxtet {
namespace {

TEST(EngineVersion, IsTheReleaseAndADigestOfTheSources) {
  EXPECT_TRUE(std::regex_match(engine_version(), std::regex("[0-9]+\\.[0-9]+\\.[0-9]+\\+[0-9a-f]{12}")))
      << engine_version();
}

TEST(Session, TakesAVolumeToAMeasuredMesh) {
  Session session;
  ASSERT_TRUE(session.set_recipe(test::small_case()).ok());
  RunContext ctx;
  const Status done = session.run(Stage::kQuality, ctx);
  ASSERT_TRUE(done.ok()) << done.error().message;
  test::check_tets(*session.mesh());
  EXPECT_TRUE(session.quality()->passed());
  const nlohmann::json report = report_json(session);
  EXPECT_EQ(report["digest"], digest_of(*session.mesh()));
  EXPECT_EQ(report["tets"], session.mesh()->tets.size());
  EXPECT_EQ(report["stages"].size(), static_cast<std::size_t>(Stage::kQuality) + 1);
  EXPECT_EQ(report["fidelity"]["labels"].size(), 3U);
  const nlohmann::json& topology = report["fidelity"]["topology"];
  ASSERT_EQ(topology["labels"].size(), 3U);
  for (const nlohmann::json& label : topology["labels"]) {
    EXPECT_EQ(label["components"], nlohmann::json({1, 1})) << label;
    EXPECT_EQ(label["euler"][1], 2 * (1 + label["cavities"][1].get<int>() - label["handles"][1].get<int>()));
  }
  EXPECT_FALSE(topology["contacts"]["after"].empty());
  EXPECT_EQ(topology["differences"].empty(), topology["contacts"]["before"] == topology["contacts"]["after"]);
}

TEST(Session, MeshesThickSlicesInterpolatedAndMeasuresAgainstTheSlices) {
  Session session;
  Recipe recipe = test::small_case();
  recipe.source.phantom->spacing_mm = {1, 1, 4};
  recipe.source.phantom->rotation_deg.setZero();
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  RunContext ctx;
  const Status done = session.run(Stage::kQuality, ctx);
  ASSERT_TRUE(done.ok()) << done.error().message;
  EXPECT_EQ(session.selected_volume()->size, session.source_volume()->size);
  EXPECT_EQ(session.volume()->size[2], 3 * session.source_volume()->size[2]);
  EXPECT_FALSE(session.record(Stage::kVolume).notes.empty());
  const nlohmann::json report = report_json(session);
  EXPECT_EQ(report["stages"][0]["counts"]["prepared"]["size"][2], session.volume()->size[2]);
  for (const LabelFidelity& label : session.quality()->labels) {
    std::uint64_t voxels = 0;
    for (const Label one : session.selected_volume()->labels) voxels += one == label.label;
    EXPECT_EQ(label.voxels, voxels);
    EXPECT_GT(label.dice, 0.85);
  }

  recipe.volume.slice_ratio = 0;
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  ASSERT_TRUE(session.run(Stage::kVolume, ctx).ok());
  EXPECT_EQ(session.volume(), session.source_volume()) << "one copy is enough";
  EXPECT_EQ(session.source_digest(), digest_of(*session.source_volume()));
}

TEST(Session, ReportsSizesWithinTheBodyAndWhatIsAroundEachLabel) {
  Session session;
  Recipe recipe = test::small_case();
  recipe.sizing.edge_mm = 2;
  recipe.sizing.gradation = 0.5;
  recipe.sizing.edge_max_mm = 40;
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  RunContext ctx;
  ASSERT_TRUE(session.run(Stage::kSizing, ctx).ok());
  const std::vector<float>& h = session.sizing()->h_mm;
  const nlohmann::json report = report_json(session);
  const nlohmann::json& sizes = report["stages"].back()["counts"];
  EXPECT_NEAR(sizes["max_mm"].get<double>(), 2, 0.3);
  EXPECT_GT(*std::max_element(h.begin(), h.end()), 1.2 * sizes["max_mm"].get<double>()) << "outside it grows";
  const nlohmann::json& around = report["stages"][0]["counts"]["surroundings"];
  ASSERT_EQ(around.size(), report["source"]["labels"].size());
  double share = 0;
  for (const nlohmann::json& contact : around[0]["contacts"]) share += contact["share"].get<double>();
  EXPECT_NEAR(share, 1, 1e-12);
}

TEST(Session, ReportsTheSlicesThatItMovesAndTransfersLabelsFromThem) {
  Session session;
  Recipe recipe = test::small_case();
  recipe.source.phantom->spacing_mm = {1, 1, 4};
  recipe.source.phantom->rotation_deg.setZero();
  recipe.volume.align.slice_shifts = {{3, 2, -1}};
  recipe.transfer.labels = {3};
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  RunContext ctx;
  const Status done = session.run(Stage::kTransfer, ctx);
  ASSERT_TRUE(done.ok()) << done.error().message;
  const nlohmann::json report = report_json(session);
  const nlohmann::json& alignment = report["stages"][0]["counts"]["alignment"];
  EXPECT_EQ(alignment["axis"], 2);
  ASSERT_EQ(alignment["slices"].size(), static_cast<std::size_t>(session.source_volume()->size[2]));
  EXPECT_EQ(alignment["slices"][3]["move_mm"], nlohmann::json({2.0, -1.0}));
  EXPECT_TRUE(alignment["slices"][3]["given"]);
  EXPECT_LT(alignment["slices"][3]["dice_after"], alignment["slices"][3]["dice_before"]);
  EXPECT_GT(report["transfer"][0]["by_centroid"]["dice"], 0.9);
}

TEST(Session, MergesGroupsOfLabels) {
  Session session;
  Recipe recipe = test::small_case();
  recipe.merge = {{3, 1}};
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  RunContext ctx;
  ASSERT_TRUE(session.run(Stage::kVolume, ctx).ok());
  const auto counts = count_labels(*session.volume());
  ASSERT_EQ(counts.size(), 2U);
  EXPECT_EQ(counts[0].first, 1);
  recipe.merge = {{3, 9}};
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  const Status done = session.run(Stage::kVolume, ctx);
  ASSERT_FALSE(done.ok());
  EXPECT_EQ(done.error().code, ErrorCode::kUsage);
  EXPECT_EQ(session.volume(), nullptr);
}

TEST(Session, ReusesWhatDidNotChange) {
  Session session;
  Recipe recipe = test::small_case();
  session.set_recipe(recipe);
  RunContext ctx;
  ASSERT_TRUE(session.run(Stage::kQuality, ctx).ok());
  const std::string first = digest_of(*session.mesh());
  recipe.tetra.radius_edge = 1.8;
  session.set_recipe(recipe);
  std::vector<std::string> ran;
  ctx.on_progress = [&](const std::string& stage, double fraction) {
    if (fraction == 0 && (ran.empty() || ran.back() != stage)) ran.push_back(stage);
  };
  ASSERT_TRUE(session.run(Stage::kQuality, ctx).ok());
  EXPECT_EQ(ran, (std::vector<std::string>{"tetra", "optimise", "transfer", "quality"}));
  EXPECT_TRUE(session.cached(Stage::kRemesh));
  recipe.tetra.radius_edge = FillParams{}.radius_edge;
  session.set_recipe(recipe);
  ASSERT_TRUE(session.run(Stage::kOptimise, ctx).ok());
  EXPECT_EQ(digest_of(*session.mesh()), first);
  EXPECT_TRUE(session.cached(Stage::kOptimise)) << "undo finds its mesh again";
  EXPECT_NE(session.quality(), nullptr) << "and the evidence of that mesh";
  recipe.tetra.radius_edge = 1.7;
  session.set_recipe(recipe);
  EXPECT_EQ(session.mesh(), nullptr);
  EXPECT_EQ(session.quality(), nullptr) << "the quality of another mesh must not stay";
}

TEST(Session, KeepsNothingToSpareWhereNoMemoryIsSetAside) {
  Session session(0);
  Recipe recipe = test::small_case();
  session.set_recipe(recipe);
  RunContext ctx;
  ASSERT_TRUE(session.run(Stage::kSmooth, ctx).ok());
  recipe.smooth.iterations += 1;
  session.set_recipe(recipe);
  ASSERT_TRUE(session.run(Stage::kSmooth, ctx).ok());
  EXPECT_TRUE(session.cached(Stage::kSurface));
  recipe.smooth.iterations -= 1;
  session.set_recipe(recipe);
  ASSERT_TRUE(session.run(Stage::kSmooth, ctx).ok());
  EXPECT_FALSE(session.cached(Stage::kSmooth));
}

TEST(Session, TransfersLabelsOfTheWholeImageInAMeshOfMergedOnes) {
  Session session;
  Recipe recipe;
  PhantomParams& phantom = recipe.source.phantom.emplace();
  phantom.kind = PhantomKind::kBiventricle;
  phantom.scar = true;
  phantom.spacing_mm = Eigen::Vector3d::Constant(2);
  recipe.labels = {1, 2, 5, 6};
  recipe.merge = {{1, 2, 5, 6}};
  recipe.sizing.edge_mm = 3;
  recipe.transfer.labels = {5, 6, 3};
  session.set_recipe(recipe);
  RunContext ctx;
  const Status done = session.run(Stage::kQuality, ctx);
  ASSERT_TRUE(done.ok()) << done.error().message;
  ASSERT_EQ(session.transfer()->labels.size(), 3U);
  const nlohmann::json report = report_json(session);
  ASSERT_EQ(report["transfer"].size(), 3U);
  for (const int i : {1, 2}) {
    const nlohmann::json& label = report["transfer"][static_cast<std::size_t>(i)];
    // A few hundred voxels, many at the surface of the wall, which is smoothed.
    EXPECT_NEAR(label["by_fraction"]["error_percent"].get<double>(), 0, 4) << label;
    EXPECT_GT(label["by_majority"]["dice"].get<double>(), 0.85) << label;
  }
  EXPECT_LT(report["transfer"][0]["by_fraction"]["error_percent"].get<double>(), -80)
      << "blood was not meshed: little of it lies in the mesh";

  const std::string mesh = digest_of(*session.mesh());
  recipe.transfer.labels = {6};
  session.set_recipe(recipe);
  ASSERT_TRUE(session.run(Stage::kQuality, ctx).ok());
  EXPECT_TRUE(session.cached(Stage::kTetra));
  EXPECT_FALSE(session.cached(Stage::kTransfer));
  EXPECT_EQ(session.transfer()->labels.size(), 1U);
  EXPECT_EQ(digest_of(*session.mesh()), mesh);
}

TEST(Session, RefusesToTransferALabelThatTheImageDoesNotHold) {
  Session session;
  Recipe recipe = test::small_case();
  RunContext ctx;
  const auto expect_refused = [&](Stage last = Stage::kQuality) {
    recipe.transfer.labels = {77};
    session.set_recipe(recipe);
    const Status done = session.run(last, ctx);
    ASSERT_FALSE(done.ok());
    EXPECT_EQ(done.error().code, ErrorCode::kUsage);
    EXPECT_EQ(done.error().stage, "transfer");
  };
  expect_refused();
  EXPECT_EQ(session.surface(), nullptr) << "refused before anything is made";
  recipe.transfer.labels = {};
  session.set_recipe(recipe);
  ASSERT_TRUE(session.run(Stage::kQuality, ctx).ok());
  expect_refused();
  EXPECT_NE(session.mesh(), nullptr) << "what is made stays";
  expect_refused(Stage::kOptimise);
  expect_refused(Stage::kSurface);
}

TEST(Session, TreatsAFileLikeThePhantomItWasWrittenFrom) {
  Session by_phantom, by_file;
  RunContext ctx;
  Recipe recipe = test::small_case();
  recipe.source.phantom->rotation_deg.setZero();  // NIfTI keeps single precision only
  by_phantom.set_recipe(recipe);
  ASSERT_TRUE(by_phantom.run(Stage::kTetra, ctx).ok());
  const Result<Bytes> bytes = write_nifti(*by_phantom.source_volume(), true);
  ASSERT_TRUE(bytes.ok());
  ASSERT_TRUE(by_file.load_volume({"boxes.nii.gz", *bytes, {}}).ok());
  recipe.source = by_file.recipe().source;
  ASSERT_TRUE(by_file.set_recipe(recipe).ok());
  ASSERT_TRUE(by_file.run(Stage::kTetra, ctx).ok());
  EXPECT_EQ(digest_of(*by_file.mesh()), digest_of(*by_phantom.mesh()));
}

TEST(Session, RefusesARecipeMadeForAnotherVolume) {
  Session session;
  RunContext ctx;
  session.set_recipe(test::small_case());
  session.run(Stage::kVolume, ctx);
  const Bytes bytes = *write_nifti(*session.source_volume(), false);
  ASSERT_TRUE(session.load_volume({"a.nii", bytes, {}}).ok());
  Recipe other = session.recipe();
  other.source.file->sha256 = std::string(64, '0');
  const Status set = session.set_recipe(other);
  ASSERT_FALSE(set.ok());
  EXPECT_EQ(set.error().code, ErrorCode::kBadInput);
  EXPECT_NE(set.error().message.find("different volumes"), std::string::npos);
}

TEST(Session, KeepsEverythingWhenAFileIsDamaged) {
  Session session;
  RunContext ctx;
  session.set_recipe(test::small_case());
  ASSERT_TRUE(session.run(Stage::kSmooth, ctx).ok());
  const std::string before = digest_of(*session.smooth());
  const Bytes rubbish(1000, 7);
  EXPECT_FALSE(session.load_volume({"rubbish.nii", rubbish, {}}).ok());
  ASSERT_NE(session.smooth(), nullptr);
  EXPECT_EQ(digest_of(*session.smooth()), before);
  EXPECT_TRUE(session.recipe().source.phantom.has_value());
}

TEST(Session, SaysWhatIsMissing) {
  Session session;
  RunContext ctx;
  EXPECT_EQ(session.run(Stage::kSurface, ctx).error().code, ErrorCode::kUsage);
  Recipe recipe;
  recipe.source.file = FileSource{"heart.nii", ""};
  session.set_recipe(recipe);
  EXPECT_NE(session.run(Stage::kSurface, ctx).error().message.find("heart.nii"), std::string::npos);
  EXPECT_FALSE(stage_of("nothing").ok());
}

TEST(Session, StopsWhenCancelledAndGoesOnLater) {
  Session session;
  session.set_recipe(test::small_case());
  RunContext ctx;
  bool stop = false;
  ctx.on_cancelled = [&] { return stop; };
  ctx.on_progress = [&](const std::string& stage, double) { stop = stage == "remesh"; };
  const Status cancelled = session.run(Stage::kQuality, ctx);
  ASSERT_FALSE(cancelled.ok());
  EXPECT_EQ(cancelled.error().code, ErrorCode::kCancelled);
  EXPECT_NE(session.sizing(), nullptr);
  EXPECT_EQ(session.remeshed(), nullptr);
  RunContext free_run;
  EXPECT_TRUE(session.run(Stage::kQuality, free_run).ok());
}

TEST(Session, KeepsTheFilledMeshWhenOptimisationIsCancelled) {
  Session session;
  Recipe recipe = test::small_case();
  recipe.tetra.backend = TetBackend::kTetgen;  // which keeps every triangle of the surface
  session.set_recipe(recipe);
  RunContext ctx;
  bool stop = false;
  ctx.on_cancelled = [&] { return stop; };
  ctx.on_progress = [&](const std::string& stage, double) { stop = stage == "optimise"; };
  ASSERT_FALSE(session.run(Stage::kQuality, ctx).ok());
  ASSERT_NE(session.mesh(), nullptr);
  EXPECT_EQ(session.mesh(), session.filled());
  test::check_tets(*session.mesh(), *session.remeshed());
  RunContext free_run;
  ASSERT_TRUE(session.run(Stage::kOptimise, free_run).ok());
  EXPECT_TRUE(session.cached(Stage::kTetra));
  test::check_tets(*session.mesh());
  EXPECT_GT(test::smallest_dihedral_deg(*session.mesh()), test::smallest_dihedral_deg(*session.filled()));
  EXPECT_FALSE(session.record(Stage::kOptimise).notes.empty());
}

}  // namespace
}  // namespace voxtet
