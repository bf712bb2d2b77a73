// Walls measured by a session: when, and what they are for.
#include <gtest/gtest.h>

#include "pipeline/exports/field_volume.h"
#include "pipeline/session.h"
#include "support/check_tets.h"

namespace voxtet {
namespace {

Recipe layered_shell() {
  Recipe recipe;
  PhantomParams& phantom = recipe.source.phantom.emplace();
  phantom.kind = PhantomKind::kShell;
  phantom.radius_mm = 16;
  phantom.inner_radius_mm = 10;
  phantom.spacing_mm = Eigen::Vector3d::Constant(1);
  recipe.sizing.thickness.resize(1);
  recipe.sizing.thickness[0].wall = {1};
  recipe.sizing.thickness[0].layers = 2;
  return recipe;
}

TEST(SessionWalls, SizesAWallByItsThicknessAndShowsItsFields) {
  Session session;
  ASSERT_TRUE(session.set_recipe(layered_shell()).ok());
  RunContext ctx;
  EXPECT_FALSE(field_volume(session, "thickness").ok());
  const Status done = session.run(Stage::kQuality, ctx);
  ASSERT_TRUE(done.ok()) << done.error().message;
  test::check_tets(*session.mesh());
  EXPECT_NEAR(session.sizing()->at({13, 0, 0}), 3, 0.15);

  const LabelVolume& volume = *session.volume();
  const ScalarVolume thickness = field_volume(session, "thickness").value();
  const ScalarVolume potential = field_volume(session, "potential").value();
  ASSERT_EQ(thickness.values.size(), volume.voxel_count());
  std::size_t apart = 0;
  for (std::size_t at = 0; at < volume.voxel_count(); ++at) {
    apart += (thickness.values[at] > 0) != (volume.labels[at] == 1);
    EXPECT_EQ(thickness.values[at] > 0, potential.values[at] >= 0);
    if (thickness.values[at] > 0) {
      EXPECT_NEAR(thickness.values[at], 6, 0.6);
    }
  }
  EXPECT_LT(apart, volume.voxel_count() / 1000);  // the smoothed surface may pass a voxel's centre
  EXPECT_FALSE(field_volume(session, "beauty").ok());
}

TEST(SessionWalls, MeasuresWallsAgainOnlyWhereTheyAreOthers) {
  Session session;
  Recipe recipe = layered_shell();
  // Measuring asks more often than the rest of the stage whether to stop.
  const auto polls = [&] {
    int count = 0;
    RunContext ctx;
    ctx.on_cancelled = [&] { return ++count < 0; };
    EXPECT_TRUE(session.set_recipe(recipe).ok());
    EXPECT_TRUE(session.run(Stage::kSmooth, ctx).ok());
    count = 0;
    EXPECT_TRUE(session.run(Stage::kSizing, ctx).ok());
    return count;
  };
  const int first = polls();
  recipe.sizing.thickness[0].layers = 3;
  EXPECT_LT(polls(), first);
  EXPECT_NEAR(session.sizing()->at({13, 0, 0}), 2, 0.1) << "from the walls that were there";
  recipe.smooth.iterations += 1;
  EXPECT_EQ(polls(), first);
  recipe.sizing.thickness.clear();
  polls();
  EXPECT_TRUE(session.walls().empty());
}

TEST(SessionWalls, WithoutAWallThereIsNoThicknessToShow) {
  Session session;
  Recipe recipe = layered_shell();
  recipe.sizing.thickness.clear();
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  RunContext ctx;
  ASSERT_TRUE(session.run(Stage::kSizing, ctx).ok());
  EXPECT_TRUE(field_volume(session, "size").ok());
  const Result<ScalarVolume> none = field_volume(session, "thickness");
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().message.find("sizing.thickness names no wall"), std::string::npos);
}

}  // namespace
}  // namespace voxtet
