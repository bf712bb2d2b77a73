// The fields of a case that say what is simulated.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "recipe/link.h"
#include "recipe/recipe.h"

namespace voxtet {
namespace {

constexpr std::string_view kHeart = R"({"physics": {
  "anatomy": {"wall": [1, 2, 6], "lv_pool": [3], "rv_pool": [4, 7]},
  "fibres": {"rule": "bayer", "alpha_endo_deg": 50, "beta_epi_deg": 20, "septum": {"alpha_epi_deg": -70}},
  "tissue": {"by": "fraction", "kinds": [
    {"labels": [1, 2], "along_mm_per_ms": 0.7, "across_mm_per_ms": 0.25},
    {"labels": [6], "cell": "mms", "tau_in_ms": 0.4, "tau_out_ms": 7, "tau_open_ms": 100, "tau_close_ms": 130,
     "gate": 0.2}]},
  "stimuli": [
    {"name": "apex", "centre_mm": [1, 2, -40], "radius_mm": 12},
    {"shape": "box", "half_size_mm": [1, 2, 3], "axes_deg": [0, 0, 30], "start_ms": 5, "duration_ms": 1,
     "strength_per_ms": 0.8, "count": 4, "interval_ms": 500, "s2_ms": 320, "s3_ms": 280},
    {"shape": "capsule", "end_mm": [0, 0, 9], "radius_mm": 2}],
  "monodomain": {"integration": "explicit", "end_ms": 300, "step_ms": 0.02, "frame_ms": 10,
    "consistent_mass": 0.25, "electrodes": [{"name": "V1", "at_mm": [50, 60, 0]}, {"at_mm": [0, 0, 90]}]}}})";

TEST(RecipePhysics, IsReadInAllItsFields) {
  const Result<Recipe> recipe = parse_recipe(kHeart);
  ASSERT_TRUE(recipe.ok()) << recipe.error().message;
  ASSERT_TRUE(recipe->physics);
  const PhysicsParams& physics = *recipe->physics;
  EXPECT_EQ(physics.anatomy->wall, (std::vector<Label>{1, 2, 6}));
  EXPECT_EQ(physics.anatomy->lv_pool, std::vector<Label>{3});
  EXPECT_EQ(physics.anatomy->rv_pool, (std::vector<Label>{4, 7}));
  EXPECT_EQ(physics.fibres->rule, FibreRule::kBayer);
  EXPECT_EQ(physics.fibres->wall.alpha_endo, 50);
  EXPECT_EQ(physics.fibres->wall.beta_epi, 20);
  EXPECT_EQ(physics.fibres->septum->alpha_epi, -70);
  EXPECT_EQ(physics.tissue.by, TissueBy::kFraction);
  ASSERT_EQ(physics.tissue.kinds.size(), 2U);
  EXPECT_EQ(physics.tissue.kinds[0].across_mm_per_ms, 0.25);
  EXPECT_FALSE(physics.tissue.kinds[0].cell.modified);
  EXPECT_TRUE(physics.tissue.kinds[1].cell.modified);
  EXPECT_EQ(physics.tissue.kinds[1].cell.tau_close_ms, 130);
  EXPECT_EQ(physics.tissue.kinds[1].cell.gate, 0.2);
  ASSERT_EQ(physics.stimuli.size(), 3U);
  EXPECT_EQ(physics.stimuli[0].name, "apex");
  EXPECT_EQ(physics.stimuli[0].centre_mm, Eigen::Vector3d(1, 2, -40));
  EXPECT_EQ(physics.stimuli[1].shape, RegionShape::kBox);
  EXPECT_EQ(physics.stimuli[1].count, 4);
  EXPECT_EQ(physics.stimuli[1].s3_ms, 280);
  EXPECT_EQ(physics.stimuli[2].shape, RegionShape::kCapsule);
  ASSERT_TRUE(physics.monodomain);
  EXPECT_EQ(physics.monodomain->integration, Integration::kExplicit);
  EXPECT_EQ(physics.monodomain->consistent_mass, 0.25);
  ASSERT_EQ(physics.monodomain->electrodes.size(), 2U);
  EXPECT_EQ(physics.monodomain->electrodes[0].name, "V1");
  EXPECT_EQ(physics.monodomain->electrodes[1].at_mm, Eigen::Vector3d(0, 0, 90));
}

TEST(RecipePhysics, ComesBackFromJsonAndFromALinkAsItWas) {
  const Result<Recipe> recipe = parse_recipe(kHeart);
  ASSERT_TRUE(recipe.ok()) << recipe.error().message;
  const nlohmann::json all = recipe_to_json(*recipe);
  EXPECT_EQ(recipe_to_json(*recipe, true).size(), 2U) << "beside the version all else has its default";
  for (const bool brief : {false, true}) {
    const Result<Recipe> back = parse_recipe(recipe_to_json(*recipe, brief));
    ASSERT_TRUE(back.ok()) << back.error().message;
    EXPECT_EQ(recipe_to_json(*back), all);
  }
  const Result<Recipe> linked = recipe_of_link("https://voxtet.example/" + link_fragment(*recipe));
  ASSERT_TRUE(linked.ok()) << linked.error().message;
  EXPECT_EQ(recipe_to_json(*linked), all);
}

TEST(RecipePhysics, NamesTheFieldThatIsWrong) {
  const auto error_of = [](const char* path, const char* value) {
    const Result<Recipe> heart = parse_recipe(kHeart);
    const Result<Recipe> changed = with_field(*heart, path, value);
    return changed.ok() ? std::string("none") : changed.error().message;
  };
  for (const auto& [path, value] : {std::pair{"physics.tissue.by", "volume"},
                                    {"physics.tissue.kinds[1].along_mm_per_ms", "0"},
                                    {"physics.tissue.kinds[0].cell", "tentusscher"},
                                    {"physics.stimuli[1].count", "0"},
                                    {"physics.stimuli[2].shape", "cone"},
                                    {"physics.fibres.alpha_endo_deg", "200"},
                                    {"physics.monodomain.step_ms", "1"},
                                    {"physics.monodomain.electrodes[1].at_mm", "[1,2]"}}) {
    const std::string message = error_of(path, value);
    EXPECT_NE(message.find(std::string(path) + ": found "), std::string::npos) << message;
    EXPECT_NE(message.find("expected"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace voxtet
