#include "recipe/recipe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

namespace voxtet {
namespace {

using nlohmann::json;

std::string error_of(const std::string& text) {
  const Result<Recipe> recipe = parse_recipe(std::string_view(text));
  return recipe.ok() ? "" : recipe.error().message;
}

TEST(ParseRecipe, KeepsDefaultsForAbsentFields) {
  const Result<Recipe> recipe = parse_recipe(std::string_view("{}"));
  ASSERT_TRUE(recipe.ok());
  EXPECT_EQ(recipe_to_json(*recipe), recipe_to_json(Recipe{}));
  EXPECT_EQ(recipe_to_json(*recipe, true), json({{"version", kRecipeVersion}}));
}

TEST(ParseRecipe, ReadsEveryKindOfField) {
  const Result<Recipe> recipe = parse_recipe(std::string_view(R"({
    "source": {"phantom": {"kind": "torus", "spacing_mm": [1, 2, 3], "mirrored": true, "seed": 4294967295}},
    "labels": [5, 1], "merge": [[5, 1], [2]],
    "surface": {"method": "marching_tets"},
    "sizing": {"edge_mm": 1.5, "labels": [{"label": 5, "edge_mm": 0.8}],
               "regions": [{"shape": "capsule", "centre_mm": [-1e3, 0, 2.5], "radius_mm": 4, "name": "a"}]}})"));
  ASSERT_TRUE(recipe.ok()) << recipe.error().message;
  EXPECT_EQ(recipe->source.phantom->kind, PhantomKind::kTorus);
  EXPECT_EQ(recipe->source.phantom->spacing_mm, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(recipe->source.phantom->seed, 4294967295U);
  EXPECT_EQ(recipe->labels, (std::vector<Label>{5, 1}));
  EXPECT_EQ(recipe->merge, (std::vector<LabelGroup>{{5, 1}, {2}}));
  EXPECT_EQ(recipe->surface.method, ExtractMethod::kMarchingTets);
  EXPECT_EQ(recipe->sizing.labels.at(0).label, 5);
  EXPECT_EQ(recipe->sizing.regions.at(0).shape, RegionShape::kCapsule);
  EXPECT_EQ(recipe->sizing.regions.at(0).centre_mm.x(), -1000);
}

TEST(ParseRecipe, NamesThePathTheValueAndTheExpectation) {
  EXPECT_NE(
      error_of(R"({"sizing":{"edge_mm":-1}})").find("sizing.edge_mm: found -1, expected a number from 0.01"),
      std::string::npos);
  EXPECT_NE(
      error_of(R"({"sizing":{"labels":[{"label":1},{"label":0}]}})").find("sizing.labels[1].label: found 0"),
      std::string::npos);
  EXPECT_NE(error_of(R"({"sizing":{"edge":1}})").find("sizing.edge: unknown field; known here: edge_mm"),
            std::string::npos);
  EXPECT_NE(error_of(R"({"surface":{"method":"mc33"}})").find("one of auto, marching_cubes"),
            std::string::npos);
  EXPECT_NE(error_of(R"({"labels":[1.5]})").find("labels[0]: found 1.5, expected a whole number"),
            std::string::npos);
  EXPECT_NE(error_of(R"({"merge":1})").find("merge: found 1, expected a list"), std::string::npos);
  EXPECT_NE(error_of(R"({"merge":[1]})").find("merge[0]: found 1, expected a list of labels"),
            std::string::npos);
  EXPECT_NE(error_of(R"({"merge":[[0]]})").find("merge[0][0]: found 0, expected a whole number from 1"),
            std::string::npos);
  EXPECT_NE(error_of(R"({"source":{"phantom":{},"file":{}}})").find("expected one of them"),
            std::string::npos);
  EXPECT_NE(error_of("[]").find("expected an object"), std::string::npos);
  EXPECT_NE(error_of("{\"a\"").find("not valid JSON"), std::string::npos);
}

TEST(ParseRecipe, RefusesWhatIsTooDeepOrTooLong) {
  EXPECT_NE(error_of("{\"labels\":" + std::string(100000, '[')).find("nested deeper"), std::string::npos);
  EXPECT_NE(error_of("{\"labels\":[" + std::string(2 << 20, ' ')).find("at most"), std::string::npos);
  std::string many = R"({"sizing":{"regions":[{})";
  for (int i = 0; i < 1000; ++i) many += ",{}";
  EXPECT_NE(error_of(many + "]}}").find("sizing.regions: 1001 items"), std::string::npos);
}

TEST(Legend, IsOverWhatTheFileSays) {
  const Result<Recipe> recipe =
      parse_recipe(json::parse(R"({"legend":[{"label":5,"name":"scar"},{"label":2,"colour":"#00ff80"}]})"));
  ASSERT_TRUE(recipe.ok()) << recipe.error().message;
  const auto infos = with_legend({{2, "two", {1, 1, 1}}, {3, "three"}}, recipe->legend);
  ASSERT_EQ(infos.size(), 3u);
  EXPECT_EQ(infos[0].name, "two");
  EXPECT_EQ(infos[0].colour, (std::array<float, 3>{0, 1, 128 / 255.F}));
  EXPECT_EQ(infos[1].name, "three");
  EXPECT_EQ(infos[2].label, 5);
  EXPECT_EQ(infos[2].name, "scar");
  EXPECT_LT(infos[2].colour[0], 0);

  EXPECT_EQ(error_of(R"({"legend":[{"label":2},{"label":2}]})"),
            "legend[1].label: found 2 again, expected one entry a label");
  for (const char* colour : {"red", "#12345", "#12345g"})
    EXPECT_NE(error_of(std::string(R"({"legend":[{"label":2,"colour":")") + colour + "\"}]}")
                  .find("legend[0].colour: found \"" + std::string(colour) + "\", expected #rrggbb"),
              std::string::npos);
}

TEST(RecipeJson, RoundTripsFullAndMinimal) {
  Recipe recipe;
  recipe.source.phantom.emplace().scar = true;
  recipe.labels = {1, 2, 5};
  // By name: a vector left as {} would hold whatever was there.
  SizeRegion& tip = recipe.sizing.regions.emplace_back();
  tip.name = "tip";
  tip.shape = RegionShape::kBox;
  tip.centre_mm = {1, 2, 3};
  tip.half_size_mm = {4, 5, 6};
  recipe.tetra.min_dihedral_deg = 10.1;
  const json full = recipe_to_json(recipe), minimal = recipe_to_json(recipe, true);
  EXPECT_EQ(recipe_to_json(*parse_recipe(full)), full);
  EXPECT_EQ(recipe_to_json(*parse_recipe(minimal)), full);
  EXPECT_EQ(minimal["source"].dump(), R"({"phantom":{"kind":"biventricle","scar":true}})");
  EXPECT_EQ(minimal["tetra"].dump(), R"({"min_dihedral_deg":10.1})");
  EXPECT_FALSE(minimal.contains("smooth"));
}

TEST(WithField, SetsNestedFieldsAndRefusesUnknownOnes) {
  Result<Recipe> recipe = with_field(Recipe{}, "sizing.gradation", "0.2");
  ASSERT_TRUE(recipe.ok());
  EXPECT_EQ(recipe->sizing.gradation, 0.2);
  recipe = with_field(*recipe, "source.phantom.kind", "sphere");
  ASSERT_TRUE(recipe.ok()) << recipe.error().message;
  recipe = with_field(*recipe, "labels", "[1,2]");
  ASSERT_TRUE(recipe.ok());
  recipe = with_field(*recipe, "sizing.regions[0].edge_mm", "0.5");
  ASSERT_TRUE(recipe.ok()) << recipe.error().message;
  EXPECT_EQ(recipe->sizing.regions.at(0).edge_mm, 0.5);
  EXPECT_EQ(with_field(*recipe, "sizing.nothing", "1").error().code, ErrorCode::kUsage);
  EXPECT_FALSE(with_field(*recipe, "sizing.edge_mm.deeper", "1").ok());
  EXPECT_FALSE(with_field(*recipe, "sizing.regions[x].edge_mm", "1").ok());
}

// Cases and links from before a field or a choice had its name of today.
TEST(ParseRecipe, ReadsFormerNamesAndWritesThoseOfToday) {
  const auto old =
      parse_recipe(std::string_view(R"({"remesh": {"method": "remesh"}, "lookup": {"labels": [5]}})"));
  ASSERT_TRUE(old.ok()) << old.error().message;
  EXPECT_EQ(old->remesh.method, RemeshMethod::kAdapt);
  EXPECT_EQ(old->transfer.labels, std::vector<Label>{5});
  EXPECT_EQ(
      recipe_to_json(*old, true),
      nlohmann::json::parse(R"({"remesh": {"method": "adapt"}, "transfer": {"labels": [5]}, "version": 2})"));
  EXPECT_EQ(with_field(*old, "lookup.labels", "[6]")->transfer.labels, std::vector<Label>{6});
  EXPECT_EQ(with_field(Recipe{}, "remesh.method", "remesh")->remesh.method, RemeshMethod::kAdapt);

  const auto both =
      parse_recipe(std::string_view(R"({"transfer": {"labels": [5]}, "lookup": {"labels": [6]}})"));
  ASSERT_FALSE(both.ok());
  EXPECT_EQ(both.error().message,
            "lookup: found beside transfer, which is its name today; expected one of them");
}

TEST(ParseRecipe, KnowsTheVersionsOfItsFormat) {
  const auto message = [](std::string_view text) { return parse_recipe(text).error().message; };
  EXPECT_TRUE(parse_recipe(std::string_view(R"({"version": 1, "lookup": {"labels": [5]}})")).ok());
  EXPECT_TRUE(parse_recipe(std::string_view(R"({"version": 2, "transfer": {"labels": [5]}})")).ok());
  EXPECT_TRUE(message(R"({"version": 2, "lookup": {"labels": [5]}})").starts_with("lookup: unknown field"))
      << "a name of version 1";
  EXPECT_EQ(message(R"({"version": 3})"),
            "version: found 3, a recipe of a later voxtet; expected 2 or less: open it with a newer voxtet");
  for (const char* bad : {"0", "-1", "1.5", "\"2\"", "null", "[2]"})
    EXPECT_EQ(message(std::string(R"({"version": )") + bad + "}"),
              std::string("version: found ") + bad + ", expected a whole number from 1 to 2");
  EXPECT_EQ(parse_recipe(recipe_to_json(Recipe{}, true))->version, kRecipeVersion);
}

TEST(ParseRecipe, ReadsWhatAPageShowsFirst) {
  const std::string text =
      R"({"camera":{"position_mm":[1,2,300],"target_mm":[0,0,5]},"colour":"dihedral","cut":{"flat":true},"element":17})";
  const auto read = parse_recipe(json{{"view", json::parse(text)}});
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->view->camera->position_mm, Eigen::Vector3d(1, 2, 300));
  EXPECT_TRUE(read->view->cut->flat);
  EXPECT_EQ(read->view->element, 17);
  EXPECT_EQ(parse_recipe(recipe_to_json(*read, true))->view->colour, "dihedral");
  EXPECT_FALSE(parse_recipe(std::string_view(R"({"view": {"crosshair": [0, 0, 2]}})")).ok());
}

// Every field of the table has its place in the JSON Schema, with its default.
TEST(RecipeJsonSchema, HasEveryField) {
  const json schema = recipe_json_schema();
  const json fields = recipe_schema()["fields"];
  EXPECT_GT(fields.size(), 100U);
  for (const json& field : fields) {
    const json* at = &schema;
    const std::string path = field["path"];
    for (std::size_t begin = 0; begin < path.size();) {
      const std::size_t end = std::min(path.find('.', begin), path.size());
      const std::string name = path.substr(begin, end - begin);
      ASSERT_TRUE((*at)["properties"].contains(name)) << path;
      at = &(*at)["properties"][name];
      begin = end + 1;
    }
    if (field["type"] != "list") {
      EXPECT_EQ((*at)["default"], field["default"]) << path;
    }
    EXPECT_NE((*at)["description"], "") << path;
  }
}

TEST(ParseRecipe, ReadsHowAVolumeIsRead) {
  const auto read = parse_recipe(std::string_view(
      R"({"source": {"unit": "um", "precedence": ["inner", 3], "background": -1, "frame": 2,
                     "threshold": {"lower": -0.5, "upper": 300}}})"));
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->source.read,
            (ReadOptions{LengthUnit::kMicrometre, {"inner", "3"}, -1, 2, Threshold{-0.5, 300}}));
  EXPECT_EQ(parse_recipe(recipe_to_json(*read))->source.read, read->source.read);
  EXPECT_FALSE(recipe_to_json(Recipe{}, true).contains("source"));
  const auto message = [](std::string_view text) { return parse_recipe(text).error().message; };
  EXPECT_EQ(message(R"({"source": {"unit": "inch"}})"),
            R"(source.unit: found "inch", expected one of file, m, cm, mm, um, nm)");
  EXPECT_EQ(
      message(R"({"physics": {"mechanics": {"contraction": {"preset": "slow"}}}})"),
      R"(physics.mechanics.contraction.preset: found "slow", expected one of fast, ambit, elastodynamics)");
  EXPECT_EQ(message(R"({"source": {"precedence": [true]}})"),
            "source.precedence[0]: found true, expected a text or a label");
  EXPECT_EQ(message(R"({"source": {"frame": -2}})"),
            "source.frame: found -2, expected a whole number from -1 to 65535");
}

TEST(RecipeSchema, DescribesEveryFieldOfTheRecipe) {
  std::vector<std::string> paths;
  const json schema = recipe_schema();
  EXPECT_EQ(schema["optional_groups"], json({"source.phantom",
                                             "source.inline",
                                             "source.file",
                                             "source.threshold",
                                             "physics",
                                             "physics.anatomy",
                                             "physics.fibres",
                                             "physics.fibres.septum",
                                             "physics.monodomain",
                                             "physics.mechanics",
                                             "physics.mechanics.material.transversely_isotropic",
                                             "physics.mechanics.material.holzapfel_ogden",
                                             "physics.mechanics.material.guccione",
                                             "physics.mechanics.material.mooney_rivlin",
                                             "physics.mechanics.material.corotational",
                                             "physics.mechanics.contraction.lv",
                                             "physics.mechanics.contraction.rv",
                                             "physics.mechanics.closed_loop",
                                             "physics.diffusion",
                                             "view",
                                             "view.camera",
                                             "view.cut"}));
  for (const json& field : schema["fields"]) {
    EXPECT_FALSE(field["description"].get<std::string>().empty()) << field;
    paths.push_back(field["path"]);
  }
  for (const char* path :
       {"source.phantom.kind", "labels", "sizing.regions", "remesh.facet_angle_deg", "expected.tets"})
    EXPECT_NE(std::find(paths.begin(), paths.end(), path), paths.end()) << path;
}

TEST(Recipe, SizesOfAllKindsComeBackFromJsonAsTheyWere) {
  const nlohmann::json json = nlohmann::json::parse(R"({"sizing": {
    "thickness": [{"wall": [1, 5, 6], "inner": [3], "layers": 2, "layering": "exact"}, {"wall": [2], "edge_thin_mm": 0.7}],
    "masks": [{"name": "paint.nii", "sha256": "ab", "edges": [{"label": 1, "edge_mm": 0.8}]}],
    "images": [{"name": "sizes.nii.gz"}],
    "curvature": [{"labels": [1], "edges_per_turn": 12, "edge_min_mm": 0.8}]},
    "limits": {"tets": 5e5, "memory_mb": 800}})");
  const Result<Recipe> recipe = parse_recipe(json);
  ASSERT_TRUE(recipe.ok()) << recipe.error().message;
  ASSERT_EQ(recipe->sizing.thickness.size(), 2U);
  EXPECT_EQ(recipe->sizing.thickness[0].wall, (std::vector<Label>{1, 5, 6}));
  EXPECT_EQ(recipe->sizing.thickness[0].layers, 2U);
  EXPECT_EQ(recipe->sizing.thickness[0].layering, Layering::kExact);
  EXPECT_EQ(recipe->sizing.thickness[1].layering, Layering::kSize);
  EXPECT_EQ(recipe->sizing.masks.at(0).edges.at(0).edge_mm, 0.8);
  EXPECT_EQ(recipe->sizing.curvature.at(0).edges_per_turn, 12);
  EXPECT_EQ(recipe->limits.tets, 5e5);
  const Result<Recipe> back = parse_recipe(recipe_to_json(*recipe, true));
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(recipe_to_json(*back), recipe_to_json(*recipe));
}

TEST(Recipe, NamesTheFieldOfANestedList) {
  const Result<Recipe> recipe = parse_recipe(nlohmann::json::parse(
      R"({"sizing": {"masks": [{"name": "a"}, {"name": "b", "edges": [{"label": 1, "edge_mm": -1}]}]}})"));
  ASSERT_FALSE(recipe.ok());
  EXPECT_NE(recipe.error().message.find("sizing.masks[1].edges[0].edge_mm: found -1"), std::string::npos)
      << recipe.error().message;
}

}  // namespace
}  // namespace voxtet
