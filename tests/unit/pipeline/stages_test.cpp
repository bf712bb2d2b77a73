// The table of stages, and a session that works in parts.
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "base/digest.h"
#include "physics/diffusion/diffusion.h"
#include "pipeline/report.h"
#include "pipeline/result_store.h"
#include "pipeline/session.h"
#include "pipeline/simulations/diffusion_stage.h"
#include "support/labelled_mesh.h"

namespace voxtet {
namespace {

Recipe diffusing_ball() {
  Recipe recipe;
  PhantomParams& phantom = recipe.source.phantom.emplace();
  phantom.kind = PhantomKind::kNestedBoxes;
  phantom.radius_mm = 8;
  phantom.spacing_mm = Eigen::Vector3d::Constant(1);
  recipe.sizing.edge_mm = 3;
  recipe.physics.emplace().diffusion.emplace();
  recipe.physics->diffusion->from = 1;
  return recipe;
}

TEST(StageTable, NamesOnlyStagesThatComeBefore) {
  int number = 0;
  std::set<std::string_view> names;
  for (const StageSpec& spec : stage_table()) {
    EXPECT_EQ(static_cast<int>(spec.stage), number++);
    EXPECT_TRUE(names.insert(spec.name).second) << spec.name;
    EXPECT_NE(spec.run == nullptr, spec.start == nullptr) << spec.name;
    EXPECT_NE(spec.counts, nullptr) << spec.name;
    for (const Stage input : spec.inputs) EXPECT_LT(input, spec.stage) << spec.name;
  }
}

TEST(StageTable, ReadsFieldsThatTheRecipeHas) {
  Recipe recipe = diffusing_ball();
  recipe.source.read.threshold.emplace();
  recipe.source.inlined.emplace();
  recipe.sizing.thickness.resize(1);
  recipe.physics->anatomy.emplace();
  recipe.physics->fibres.emplace().septum.emplace();
  recipe.physics->monodomain.emplace();
  recipe.physics->mechanics.emplace();
  const nlohmann::json fields = recipe_to_json(recipe);
  for (const StageSpec& spec : stage_table())
    for (const std::string_view path : spec.reads)
      EXPECT_EQ(fields_text(fields, {path}).find("null"), std::string::npos)
          << spec.name << " reads " << path;
}

TEST(StageTable, AChangedFieldIsANewKeyForItsStageAndThoseAfterIt) {
  const Recipe recipe = diffusing_ball();
  Recipe other = recipe;
  other.optimise.rounds += 1;
  const StageKeys before = keys_of(recipe, {}), after = keys_of(other, {});
  for (int i = 0; i < kStageCount; ++i)
    EXPECT_EQ(before[static_cast<std::size_t>(i)] == after[static_cast<std::size_t>(i)],
              i < static_cast<int>(Stage::kOptimise))
        << name_of(static_cast<Stage>(i));
}

TEST(ResultStore, KeepsWhatIsAskedForAndOfTheRestWhatWasUsedLast) {
  ResultStore store(10);
  StageKeys keys;
  const auto keep = [&](const std::string& key, std::size_t bytes) {
    auto result = std::make_shared<StageResult>();
    result->bytes = bytes;
    result->record.key = key;
    store.keep(Stage::kSurface, result);
  };
  keep("asked", 100);
  keep("old", 6);
  keep("new", 6);
  EXPECT_NE(store.find(Stage::kSurface, "old"), nullptr);
  EXPECT_EQ(store.find(Stage::kSmooth, "old"), nullptr);
  keys[static_cast<std::size_t>(Stage::kSurface)] = "asked";
  store.trim(keys);
  EXPECT_NE(store.find(Stage::kSurface, "asked"), nullptr);
  EXPECT_NE(store.find(Stage::kSurface, "old"), nullptr) << "used after the newer one";
  EXPECT_EQ(store.find(Stage::kSurface, "new"), nullptr);
  EXPECT_EQ(store.bytes(), 106U);
}

TEST(Session, WorksInPartsAndKeepsTheMeshWhenARunIsGivenUp) {
  Session session;
  ASSERT_TRUE(session.set_recipe(diffusing_ball()).ok());
  std::vector<double> frames;
  RunContext ctx;
  ctx.on_snapshot = [&](const Snapshot& frame) { frames.push_back(frame.time_ms); };
  session.begin(Stage::kDiffusion);
  while (frames.size() < 3) {
    const Result<RunProgress> progress = session.advance(0, ctx);
    ASSERT_TRUE(progress.ok()) << progress.error().message;
    ASSERT_FALSE(progress->done) << "the diffusion is cut into steps";
  }
  session.end();
  EXPECT_FALSE(session.advance(0, ctx).ok());
  EXPECT_EQ(session.diffusion(), nullptr);
  ASSERT_NE(session.mesh(), nullptr);
  const TetMesh* mesh = session.mesh();

  frames.clear();
  ASSERT_TRUE(session.run(Stage::kDiffusion, ctx).ok());
  EXPECT_TRUE(session.cached(Stage::kOptimise));
  EXPECT_EQ(session.mesh(), mesh);
  EXPECT_EQ(session.diffusion()->times_ms, frames);
  EXPECT_EQ(frames.front(), 0);
  EXPECT_EQ(frames.back(), 100);
  EXPECT_EQ(report_json(session)["stages"].back()["digest"], session.diffusion()->digest);
}

TEST(Session, GivesTheSameFramesInOnePartAndInMany) {
  const auto digest = [](double budget_ms) {
    Session session;
    EXPECT_TRUE(session.set_recipe(diffusing_ball()).ok());
    RunContext ctx;
    session.begin(Stage::kDiffusion);
    for (;;) {
      const Result<RunProgress> progress = session.advance(budget_ms, ctx);
      EXPECT_TRUE(progress.ok());
      if (!progress.ok() || progress->done) break;
    }
    return session.diffusion()->digest;
  };
  EXPECT_EQ(digest(0), digest(std::numeric_limits<double>::infinity()));
}

TEST(DiffusionStage, ReturnsInsideOfAStepWhereTheMeshIsLarge) {
  const auto mesh = std::make_shared<const TetMesh>(test::kuhn_cube(24));
  const LoadedFiles files;
  StageInputs inputs(files);
  inputs.add(Stage::kOptimise, std::any(mesh));
  Recipe recipe = diffusing_ball();
  recipe.physics->diffusion = DiffusionParams{7, 10, 3, 1, 1};
  const std::unique_ptr<StageTask> task = start_diffusion(inputs, recipe).value();
  std::vector<Snapshot> frames;
  RunContext ctx;
  ctx.on_snapshot = [&](const Snapshot& frame) { frames.push_back(frame); };
  int parts = 1;
  for (; !task->step(ctx).value(); ++parts) EXPECT_LE(frames.size(), 4U);
  EXPECT_GT(parts, 4 * 3) << "parts of three time steps";

  Diffusion whole = Diffusion::start(mesh, *recipe.physics->diffusion).value();
  ASSERT_EQ(frames.size(), 4U);
  for (const Snapshot& frame : frames) {
    EXPECT_EQ(frame.time_ms, whole.time_ms());
    EXPECT_EQ(frame.fields[0].values, whole.temperature().values) << "at " << frame.time_ms << " ms";
    if (whole.done()) break;
    while (!whole.advance(std::numeric_limits<int>::max()).value()) {
    }
  }
}

TEST(Session, ANewRecipeEndsARunThatIsUnderWay) {
  Session session;
  Recipe recipe = diffusing_ball();
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  RunContext ctx;
  session.begin(Stage::kDiffusion);
  ASSERT_TRUE(session.advance(0, ctx).ok());
  recipe.physics->diffusion->from = 2;
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  EXPECT_EQ(session.advance(0, ctx).error().code, ErrorCode::kUsage);
}

TEST(Session, SaysThatThereIsNothingToSimulate) {
  Session session;
  Recipe recipe = diffusing_ball();
  recipe.physics.reset();
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  RunContext ctx;
  const Status done = session.run(Stage::kDiffusion, ctx);
  ASSERT_FALSE(done.ok());
  EXPECT_NE(done.error().message.find("physics.diffusion"), std::string::npos);
  EXPECT_NE(session.mesh(), nullptr);
}

TEST(StageArrays, OfEveryStageAreNamedAndFieldsSayWhatTheyAre) {
  Session session;
  ASSERT_TRUE(session.set_recipe(diffusing_ball()).ok());
  RunContext ctx;
  ASSERT_TRUE(session.run(Stage::kQuality, ctx).ok());
  ASSERT_TRUE(session.run(Stage::kDiffusion, ctx).ok());
  const auto describe = [&](Stage stage) {
    StageArrays arrays;
    spec_of(stage).arrays(session.current(stage)->value, arrays);
    nlohmann::json list = nlohmann::json::array();
    for (const StageArray& array : arrays) list.push_back(array_json(array));
    return list;
  };
  EXPECT_EQ(describe(Stage::kOptimise)[0]["name"], "points");
  EXPECT_EQ(describe(Stage::kOptimise)[0]["count"], session.mesh()->points.size());
  const nlohmann::json quality = describe(Stage::kQuality);
  ASSERT_EQ(quality[0]["name"], "min_dihedral_deg");
  EXPECT_EQ(quality[0]["title"], "Smallest dihedral angle");
  EXPECT_EQ(quality[0]["unit"], "deg");
  EXPECT_EQ(quality[0]["on"], "tets");
  EXPECT_EQ(quality[0]["count"], session.mesh()->tets.size());
  EXPECT_FLOAT_EQ(quality[0]["range"][0].get<float>(), static_cast<float>(session.quality()->metrics[0].min));
  EXPECT_EQ(describe(Stage::kDiffusion)[0]["on"], "points");
  EXPECT_EQ(describe(Stage::kDiffusion)[0]["count"], session.mesh()->points.size());
}

}  // namespace
}  // namespace voxtet
