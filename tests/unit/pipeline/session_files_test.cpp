// The files of a session: its volume, masks and images of sizes.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/digest.h"
#include "io/volume/write_volume.h"
#include "phantom/make_phantom.h"
#include "pipeline/report.h"
#include "pipeline/session.h"
#include "pipeline/sources/source_volume.h"
#include "recipe/link.h"
#include "unit/pipeline/small_case.h"

namespace voxtet {
namespace {

/// A cube in 6 x 6 x 6 voxels; `named`: and a second segment, which has no voxels.
Bytes cube_with_empty_segment(bool named) {
  std::string text =
      "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 6 6 6\nspace: right-anterior-superior\n"
      "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\nencoding: raw\n"
      "Segment0_Name:=cube\nSegment0_LabelValue:=1\n";
  if (named) text += "Segment1_Name:=scar\nSegment1_LabelValue:=2\n";
  text += "\n";
  for (int v = 0; v < 216; ++v) {
    const auto inside = [](int i) { return i > 0 && i < 5; };
    text += static_cast<char>(inside(v % 6) && inside(v / 6 % 6) && inside(v / 36));
  }
  return {text.begin(), text.end()};
}

TEST(Session, WarnsOfWhatTheReaderFoundAsLongAsTheFileIsTheSource) {
  const Bytes with = cube_with_empty_segment(true), without = cube_with_empty_segment(false);
  const std::vector<std::string> warning{"volume: a.nrrd: segment scar (label 2) has no voxels"};
  Session session;
  RunContext ctx;
  // The two files have the same labels, and so the same digest.
  for (const bool warned : {false, true, false}) {
    ASSERT_TRUE(session.load_volume({"a.nrrd", warned ? with : without, {}}).ok());
    ASSERT_TRUE(session.run(Stage::kVolume, ctx).ok());
    Recipe recipe = session.recipe();
    recipe.labels = {1};
    ASSERT_TRUE(session.set_recipe(recipe).ok());
    for (const char* times : {"once", "again, from the cache"}) {
      ASSERT_TRUE(session.run(Stage::kVolume, ctx).ok()) << times;
      EXPECT_EQ(session.warnings(), warned ? warning : std::vector<std::string>{}) << times;
      EXPECT_EQ(volume_json(session)["warnings"], session.warnings()) << times;
    }
  }
  Recipe recipe = session.recipe();
  recipe.sizing.masks.push_back({"mask.nrrd", {}, {{1, 1.0}}});
  ASSERT_TRUE(session.load_mask({"mask.nrrd", with, {}}).ok());
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  ASSERT_TRUE(session.run(Stage::kSizing, ctx).ok());
  EXPECT_EQ(session.warnings(),
            std::vector<std::string>{"sizing: mask.nrrd: segment scar (label 2) has no voxels"});
}

/// Two boxes in layers of their own, the later one over the whole of the earlier one.
Bytes layered_boxes() {
  std::string text =
      "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 2 8 8 8\nencoding: raw\nspace: RAS\n"
      "space directions: none (1,0,0) (0,1,0) (0,0,1)\nSegment0_Name:=inner\nSegment0_Layer:=0\n"
      "Segment1_Name:=outer\nSegment1_Layer:=1\n\n";
  for (int v = 0; v < 512; ++v) {
    const auto inside = [v](int from, int to) {
      for (const int i : {v % 8, v / 8 % 8, v / 64})
        if (i < from || i >= to) return false;
      return true;
    };
    text += static_cast<char>(inside(3, 5));
    text += static_cast<char>(inside(1, 7));
  }
  return {text.begin(), text.end()};
}

TEST(Session, ReadsAVolumeByTheOptionsOfItsSource) {
  const Bytes file = layered_boxes();
  const auto voxels_of_inner = [](const Session& session) {
    const std::vector<Label>& labels = session.source_volume()->labels;
    return std::count(labels.begin(), labels.end(), Label{1});
  };
  Session session;
  RunContext ctx;
  ASSERT_TRUE(session.load_volume({"a.seg.nrrd", file, {}}).ok());
  ASSERT_TRUE(session.run(Stage::kVolume, ctx).ok());
  EXPECT_EQ(voxels_of_inner(session), 0);
  EXPECT_NE(session.warnings()[0].find("SEGMENT LOST: segment inner"), std::string::npos);
  Recipe recipe = session.recipe();
  recipe.source.file->sha256.clear();
  recipe.source.read.precedence = {"inner"};
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  const Status stale = session.run(Stage::kVolume, ctx);
  ASSERT_FALSE(stale.ok());
  EXPECT_EQ(stale.error().code, ErrorCode::kUsage);
  EXPECT_EQ(stale.error().message,
            "source: found a unit, precedence, background, frame or threshold by which the volume was not "
            "read, expected it "
            "to be loaded again");
  ASSERT_TRUE(session.load_volume({"a.seg.nrrd", file, {}}, recipe.source.read).ok());
  ASSERT_TRUE(session.run(Stage::kVolume, ctx).ok());
  EXPECT_EQ(voxels_of_inner(session), 8);
  EXPECT_EQ(session.recipe().source.read, recipe.source.read);
}

/// Label 1 everywhere in the space of small_case.
Bytes painted_everywhere() {
  LabelVolume mask;
  mask.size = {2, 2, 2};
  mask.index_to_mm.diagonal().head<3>().setConstant(100);
  mask.index_to_mm.topRightCorner<3, 1>().setConstant(-50);
  mask.labels.assign(8, 1);
  return write_nifti(mask, false).value();
}

void expect_sizing_error(Session& session, const std::string& part) {
  RunContext ctx;
  const Status done = session.run(Stage::kSizing, ctx);
  ASSERT_FALSE(done.ok()) << part;
  EXPECT_EQ(done.error().code, ErrorCode::kBadInput);
  EXPECT_NE(done.error().message.find(part), std::string::npos) << done.error().message;
}

TEST(Session, TakesMasksByNameAndDigest) {
  Session session;
  Recipe recipe = test::small_case();
  recipe.sizing.masks.resize(1);
  recipe.sizing.masks[0].name = "paint.nii";
  recipe.sizing.masks[0].edges = {{1, 1.25}};
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  expect_sizing_error(session, "sizing.masks[0]: the file 'paint.nii' has not been loaded");

  const Bytes bytes = painted_everywhere();
  ASSERT_TRUE(session.load_mask({"paint.nii", bytes, {}}).ok());
  RunContext ctx;
  ASSERT_TRUE(session.run(Stage::kSizing, ctx).ok());
  EXPECT_NEAR(session.sizing()->at({0, 0, 0}), 1.25, 1e-6);

  recipe.sizing.masks[0].sha256 = std::string(64, 'a');
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  expect_sizing_error(session, "'paint.nii' of digest aaaaaaaaaaaa...");
}

TEST(Session, AnotherSizeImageOfTheSameNameIsANewField) {
  Session session;
  Recipe recipe = test::small_case();
  recipe.sizing.images.resize(1);
  recipe.sizing.images[0].name = "sizes.nii";
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  expect_sizing_error(session, "sizing.images[0]: the file 'sizes.nii' has not been loaded");
  ScalarVolume image;
  image.size = {2, 2, 2};
  image.index_to_mm.diagonal().head<3>().setConstant(100);
  image.index_to_mm.topRightCorner<3, 1>().setConstant(-50);
  for (const float size : {1.5F, 2.5F}) {
    image.values.assign(8, size);
    const Bytes bytes = write_nifti(image, true).value();
    ASSERT_TRUE(session.load_size_image({"sizes.nii", bytes, {}}).ok());
    RunContext ctx;
    ASSERT_TRUE(session.run(Stage::kSizing, ctx).ok());
    EXPECT_NEAR(session.sizing()->at({0, 0, 0}), size, 1e-6);
  }
}

TEST(InlineSource, GivesTheMeshOfItsFile) {
  const Bytes file = *write_nifti(*make_phantom(*test::small_case().source.phantom), true);
  Session from_file;
  ASSERT_TRUE(from_file.load_volume({"body.nii.gz", file, {}}).ok());
  Recipe recipe = from_file.recipe();
  recipe.sizing.edge_mm = 4;
  recipe.legend = {{2, "outer", ""}};
  ASSERT_TRUE(from_file.set_recipe(recipe).ok());
  RunContext ctx;
  ASSERT_TRUE(from_file.run(Stage::kOptimise, ctx).ok());

  LabelVolume volume = *from_file.source_volume();
  volume.infos = {{1, "inner", {0.5F, 0, 1}}};
  const Result<Recipe> inlined = with_inline_volume(recipe, volume);
  ASSERT_TRUE(inlined.ok());
  EXPECT_EQ(inlined->source.inlined->name, "body.nii.gz");
  EXPECT_FALSE(inlined->source.file);
  ASSERT_EQ(inlined->legend.size(), 2U);
  EXPECT_EQ(inlined->legend[0].name, "inner");
  EXPECT_EQ(inlined->legend[0].colour, "#8000ff");
  const Result<Recipe> linked = recipe_of_link(link_fragment(*inlined));
  ASSERT_TRUE(linked.ok()) << linked.error().message;
  Session from_link;
  ASSERT_TRUE(from_link.set_recipe(*linked).ok());
  const Status done = from_link.run(Stage::kOptimise, ctx);
  ASSERT_TRUE(done.ok()) << done.error().message;
  EXPECT_EQ(digest_of(*from_link.mesh()), digest_of(*from_file.mesh()));
  EXPECT_EQ(from_link.source_digest(), from_file.source_digest());
  EXPECT_EQ(report_json(from_link)["source"]["name"], "body.nii.gz");
}

TEST(InlineSource, SaysWhatIsWrongWithItsData) {
  const auto message = [](const std::string& data) {
    Recipe recipe;
    recipe.source.inlined = InlineSource{"body", data};
    Session session;
    EXPECT_TRUE(session.set_recipe(recipe).ok());
    RunContext ctx;
    const Status done = session.run(Stage::kVolume, ctx);
    return done.ok() ? std::string("read") : done.error().message;
  };
  EXPECT_EQ(message("AB*"), "source.inline.data holds the character '*', which base64url does not");
  EXPECT_EQ(message("AQ"), "source.inline.data: the coded volume is damaged: its size is out of range");
  EXPECT_NE(message("").find("damaged"), std::string::npos);
}

}  // namespace
}  // namespace voxtet
