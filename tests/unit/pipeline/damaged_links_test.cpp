// Links that were damaged, or made to do harm: each is a case or an error with a reason.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "phantom/make_phantom.h"
#include "pipeline/sources/source_volume.h"
#include "recipe/link.h"
#include "support/test_random.h"
#include "unit/pipeline/small_case.h"

namespace voxtet {
namespace {

/// 100,000 are run by hand: VOXTET_FUZZED_LINKS=100000.
int link_count() {
  const char* asked = std::getenv("VOXTET_FUZZED_LINKS");
  return asked ? std::atoi(asked) : 3000;
}

std::vector<std::string> whole_links() {
  Recipe recipe = test::small_case();
  recipe.sizing.labels = {{1, 2}};
  const Recipe inlined = *with_inline_volume(recipe, *make_phantom(*recipe.source.phantom));
  return {link_fragment(recipe), link_fragment(inlined), "#j=" + recipe_to_json(recipe, true).dump(),
          "#j=" + recipe_to_json(inlined, true).dump()};
}

/// A few changes of characters, cuts and repetitions behind the link's head.
std::string damaged(std::string link, test::TestRandom& random) {
  constexpr int kHead = 4, kLongest = 40;
  for (int changes = 1 + random.below(4); changes > 0; --changes) {
    const auto at = static_cast<std::size_t>(kHead + random.below(static_cast<int>(link.size()) - kHead));
    const std::size_t length = std::min(link.size() - at, static_cast<std::size_t>(random.below(kLongest)));
    switch (random.below(5)) {
      case 0: link[at] = static_cast<char>(33 + random.below(94)); break;
      case 1: link.erase(at, length); break;
      case 2: link.insert(at, link.substr(at, length)); break;
      case 3: link.resize(at); break;
      default: link.insert(at, std::to_string(random.next())); break;
    }
    if (link.size() <= kHead) link += "e30";
  }
  return link;
}

TEST(DamagedLinks, AreCasesOrErrorsWithAReason) {
  const std::vector<std::string> links = whole_links();
  test::TestRandom random(48);
  int cases = 0, volumes = 0;
  for (int n = 0; n < link_count(); ++n) {
    const std::string& whole = links[static_cast<std::size_t>(n) % links.size()];
    const std::string link = n < 4 ? whole : damaged(whole, random);
    const Result<Recipe> recipe = recipe_of_link(link);
    if (!recipe) {
      EXPECT_FALSE(recipe.error().message.empty()) << link;
      continue;
    }
    ++cases;
    if (!recipe->source.inlined) continue;
    const Result<LabelVolume> volume = make_volume(recipe->source);
    if (!volume) {
      EXPECT_FALSE(volume.error().message.empty()) << link;
      continue;
    }
    ++volumes;
    EXPECT_EQ(volume->labels.size(), volume->voxel_count()) << link;
  }
  EXPECT_GE(cases, 4);
  EXPECT_GE(volumes, 2);
  RecordProperty("cases", cases);
  RecordProperty("volumes", volumes);
}

}  // namespace
}  // namespace voxtet
