// Walls with fewer edges across than they are to have layers.
#include "tetra/optimise/deepen_walls.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/check_tets.h"
#include "support/slab_wall.h"
#include "support/test_surfaces.h"
#include "walls/wall_mesh.h"

namespace voxtet {
namespace {

constexpr int kBricks = 12;  ///< along a side of the slab
constexpr double kTargetMm = 1.5;

TetMesh deepened(const TetMesh& mesh, std::uint32_t layers) {
  const WallField field = test::slab_wall();
  const SizingField sizing = test::uniform_sizing(kTargetMm);
  RunContext ctx;
  return deepen_walls(mesh, std::vector<LayeredWall>{{field, layers}}, sizing, ctx).value();
}

/// The fewest edges across, away from the rim.
std::uint32_t fewest_across(const TetMesh& mesh) {
  const WallField field = test::slab_wall();
  const WallMesh wall(mesh, field);
  const std::vector<std::uint32_t> from_outer = wall.from_judged_outer();
  std::uint32_t fewest = kUnreached;
  for (std::size_t v = 0; v < from_outer.size(); ++v)
    fewest = std::min(fewest, wall.from_inner()[v] + from_outer[v]);
  return fewest;
}

/// Labels, faces and points stay, and no angle below 25 degrees comes in.
void expect_kept(const TetMesh& before, const TetMesh& after) {
  test::check_tets(after);
  ASSERT_GE(after.points.size(), before.points.size());
  EXPECT_TRUE(std::equal(before.points.begin(), before.points.end(), after.points.begin()));
  EXPECT_EQ(after.faces, before.faces);
  EXPECT_EQ(after.face_sides, before.face_sides);
  EXPECT_GE(test::smallest_dihedral_deg(after), std::min(25.0, test::smallest_dihedral_deg(before)));
}

TEST(DeepenWalls, PutsVerticesOnShortWays) {
  const TetMesh before = test::slab(kBricks, 2);
  ASSERT_EQ(fewest_across(before), 2U);
  const TetMesh after = deepened(before, 3);
  EXPECT_EQ(fewest_across(after), 3U);
  expect_kept(before, after);
}

TEST(DeepenWalls, LeavesWhatAVertexWouldMakeTooSlender) {
  const TetMesh before = test::slab(kBricks, 1);
  const TetMesh after = deepened(before, 2);
  EXPECT_EQ(fewest_across(after), 1U);
  expect_kept(before, after);
}

TEST(DeepenWalls, LeavesOthersAsTheyAre) {
  const TetMesh before = test::slab(kBricks, 3);
  for (const std::uint32_t layers : {1U, 2U, 3U}) {
    const TetMesh after = deepened(before, layers);
    EXPECT_EQ(after.points, before.points);
    EXPECT_EQ(after.tets, before.tets);
  }
}

TEST(DeepenWalls, CanBeCancelled) {
  const WallField field = test::slab_wall();
  const SizingField sizing = test::uniform_sizing(kTargetMm);
  RunContext ctx;
  ctx.on_cancelled = [] { return true; };
  const Result<TetMesh> none =
      deepen_walls(test::slab(kBricks, 2), std::vector<LayeredWall>{{field, 3}}, sizing, ctx);
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace voxtet
