#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/parallel.h"
#include "io/bytes/files.h"
#include "page_rows.h"
#include "pipeline/report.h"
#include "pipeline/session.h"
#include "support/check_tets.h"

namespace voxtet {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::vector<std::string> example_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(VOXTET_SOURCE_DIR) / "examples"))
    if (fs::exists(entry.path() / "case.json")) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

json read_json(const fs::path& path) {
  const Result<Bytes> bytes = read_file(path.string());
  if (!bytes.ok()) throw std::runtime_error(bytes.error().message);
  return json::parse(bytes->begin(), bytes->end());
}

class Example : public testing::TestWithParam<std::string> {};

TEST_P(Example, GivesThePromisedMesh) {
  const fs::path folder = fs::path(VOXTET_SOURCE_DIR) / "examples" / GetParam();
  const json expected = read_json(folder / "expected.json");
  const Result<Recipe> recipe = parse_recipe(read_json(folder / "case.json"));
  ASSERT_TRUE(recipe.ok()) << recipe.error().message;
  Session session;
  ASSERT_TRUE(session.set_recipe(*recipe).ok());
  RunContext ctx;
  ctx.threads = hardware_threads();  // the build of WebAssembly without threads has one
  Status done = session.run(Stage::kQuality, ctx);
  ASSERT_TRUE(done.ok()) << done.error().message;
  const json stages = expected.value("stages", json::object());
  for (const auto& stage : stages.items()) {
    done = session.run(stage_of(stage.key()).value(), ctx);
    ASSERT_TRUE(done.ok()) << done.error().message;
  }
  test::check_tets(*session.mesh());
  json report = report_json(session);
  SCOPED_TRACE("scripts/update_expected rewrites the rows of README.md");
  test::expect_mesh_rows(GetParam() + "/README.md", report);
  json by_name = json::object();
  for (const json& metric : report["quality"]["metrics"])
    if (!by_name.contains(metric["name"])) by_name[metric["name"].get<std::string>()] = metric;
  report["quality"]["metrics"] = by_name;
  EXPECT_EQ(report["digest"], expected["digest"]);
  EXPECT_EQ(report["tets"], expected["tets"]);
  for (const json& stage : report["stages"])
    if (const auto found = stages.find(stage["name"].get<std::string>()); found != stages.end()) {
      EXPECT_EQ(stage["digest"], *found) << stage["name"];
    }
  EXPECT_TRUE(report["quality"]["passed"]);
  ASSERT_FALSE(expected["numbers"].empty());
  for (const auto& [pointer, range] : expected["numbers"].items()) {
    const double value = report.at(json::json_pointer(pointer)).get<double>();
    EXPECT_GE(value, range[0].get<double>()) << pointer;
    EXPECT_LE(value, range[1].get<double>()) << pointer;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Example, testing::ValuesIn(example_names()), [](const auto& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace voxtet
