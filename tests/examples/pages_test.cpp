// Figures on pages that no expected.json promises, held against what this tree makes. The pages' `run`
// scripts rewrite them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "base/digest.h"
#include "base/parallel.h"
#include "io/bytes/files.h"
#include "pipeline/report.h"
#include "pipeline/session.h"
#include "support/data.h"

namespace voxtet {
namespace {

using nlohmann::json;

std::string text_of(const std::string& page) {
  const Result<Bytes> bytes = read_file(std::string(VOXTET_SOURCE_DIR) + "/examples/" + page);
  return bytes ? std::string(bytes->begin(), bytes->end()) : std::string();
}

/// The cells of the table's row whose first cell is `name`; none where there is no such row.
std::vector<std::string> row_of(const std::string& page, const std::string& name) {
  std::istringstream lines(text_of(page));
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("| " + name + " |")) continue;
    std::vector<std::string> cells;
    std::istringstream words(line.substr(1));
    for (std::string cell; std::getline(words, cell, '|');)
      cells.push_back(cell.size() > 2 ? cell.substr(1, cell.size() - 2) : "");
    return cells;
  }
  return {};
}

/// 26543 -> "26,543"
std::string grouped(std::size_t number) {
  std::string text = std::to_string(number);
  for (int place = static_cast<int>(text.size()) - 3; place > 0; place -= 3) text.insert(place, ",");
  return text;
}

void mesh(const json& recipe_json, Session& session) {
  const Result<Recipe> recipe = parse_recipe(recipe_json);
  ASSERT_TRUE(recipe.ok()) << recipe.error().message;
  Status done = session.set_recipe(*recipe);
  ASSERT_TRUE(done.ok()) << done.error().message;
  RunContext ctx;
  ctx.threads = hardware_threads();
  done = session.run(Stage::kQuality, ctx);
  ASSERT_TRUE(done.ok()) << done.error().message;
}

TEST(Pages, ScarSizingCountsTheTetrahedraOfItsCoarsestMesh) {
  Session session;
  ASSERT_NO_FATAL_FAILURE(mesh({{"source", {{"phantom", {{"kind", "biventricle"}, {"scar", true}}}}},
                                {"labels", {1, 2, 5, 6}},
                                {"sizing", {{"edge_mm", 3.8}}}},
                               session));
  const std::vector<std::string> cells = row_of("scar-sizing/README.md", "3.8 mm everywhere");
  ASSERT_EQ(cells.size(), 7u);
  EXPECT_EQ(cells[2], grouped(session.mesh()->tets.size()));
}

TEST(Pages, WallLayersCountsTheTetrahedraOfOneLayer) {
  json recipe = json::parse(text_of("wall-layers/case.json"));
  json& wall = recipe["sizing"]["thickness"][0];
  wall["layers"] = 1;
  for (const auto& [layering, name] : {std::pair{"exact", "1, exact"}, std::pair{"size", "1, by size"}}) {
    wall["layering"] = layering;
    Session session;
    ASSERT_NO_FATAL_FAILURE(mesh(recipe, session));
    const std::vector<std::string> cells = row_of("wall-layers/README.md", name);
    ASSERT_EQ(cells.size(), 7u) << name;
    EXPECT_EQ(cells[1], grouped(session.mesh()->tets.size())) << name;
  }
}

/// The eight cases beside other meshers: the digest in results.json, from which the page is drawn.
class BenchmarkPage : public testing::TestWithParam<int> {};

TEST_P(BenchmarkPage, TellsTheMeshOfThisTree) {
  const json results = json::parse(text_of("mesher-benchmark/results.json"));
  ASSERT_EQ(results["cases"].size(), 8u);
  const json& c = results["cases"][GetParam()];
  const auto name = c["volume"].get<std::string>();
  const std::string path = test::shared_data(name + ".nii.gz");
  if (path.empty()) GTEST_SKIP() << name << " is not there: set VOXTET_DATA";
  const json& ours = c["rows"][0];
  ASSERT_EQ(ours["mesher"], "voxtet");
  EXPECT_GE(ours["shapes"]["min_dihedral_deg"]["min"].get<double>(), 33.0);
  EXPECT_NE(
      text_of("mesher-benchmark/README.md").find("| " + grouped(ours["tets"].get<std::size_t>()) + " |"),
      std::string::npos);

  const Result<Bytes> file = read_file(path);
  ASSERT_TRUE(file.ok()) << file.error().message;
  Session session;
  ASSERT_TRUE(session.load_volume({name + ".nii.gz", *file, {}}).ok());
  json recipe = recipe_to_json(session.recipe());
  recipe["labels"] = c["labels"];
  if (c["merged"]) recipe["merge"] = {c["labels"]};
  recipe["sizing"]["edge_mm"] = c["edge_mm"];
  ASSERT_NO_FATAL_FAILURE(mesh(recipe, session));
  EXPECT_EQ(digest_of(*session.mesh()), ours["digest"]) << "tests/bench/peers/run rewrites the page";
}

INSTANTIATE_TEST_SUITE_P(All, BenchmarkPage, testing::Range(0, 8));

}  // namespace
}  // namespace voxtet
