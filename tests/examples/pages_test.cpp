// Figures on pages that no expected.json promises, held against what this tree makes. The pages' `run`
// scripts rewrite them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/digest.h"
#include "base/parallel.h"
#include "page_rows.h"
#include "pipeline/report.h"
#include "pipeline/session.h"
#include "support/data.h"

namespace voxtet {
namespace {

using nlohmann::json;
using test::Cells;
using test::expect_figures;
using test::metric_of;
using test::row_of;
using test::text_of;

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

TEST(Pages, ScarSizingTellsOfItsCoarsestMesh) {
  Session session;
  ASSERT_NO_FATAL_FAILURE(mesh({{"source", {{"phantom", {{"kind", "biventricle"}, {"scar", true}}}}},
                                {"labels", {1, 2, 5, 6}},
                                {"sizing", {{"edge_mm", 3.8}}}},
                               session));
  const Cells cells = row_of("scar-sizing/README.md", "3.8 mm everywhere");
  ASSERT_EQ(cells.size(), 7u);
  const json report = report_json(session);
  const auto edge_of = [&](int label) -> double {
    for (const json& of : report["fidelity"]["labels"])
      if (of["label"] == label) return of["median_edge_mm"];
    return 0;
  };
  expect_figures(cells[2], {report["tets"]}, "tetrahedra");
  expect_figures(cells[3], {edge_of(1)}, "median edge in label 1");
  expect_figures(cells[4], {edge_of(5), edge_of(6)}, "in scar and border zone");
  const json& angles = metric_of(report, "min_dihedral_deg");
  expect_figures(cells[5], {angles["min"]}, "smallest dihedral angle");
  expect_figures(cells[6], {angles["p1"]}, "1 % quantile");
}

TEST(Pages, WallLayersTellsOfOneLayer) {
  json recipe = json::parse(text_of("wall-layers/case.json"));
  json& wall = recipe["sizing"]["thickness"][0];
  wall["layers"] = 1;
  for (const auto& [layering, name] : {std::pair{"exact", "1, exact"}, std::pair{"size", "1, by size"}}) {
    wall["layering"] = layering;
    Session session;
    ASSERT_NO_FATAL_FAILURE(mesh(recipe, session));
    const Cells cells = row_of("wall-layers/README.md", name);
    ASSERT_EQ(cells.size(), 7u) << name;
    const json report = report_json(session);
    const json& angles = metric_of(report, "min_dihedral_deg");
    expect_figures(cells[1], {report["tets"]}, name);
    expect_figures(cells[5], {angles["min"], angles["p1"]}, name);
  }
}

/// What results.json says of a mesh, and so the page, which mesher_benchmark_page holds to be drawn from it.
void expect_row(const json& row, const json& report) {
  constexpr double kRead = 1e-3;  // its measures are taken from a file in single precision
  EXPECT_EQ(row["digest"], report["digest"]) << "tests/bench/peers/run rewrites the page";
  EXPECT_EQ(row["tets"], report["tets"]);
  for (const auto& [name, shape] : row["shapes"].items())
    for (const char* key : {"min", "p01", "p1", "mean", "max"})
      if (shape.contains(key))
        EXPECT_NEAR(shape[key].get<double>(), metric_of(report, name)[key].get<double>(), kRead)
            << name << " " << key;
  EXPECT_NEAR(row["sizes"]["median"].get<double>(), metric_of(report, "size_log2")["median"].get<double>(),
              kRead);
  for (const json& label : report["fidelity"]["labels"]) {
    const std::string number = std::to_string(label["label"].get<int>());
    const double mm3 = label["mesh_mm3"];
    EXPECT_NEAR(row["volumes_mm3"].at(number).get<double>(), mm3, 1e-5 * mm3) << "label " << number;
  }
}

/// The eight cases beside other meshers: results.json, from which the page is drawn.
class BenchmarkPage : public testing::TestWithParam<int> {};

TEST_P(BenchmarkPage, TellsTheMeshOfThisTree) {
  const json results = json::parse(text_of("mesher-benchmark/results.json"));
  ASSERT_EQ(results["cases"].size(), 8u);
  const json& c = results["cases"][GetParam()];
  const auto name = c["volume"].get<std::string>();
  const std::string path = test::shared_data(name + ".nii.gz");
  if (path.empty()) GTEST_SKIP() << name << " is not there: set VOXTET_DATA";

  const Result<Bytes> file = read_file(path);
  ASSERT_TRUE(file.ok()) << file.error().message;
  Session session;
  ASSERT_TRUE(session.load_volume({name + ".nii.gz", *file, {}}).ok());
  json recipe = recipe_to_json(session.recipe());
  recipe["labels"] = c["labels"];
  if (c["merged"]) recipe["merge"] = {c["labels"]};
  recipe["sizing"]["edge_mm"] = c["edge_mm"];
  ASSERT_NO_FATAL_FAILURE(mesh(recipe, session));
  const json report = report_json(session);
  EXPECT_GE(metric_of(report, "min_dihedral_deg")["min"].get<double>(), 33.0);
  int found = 0;
  for (const json& row : c["rows"]) {
    const auto mesher = row["mesher"].get<std::string>();
    if (!mesher.starts_with("voxtet")) continue;
    SCOPED_TRACE(mesher);
    expect_row(row, report);
    ++found;
  }
  EXPECT_EQ(found, 2) << "native and WebAssembly";
}

INSTANTIATE_TEST_SUITE_P(All, BenchmarkPage, testing::Range(0, 8));

}  // namespace
}  // namespace voxtet
