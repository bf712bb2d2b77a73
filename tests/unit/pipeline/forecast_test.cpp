#include "pipeline/forecast.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/volume/write_volume.h"

namespace voxtet {
namespace {

/// A heart of voxels of 2 mm.
Recipe small_heart() {
  Recipe recipe;
  PhantomParams& phantom = recipe.source.phantom.emplace();
  phantom.kind = PhantomKind::kBiventricle;
  phantom.spacing_mm = Eigen::Vector3d::Constant(2);
  recipe.labels = {1, 2};
  recipe.sizing.edge_mm = 4;
  return recipe;
}

void run_to(Stage stage, const Recipe& recipe, Session& session) {
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  RunContext ctx;
  const Status done = session.run(stage, ctx);
  ASSERT_TRUE(done.ok()) << done.error().message;
}

double forecast_tets(const Recipe& recipe) {
  Session session;
  run_to(Stage::kSizing, recipe, session);
  RunContext ctx;
  const Result<Forecast> forecast = forecast_case(session, ctx);
  EXPECT_TRUE(forecast.ok());
  return forecast ? forecast->mesh.tets : 0;
}

/// Uniform, by label, by region, by distance and by curvature.
std::vector<Recipe> five_recipes() {
  std::vector<Recipe> recipes(5, small_heart());
  recipes[1].sizing.labels = {{2, 2.5}};
  SizeRegion& region = recipes[2].sizing.regions.emplace_back();
  region.radius_mm = 20;
  region.edge_mm = 2;
  recipes[3].sizing.distances = {{2, 2.5, 0.2}};
  recipes[4].sizing.edge_mm = 6;
  recipes[4].sizing.curvature = {{{}, 16, 2}};
  return recipes;
}

TEST(Forecast, IsNearTheMeshThatComesOfIt) {
  for (const Recipe& recipe : five_recipes()) {
    Session session;
    run_to(Stage::kSizing, recipe, session);
    RunContext ctx;
    const Result<Forecast> forecast = forecast_case(session, ctx);
    ASSERT_TRUE(forecast.ok()) << forecast.error().message;
    run_to(Stage::kOptimise, recipe, session);
    const auto tets = static_cast<double>(session.mesh()->tets.size());
    EXPECT_NEAR(forecast->mesh.tets / tets, 1, 0.15) << recipe_to_json(recipe, true)["sizing"];
    EXPECT_NEAR(forecast->mesh.points / static_cast<double>(session.mesh()->points.size()), 1, 0.25);
    EXPECT_NEAR(forecast->mesh.triangles / static_cast<double>(session.remeshed()->triangles.size()), 1, 0.3);
    EXPECT_GT(forecast->peak_mb, 0);
    EXPECT_GT(forecast->seconds, 0);
  }
}

/// The image cuts the body off on all sides, the recipe on one more.
TEST(Forecast, LeavesOutWhatIsBeyondCuts) {
  LabelVolume volume;
  volume.size = {30, 24, 20};
  volume.labels.assign(volume.voxel_count(), 1);
  const Result<Bytes> file = write_nifti(volume, false);
  ASSERT_TRUE(file.ok());
  for (const bool cut : {false, true}) {
    Session session;
    ASSERT_TRUE(session.load_volume({"body.nii", *file, {}}).ok());
    Recipe recipe = session.recipe();
    recipe.sizing.edge_mm = 2;
    if (cut) recipe.volume.cut.push_back({"", {}, {15, 12, 10}, {1, 1, 0}});
    run_to(Stage::kSizing, recipe, session);
    RunContext ctx;
    const Result<Forecast> forecast = forecast_case(session, ctx);
    ASSERT_TRUE(forecast.ok()) << forecast.error().message;
    run_to(Stage::kOptimise, recipe, session);
    EXPECT_NEAR(forecast->mesh.tets / static_cast<double>(session.mesh()->tets.size()), 1, 0.15) << cut;
  }
}

TEST(Forecast, GivesARangeOfTimeForThisMachine) {
  Session session;
  run_to(Stage::kSizing, small_heart(), session);
  RunContext ctx;
  const Result<nlohmann::json> forecast = forecast_json(session, 0, ctx);
  ASSERT_TRUE(forecast.ok());
  const double least = (*forecast)["seconds_here"][0], most = (*forecast)["seconds_here"][1];
  EXPECT_GT(least, 0);
  EXPECT_NEAR(most / least, 1.6 / 0.7, 1e-9);
}

TEST(Forecast, GrowsAsElementsShrinkAndFeelsTheSurface) {
  Recipe recipe = small_heart();
  const double coarse = forecast_tets(recipe);
  recipe.sizing.edge_mm = 2;
  EXPECT_GT(forecast_tets(recipe), 6 * coarse);
  recipe = small_heart();
  recipe.remesh.max_distance_voxels = 0.1;
  EXPECT_GT(forecast_tets(recipe), 1.1 * coarse);
}

TEST(Forecast, KnowsThatCoarseEdgesPassOverContactsOfManyLabels) {
  const auto seconds = [](int regions, double edge_mm) {
    Recipe recipe;
    PhantomParams& atlas = recipe.source.phantom.emplace();
    atlas.kind = PhantomKind::kAtlas;
    atlas.spacing_mm.setConstant(2);
    atlas.scale = 0.3;
    atlas.regions = regions;
    recipe.sizing.edge_mm = edge_mm;
    Session session;
    run_to(Stage::kSizing, recipe, session);
    RunContext ctx;
    const Result<Forecast> forecast = forecast_case(session, ctx);
    EXPECT_TRUE(forecast.ok());
    return forecast.ok() ? forecast->seconds : 0.0;
  };
  EXPECT_GT(seconds(60, 8), 1.2 * seconds(60, 4));
  EXPECT_GT(seconds(60, 8) / seconds(60, 4), 1.2 * seconds(1, 8) / seconds(1, 4));
}

TEST(Forecast, OfOtherSizesLeavesTheMeshThatIsAtHand) {
  Recipe recipe = small_heart();
  recipe.sizing.thickness.push_back({{1, 2}, {}, 2});
  Session session;
  run_to(Stage::kOptimise, recipe, session);
  const TetMesh* mesh = session.mesh();
  Recipe other = recipe;
  other.sizing.thickness[0].layers = 3;
  other.sizing.gradation = 0.2;
  ASSERT_TRUE(session.set_recipe(other).ok());
  RunContext ctx;
  ASSERT_TRUE(session.may_size());
  const Result<Forecast> forecast = forecast_case(session, ctx);
  ASSERT_TRUE(forecast.ok()) << forecast.error().message;
  EXPECT_EQ(forecast->mesh.tets, forecast_tets(other));
  run_to(Stage::kOptimise, recipe, session);
  EXPECT_EQ(session.mesh(), mesh);
  EXPECT_TRUE(session.cached(Stage::kOptimise));

  other.sizing.thickness[0].wall = {1};
  ASSERT_TRUE(session.set_recipe(other).ok());
  EXPECT_FALSE(session.may_size()) << "another wall has not been measured";
  EXPECT_FALSE(forecast_case(session, ctx).ok());
}

TEST(FitSizes, FindsTheEdgeLengthThatGivesSoManyElements) {
  const std::vector<Recipe> recipes = five_recipes();
  for (const auto& [recipe, factor] : {std::pair{recipes[0], 3.0}, {recipes[2], 0.8}, {recipes[4], 2.0}}) {
    const double wanted = factor * forecast_tets(recipe);
    Session session;
    run_to(Stage::kSizing, recipe, session);
    RunContext ctx;
    const Result<FittingSizes> fitting = fit_sizes(session, {wanted, 0, 0}, ctx);
    ASSERT_TRUE(fitting.ok()) << fitting.error().message;
    EXPECT_NEAR(fitting->sizing.edge_mm, fitting->factor * recipe.sizing.edge_mm, 1e-9);
    EXPECT_EQ(recipe_to_json(session.recipe()), recipe_to_json(recipe)) << "the session stays as it is";
    Recipe fitted = recipe;
    fitted.sizing = fitting->sizing;
    const double found = forecast_tets(fitted);
    EXPECT_LE(found, wanted);
    EXPECT_GT(found, 0.985 * wanted);
    EXPECT_EQ(found, fitting->forecast.mesh.tets);
  }
}

TEST(FitSizes, SaysWhereEdgeLengthsDoNotDecide) {
  Session session;
  RunContext ctx;
  const Result<FittingSizes> none = fit_sizes(session, {1000, 0, 0}, ctx);
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().message, "no sizes yet: run the stage sizing");
  Recipe recipe = small_heart();
  recipe.sizing.edge_max_mm = 4;
  run_to(Stage::kSizing, recipe, session);
  const Result<FittingSizes> few = fit_sizes(session, {1000, 0, 0}, ctx);
  ASSERT_FALSE(few.ok());
  EXPECT_EQ(few.error().code, ErrorCode::kUsage);
  EXPECT_NE(few.error().message.find("even 64 times the edge lengths"), std::string::npos)
      << few.error().message;
  EXPECT_NE(few.error().message.find("edge_max_mm"), std::string::npos);
  EXPECT_FALSE(fit_sizes(session, {}, ctx).ok());
}

TEST(ForecastJson, HoldsTheForecastAndTheSizesThatFit) {
  Session session;
  run_to(Stage::kSizing, small_heart(), session);
  RunContext ctx;
  const Result<nlohmann::json> alone = forecast_json(session, 0, ctx);
  ASSERT_TRUE(alone.ok());
  EXPECT_EQ(alone->at("tets").get<double>(), std::round(forecast_case(session, ctx)->mesh.tets));
  EXPECT_FALSE(alone->contains("fitting"));
  const double wanted = 2 * alone->at("tets").get<double>();
  const Result<nlohmann::json> both = forecast_json(session, wanted, ctx);
  ASSERT_TRUE(both.ok());
  const nlohmann::json& fitting = both->at("fitting");
  EXPECT_NEAR(fitting.at("forecast").at("tets").get<double>(), wanted, 0.015 * wanted);
  EXPECT_LT(fitting.at("edge_mm").get<double>(), small_heart().sizing.edge_mm);
  EXPECT_EQ(fitting.at("sizing").at("edge_mm"), fitting.at("edge_mm"));
}

/// The edge length, mm, that a refusal for lack of memory beginning with these words says would fit.
double fitting_edge_mm(const Status& refused, const std::string& words) {
  if (refused.ok()) {
    ADD_FAILURE() << "not refused";
    return 0;
  }
  EXPECT_EQ(refused.error().code, ErrorCode::kOutOfMemory);
  const std::string& message = refused.error().message;
  EXPECT_EQ(message.rfind(words, 0), 0U) << message;
  const std::size_t at = message.find("sizing.edge_mm ");
  EXPECT_NE(at, std::string::npos) << message;
  return at == std::string::npos ? 0 : std::stod(message.substr(at + 15));
}

TEST(Limits, RefuseBeforeMeshingAndNameTheEdgeLengthThatFits) {
  Session session;
  Recipe recipe = small_heart();
  recipe.sizing.edge_mm = 3;
  recipe.limits.tets = 0.5 * forecast_tets(recipe);
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  RunContext ctx;
  recipe.sizing.edge_mm =
      fitting_edge_mm(session.run(Stage::kOptimise, ctx), "limits.tets: the forecast is ");
  EXPECT_EQ(session.remeshed(), nullptr);
  run_to(Stage::kRemesh, recipe, session);
  EXPECT_NE(session.remeshed(), nullptr);
  recipe.limits.memory_mb = 1;
  recipe.limits.seconds = 1e-3;
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  const Status both = session.run(Stage::kOptimise, ctx);
  ASSERT_FALSE(both.ok()) << "a surface made within looser limits is not handed out past tighter ones";
  EXPECT_EQ(both.error().code, ErrorCode::kOutOfMemory);
  EXPECT_NE(session.remeshed(), nullptr) << "what is made stays";
  EXPECT_NE(both.error().message.find("limits.memory_mb"), std::string::npos) << both.error().message;
  EXPECT_NE(both.error().message.find("limits.seconds"), std::string::npos);
  recipe.limits = {};
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  ASSERT_TRUE(session.run(Stage::kRemesh, ctx).ok());
  EXPECT_TRUE(session.cached(Stage::kRemesh));
}

TEST(Limits, RefuseWhatCannotBeAddressed) {
  Session session;
  Recipe recipe = small_heart();
  RunContext ctx;
  constexpr double kSpaceMb = 4295;
  run_to(Stage::kSizing, recipe, session);
  EXPECT_TRUE(check_limits(session, ctx, kSpaceMb).ok());
  recipe.sizing.edge_mm = 0.1;
  run_to(Stage::kSizing, recipe, session);
  EXPECT_TRUE(check_limits(session, ctx, 0).ok()) << "no bound";
  recipe.sizing.edge_mm = fitting_edge_mm(check_limits(session, ctx, kSpaceMb), "memory: the forecast is ");
  run_to(Stage::kSizing, recipe, session);
  const Result<Forecast> forecast = forecast_case(session, ctx);
  ASSERT_TRUE(forecast.ok()) << forecast.error().message;
  EXPECT_LE(forecast->peak_mb, 0.75 * kSpaceMb) << "forecasts hold within a quarter";
}

}  // namespace
}  // namespace voxtet
