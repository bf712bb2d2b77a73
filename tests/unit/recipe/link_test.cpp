#include "recipe/link.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <nlohmann/json.hpp>

namespace voxtet {
namespace {

Recipe sample() {
  Recipe recipe;
  recipe.source.phantom.emplace().scar = true;
  recipe.sizing.labels = {{5, 0.8}, {6, 0.8}};
  recipe.expected = {"0.1.0", std::string(64, 'a'), 1234};
  return recipe;
}

TEST(Link, CarriesTheWholeCase) {
  const std::string link = "https://host/app/" + link_fragment(sample());
  EXPECT_TRUE(is_link(link));
  const Result<Recipe> back = recipe_of_link(link);
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(recipe_to_json(*back), recipe_to_json(sample()));
}

TEST(Link, ReadsPlainJsonWrittenByHand) {
  const Result<Recipe> recipe = recipe_of_link("#j=%7B%22merge%22:[[1,5]]}");
  ASSERT_TRUE(recipe.ok()) << recipe.error().message;
  EXPECT_EQ(recipe->merge, (std::vector<LabelGroup>{{1, 5}}));
}

TEST(Link, RefusesEveryTruncation) {
  const std::string link = link_fragment(sample());
  for (std::size_t length = 0; length + 1 < link.size(); ++length)
    EXPECT_FALSE(recipe_of_link(link.substr(0, length)).ok()) << length;
}

TEST(Link, SurvivesDamageWithoutCrashing) {
  const std::string link = link_fragment(sample());
  for (std::size_t i = 4; i < link.size(); ++i) {
    std::string damaged = link;
    damaged[i] = damaged[i] == 'A' ? 'B' : 'A';
    const Result<Recipe> recipe = recipe_of_link(damaged);
    EXPECT_TRUE(recipe.ok() || !recipe.error().message.empty());
  }
  EXPECT_FALSE(recipe_of_link("#c1=!!!").ok());
  EXPECT_FALSE(recipe_of_link("#j=%7").ok());
  EXPECT_FALSE(recipe_of_link("nothing").ok());
}

TEST(Link, CapsWhatItInflates) {
  const std::string bomb(64 << 20, ' ');
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 9, Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&stream, bomb.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bomb.data()));
  stream.avail_in = static_cast<uInt>(bomb.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  constexpr char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
  std::string text = "#c1=";
  for (std::size_t i = 0; i + 2 < packed.size(); i += 3) {
    const unsigned bits = (packed[i] & 255U) << 16 | (packed[i + 1] & 255U) << 8 | (packed[i + 2] & 255U);
    for (const int shift : {18, 12, 6, 0}) text += alphabet[bits >> shift & 63];
  }
  const Result<Recipe> recipe = recipe_of_link(text);
  ASSERT_FALSE(recipe.ok());
  EXPECT_NE(recipe.error().message.find("more than 1 MiB"), std::string::npos);
}

}  // namespace
}  // namespace voxtet
