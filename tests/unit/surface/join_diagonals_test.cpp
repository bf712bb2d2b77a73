#include "surface/smooth/join_diagonals.h"

#include <gtest/gtest.h>

#include "extracted.h"
#include "geometry/intersect/self_intersections.h"
#include "geometry/topology/label_topology.h"
#include "smoothed.h"
#include "support/check_surface.h"
#include "support/label_bodies.h"
#include "support/random_labels.h"
#include "support/surface_labels.h"

namespace voxtet {
namespace {

using test::extract;
using test::smooth;

/// As extracted, without the vertices that are joined. Index space.
SurfaceMesh joined(const LabelVolume& volume) {
  RunContext ctx;
  SurfaceMesh raw = extract(volume, ExtractMethod::kMarchingTets);
  const auto left = join_diagonals(volume, raw, raw.points, raw.points, ctx);
  EXPECT_TRUE(left.has_value());
  SurfaceMesh out{{}, left->triangles, {}};
  for (const std::uint32_t v : left->vertex_of) out.points.push_back(raw.points[v]);
  for (const std::uint32_t t : left->triangle_of) out.sides.push_back(raw.sides[t]);
  return out;
}

double share(const SurfaceMesh& of, const SurfaceMesh& all) {
  return static_cast<double>(of.triangles.size()) / static_cast<double>(all.triangles.size());
}

TEST(JoinDiagonals, LeavesLittleMoreThanAThirdOfASmoothHeart) {
  const LabelVolume heart = test::heart_volume(72, 60, 66);
  const SurfaceMesh raw = extract(heart);
  const SurfaceMesh surface = smooth(raw, heart);
  EXPECT_LT(share(surface, raw), 0.45);
  EXPECT_GT(share(surface, raw), 0.25);
  EXPECT_TRUE(test::is_valid_surface(surface));
  EXPECT_EQ(label_topology(surface), label_topology(raw));
}

TEST(JoinDiagonals, KeepsTopologyAndMakesNoIntersectionsOfRandomVolumes) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    LabelVolume volume = test::random_labels(seed).volume;
    volume.index_to_mm.setIdentity();
    const SurfaceMesh surface = joined(volume);
    ASSERT_TRUE(test::is_valid_surface(surface)) << seed;
    ASSERT_EQ(label_topology(surface), label_topology(extract(volume, ExtractMethod::kMarchingTets))) << seed;
    ASSERT_TRUE(find_self_intersections(surface, 1).empty()) << seed;
    const test::ChangedVoxels changed = test::changed_voxels(surface, volume);
    ASSERT_EQ(changed.all, 0U) << seed;
  }
}

TEST(JoinDiagonals, LeavesThinStructuresAsTheyAre) {
  const LabelVolume sheet = test::make_volume(
      12, 12, 9, [](int i, int j, int k) { return k == 4 && i > 2 && j > 2 && i < 9 && j < 9; });
  EXPECT_EQ(share(joined(sheet), extract(sheet, ExtractMethod::kMarchingTets)), 1);
}

TEST(JoinDiagonals, EndsWhenCancelled) {
  RunContext ctx;
  ctx.on_cancelled = [] { return true; };
  const LabelVolume heart = test::heart_volume(24, 20, 22);
  const SurfaceMesh raw = extract(heart);
  EXPECT_FALSE(join_diagonals(heart, raw, raw.points, raw.points, ctx).has_value());
}

}  // namespace
}  // namespace voxtet
