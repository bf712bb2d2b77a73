#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "io/bytes/files.h"
#include "pipeline/report.h"

namespace voxtet {
namespace {

using nlohmann::json;

// The types of the web are made from it: scripts/update_contract writes both.
TEST(SchemaJson, IsTheOneThatTheContractOfTheWebIsMadeFrom) {
  const Result<Bytes> committed = read_file(VOXTET_SOURCE_DIR "/web/src/engine/schema.json");
  ASSERT_TRUE(committed.ok());
  json schema = schema_json();
  schema.erase("version");
  EXPECT_EQ(json::parse(committed->begin(), committed->end()), schema) << "run scripts/update_contract";

  const Result<Bytes> published = read_file(VOXTET_SOURCE_DIR "/web/public/recipe.schema.json");
  ASSERT_TRUE(published.ok()) << published.error().message;
  EXPECT_EQ(json::parse(published->begin(), published->end()), recipe_json_schema())
      << "run scripts/update_contract";
}

}  // namespace
}  // namespace voxtet
