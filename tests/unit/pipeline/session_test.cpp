#include "pipeline/session.h"

#include <gtest/gtest.h>

#include <regex>

#include "base/digest.h"
#include "io/volume/write_volume.h"
#include "pipeline/report.h"
#include "pipeline/version/engine_version.h"
#include "support/check_tets.h"

namespace voxtet {
namespace {

Recipe small_case() {
  Recipe recipe;
  PhantomParams& phantom = recipe.source.phantom.emplace();
  phantom.kind = PhantomKind::kNestedBoxes;
  phantom.radius_mm = 10;
  phantom.spacing_mm = Eigen::Vector3d::Constant(1);
  phantom.rotation_deg = {20, 30, 40};
  recipe.sizing.edge_mm = 3;
  return recipe;
}

TEST(EngineVersion, IsTheReleaseAndADigestOfTheSources) {
  EXPECT_TRUE(std::regex_match(engine_version(), std::regex("[0-9]+\\.[0-9]+\\.[0-9]+\\+[0-9a-f]{12}")))
      << engine_version();
}

TEST(Session, TakesAVolumeToAMeasuredMesh) {
  Session session;
  ASSERT_TRUE(session.set_recipe(small_case()).ok());
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

/// A cube in 6 x 6 x 6 voxels; `named`: and a second segment, which has no voxels.
Bytes cube_with_empty_segment(bool named) {
  std::string text =
      "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 6 6 6\nspace: right-anterior-superior\n"
      "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\nencoding: raw\n"
      "Segment0_Name:=cube\nSegment0_LabelValue:=1\n";
  if (named) text += "Segment1_Name:=scar\nSegment1_LabelValue:=2\n";
  text += "\n";
  for (int v = 0; v < 216; ++v) {
    const auto inside = [](int i) { return i > 0 && i < 5; };
    text += static_cast<char>(inside(v % 6) && inside(v / 6 % 6) && inside(v / 36));
  }
  return {text.begin(), text.end()};
}

TEST(Session, WarnsOfWhatTheReaderFoundAsLongAsTheFileIsTheSource) {
  const Bytes with = cube_with_empty_segment(true), without = cube_with_empty_segment(false);
  const std::vector<std::string> warning{"volume: a.nrrd: segment scar (label 2) has no voxels"};
  Session session;
  RunContext ctx;
  // The two files have the same labels, and so the same digest.
  for (const bool warned : {false, true, false}) {
    ASSERT_TRUE(session.load_volume({"a.nrrd", warned ? with : without, {}}).ok());
    ASSERT_TRUE(session.run(Stage::kVolume, ctx).ok());
    Recipe recipe = session.recipe();
    recipe.labels = {1};
    ASSERT_TRUE(session.set_recipe(recipe).ok());
    for (const char* times : {"once", "again, from the cache"}) {
      ASSERT_TRUE(session.run(Stage::kVolume, ctx).ok()) << times;
      EXPECT_EQ(session.warnings(), warned ? warning : std::vector<std::string>{}) << times;
      EXPECT_EQ(volume_json(session)["warnings"], session.warnings()) << times;
    }
  }
  Recipe recipe = session.recipe();
  recipe.sizing.masks.push_back({"mask.nrrd", {}, {{1, 1.0}}});
  ASSERT_TRUE(session.load_mask({"mask.nrrd", with, {}}).ok());
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  ASSERT_TRUE(session.run(Stage::kSizing, ctx).ok());
  EXPECT_EQ(session.warnings(),
            std::vector<std::string>{"sizing: mask.nrrd: segment scar (label 2) has no voxels"});
}

/// Two boxes in layers of their own, the later one over the whole of the earlier one.
Bytes layered_boxes() {
  std::string text =
      "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 2 8 8 8\nencoding: raw\nspace: RAS\n"
      "space directions: none (1,0,0) (0,1,0) (0,0,1)\nSegment0_Name:=inner\nSegment0_Layer:=0\n"
      "Segment1_Name:=outer\nSegment1_Layer:=1\n\n";
  for (int v = 0; v < 512; ++v) {
    const auto inside = [v](int from, int to) {
      for (const int i : {v % 8, v / 8 % 8, v / 64})
        if (i < from || i >= to) return false;
      return true;
    };
    text += static_cast<char>(inside(3, 5));
    text += static_cast<char>(inside(1, 7));
  }
  return {text.begin(), text.end()};
}

TEST(Session, ReadsAVolumeByTheOptionsOfItsSource) {
  const Bytes file = layered_boxes();
  const auto voxels_of_inner = [](const Session& session) {
    const std::vector<Label>& labels = session.source_volume()->labels;
    return std::count(labels.begin(), labels.end(), Label{1});
  };
  Session session;
  RunContext ctx;
  ASSERT_TRUE(session.load_volume({"a.seg.nrrd", file, {}}).ok());
  ASSERT_TRUE(session.run(Stage::kVolume, ctx).ok());
  EXPECT_EQ(voxels_of_inner(session), 0);
  EXPECT_NE(session.warnings()[0].find("SEGMENT LOST: segment inner"), std::string::npos);
  Recipe recipe = session.recipe();
  recipe.source.file->sha256.clear();
  recipe.source.read.precedence = {"inner"};
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  const Status stale = session.run(Stage::kVolume, ctx);
  ASSERT_FALSE(stale.ok());
  EXPECT_EQ(stale.error().code, ErrorCode::kUsage);
  EXPECT_EQ(
      stale.error().message,
      "source: found a unit, precedence, background or frame by which the volume was not read, expected it "
      "to be loaded again");
  ASSERT_TRUE(session.load_volume({"a.seg.nrrd", file, {}}, recipe.source.read).ok());
  ASSERT_TRUE(session.run(Stage::kVolume, ctx).ok());
  EXPECT_EQ(voxels_of_inner(session), 8);
  EXPECT_EQ(session.recipe().source.read, recipe.source.read);
}

TEST(Session, MeshesThickSlicesInterpolatedAndMeasuresAgainstTheSlices) {
  Session session;
  Recipe recipe = small_case();
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

TEST(Session, MergesGroupsOfLabels) {
  Session session;
  Recipe recipe = small_case();
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
  Recipe recipe = small_case();
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
  Recipe recipe = small_case();
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
  Recipe recipe = small_case();
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
  Recipe recipe = small_case();
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
  session.set_recipe(small_case());
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
  session.set_recipe(small_case());
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
  session.set_recipe(small_case());
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
  Recipe recipe = small_case();
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

/// Label 1 everywhere in the space of small_case.
Bytes painted_everywhere() {
  LabelVolume mask;
  mask.size = {2, 2, 2};
  mask.index_to_mm.diagonal().head<3>().setConstant(100);
  mask.index_to_mm.topRightCorner<3, 1>().setConstant(-50);
  mask.labels.assign(8, 1);
  return write_nifti(mask, false).value();
}

void expect_sizing_error(Session& session, const std::string& part) {
  RunContext ctx;
  const Status done = session.run(Stage::kSizing, ctx);
  ASSERT_FALSE(done.ok()) << part;
  EXPECT_EQ(done.error().code, ErrorCode::kBadInput);
  EXPECT_NE(done.error().message.find(part), std::string::npos) << done.error().message;
}

TEST(Session, TakesMasksByNameAndDigest) {
  Session session;
  Recipe recipe = small_case();
  recipe.sizing.masks.resize(1);
  recipe.sizing.masks[0].name = "paint.nii";
  recipe.sizing.masks[0].edges = {{1, 1.25}};
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  expect_sizing_error(session, "sizing.masks[0]: the file 'paint.nii' has not been loaded");

  const Bytes bytes = painted_everywhere();
  ASSERT_TRUE(session.load_mask({"paint.nii", bytes, {}}).ok());
  RunContext ctx;
  ASSERT_TRUE(session.run(Stage::kSizing, ctx).ok());
  EXPECT_NEAR(session.sizing()->at({0, 0, 0}), 1.25, 1e-6);

  recipe.sizing.masks[0].sha256 = std::string(64, 'a');
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  expect_sizing_error(session, "'paint.nii' of digest aaaaaaaaaaaa...");
}

TEST(Session, AnotherSizeImageOfTheSameNameIsANewField) {
  Session session;
  Recipe recipe = small_case();
  recipe.sizing.images.resize(1);
  recipe.sizing.images[0].name = "sizes.nii";
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  expect_sizing_error(session, "sizing.images[0]: the file 'sizes.nii' has not been loaded");
  ScalarVolume image;
  image.size = {2, 2, 2};
  image.index_to_mm.diagonal().head<3>().setConstant(100);
  image.index_to_mm.topRightCorner<3, 1>().setConstant(-50);
  for (const float size : {1.5F, 2.5F}) {
    image.values.assign(8, size);
    const Bytes bytes = write_nifti(image, true).value();
    ASSERT_TRUE(session.load_size_image({"sizes.nii", bytes, {}}).ok());
    RunContext ctx;
    ASSERT_TRUE(session.run(Stage::kSizing, ctx).ok());
    EXPECT_NEAR(session.sizing()->at({0, 0, 0}), size, 1e-6);
  }
}

}  // namespace
}  // namespace voxtet
