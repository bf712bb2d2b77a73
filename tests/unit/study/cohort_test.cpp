#include "study/cohort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

namespace voxtet {
namespace {

using nlohmann::json;

Draw draw_of(const std::string& field, const json& from) {
  return parse_draw(field, from).value();
}

// The numbers are those of SHA-256, computed once by another program (hashlib): "7/3/source.phantom.scale".
TEST(Cohort, DrawsTheSameOnEveryPlatform) {
  const Draw scale = draw_of("source.phantom.scale", {{"from", 0.8}, {"to", 1.2}});
  EXPECT_EQ(drawn_value(scale, 7, 3), json(1.0384));
  const Draw scar = draw_of("source.phantom.scar", {{"among", {true, false}}});
  EXPECT_EQ(drawn_value(scar, 7, 3), json(false));
}

TEST(Cohort, FillsItsRangesEvenly) {
  const Draw draw = draw_of("a", {{"from", -1}, {"to", 3}});
  constexpr std::size_t kHearts = 4000;
  double sum = 0, squares = 0, least = 9, most = -9;
  for (std::size_t heart = 1; heart <= kHearts; ++heart) {
    const double value = drawn_value(draw, 1, heart);
    sum += value;
    squares += value * value;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  const double mean = sum / kHearts, variance = squares / kHearts - mean * mean;
  EXPECT_NEAR(mean, 1, 0.08);  // four standard errors
  EXPECT_NEAR(variance, 4. / 3, 0.08);
  EXPECT_GE(least, -1);
  EXPECT_LE(most, 3);
  EXPECT_LT(least, -0.99);
  EXPECT_GT(most, 2.99);
}

TEST(Cohort, FieldsAndHeartsAndSeedsAreIndependent) {
  std::set<double> values;
  for (const char* field : {"a", "b"})
    for (const std::uint64_t seed : {1U, 2U})
      for (const std::size_t heart : {1U, 2U, 3U})
        values.insert(drawn_value(draw_of(field, {{"from", 0}, {"to", 1e6}}), seed, heart).get<double>());
  EXPECT_EQ(values.size(), 12U);
}

TEST(Cohort, AHeartHasWhatIsDrawnAndASeedOfItsOwn) {
  Recipe recipe;
  recipe.source.phantom.emplace();
  Cohort cohort{
      .hearts = 2, .seed = 1, .draws = {draw_of("source.phantom.scale", {{"from", 0.9}, {"to", 1.1}})}};
  const Result<DrawnHeart> heart = draw_heart(recipe, cohort, 2);
  ASSERT_TRUE(heart.ok());
  EXPECT_EQ(heart->recipe.source.phantom->scale, heart->drawn[0].second.get<double>());
  EXPECT_EQ(heart->recipe.source.phantom->seed, 2U);
  cohort.draws = {draw_of("source.phantom.seed", {{"among", {41}}})};
  EXPECT_EQ(draw_heart(recipe, cohort, 2)->recipe.source.phantom->seed, 41U);
  cohort.draws = {draw_of("source.phantom.size", {{"among", {41}}})};
  const Result<DrawnHeart> wrong = draw_heart(recipe, cohort, 2);
  ASSERT_FALSE(wrong.ok());
  EXPECT_NE(wrong.error().message.find("heart 2: source.phantom.size"), std::string::npos)
      << wrong.error().message;
}

TEST(Cohort, RefusesWhatNothingCanBeDrawnFrom) {
  for (const json& from : {json(3), json::object(), json{{"from", 2}, {"to", 1}}, json{{"from", 2}},
                           json{{"among", json::array()}}, json{{"from", "a"}, {"to", 1}}}) {
    const Result<Draw> draw = parse_draw("sizing.edge_mm", from);
    ASSERT_FALSE(draw.ok()) << from;
    EXPECT_NE(draw.error().message.find("the draw of sizing.edge_mm: found " + from.dump()),
              std::string::npos);
  }
}

}  // namespace
}  // namespace voxtet
