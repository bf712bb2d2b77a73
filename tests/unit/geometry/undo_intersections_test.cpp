#include "geometry/repair/undo_intersections.h"

#include <gtest/gtest.h>

#include "base/digest.h"
#include "geometry/intersect/self_intersections.h"
#include "support/test_random.h"
#include "support/test_surfaces.h"

namespace voxtet {
namespace {

/// Two spheres side by side, their points pushed around by up to `reach` along each axis.
struct Deformed {
  std::vector<Eigen::Vector3d> start;
  SurfaceMesh surface;
};

Deformed pushed_spheres(double reach, std::uint64_t seed) {
  Deformed out;
  out.surface = test::sphere({0, 0, 0}, 5, 3, 1, 0);
  test::append(out.surface, test::sphere({10.2, 0, 0}, 5, 3, 2, 0));
  out.start = out.surface.points;
  test::TestRandom random(seed);
  for (Eigen::Vector3d& p : out.surface.points)
    for (int d = 0; d < 3; ++d) p[d] += reach * (random.below(2001) - 1000) / 1000.0;
  return out;
}

TEST(UndoIntersections, LeavesNoIntersectionAndEveryPointBetweenStartAndGoal) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Deformed deformed = pushed_spheres(0.5 + 0.2 * static_cast<double>(seed), seed);
    const SurfaceMesh goal = deformed.surface;
    ASSERT_FALSE(find_self_intersections(goal).empty());
    const UndoOutcome outcome = undo_intersections(deformed.surface, deformed.start, {});
    EXPECT_TRUE(find_self_intersections(deformed.surface).empty()) << seed;
    EXPECT_GT(outcome.rounds, 0);
    EXPECT_FALSE(outcome.cancelled);
    std::size_t back = 0;
    for (std::size_t v = 0; v < goal.points.size(); ++v) {
      const Eigen::Vector3d &p = deformed.surface.points[v], &s = deformed.start[v], &g = goal.points[v];
      back += p != g ? 1 : 0;
      EXPECT_NEAR((p - s).norm() + (g - p).norm(), (g - s).norm(), 1e-12);
    }
    EXPECT_EQ(outcome.moved_back, back);
    EXPECT_EQ(deformed.surface.triangles, goal.triangles);
  }
}

TEST(UndoIntersections, LeavesACleanSurfaceAlone) {
  Deformed deformed = pushed_spheres(0.01, 3);
  const SurfaceMesh goal = deformed.surface;
  const UndoOutcome outcome = undo_intersections(deformed.surface, deformed.start, {});
  EXPECT_EQ(outcome.rounds, 0);
  EXPECT_EQ(outcome.moved_back, 0U);
  EXPECT_EQ(deformed.surface.points, goal.points);
}

TEST(UndoIntersections, MovesBackOnlyWhatIsNearTheIntersections) {
  Deformed deformed;
  deformed.surface = test::sphere({0, 0, 0}, 5, 3, 1, 0);
  test::append(deformed.surface, test::sphere({10.2, 0, 0}, 5, 3, 2, 0));
  deformed.start = deformed.surface.points;
  for (Eigen::Vector3d& p : deformed.surface.points) p *= 1 - 0.001 * p.x();  // the second one comes nearer
  const std::size_t half = deformed.start.size() / 2;
  for (std::size_t v = 0; v < half; ++v) deformed.surface.points[v].x() += 0.4;
  ASSERT_FALSE(find_self_intersections(deformed.surface).empty());
  const UndoOutcome outcome = undo_intersections(deformed.surface, deformed.start, {});
  EXPECT_TRUE(find_self_intersections(deformed.surface).empty());
  EXPECT_LT(outcome.moved_back, deformed.start.size() / 4);
}

TEST(UndoIntersections, GivesTheSameBytesForAnyNumberOfThreads) {
  Deformed one = pushed_spheres(0.9, 5), three = one;
  RunContext ctx;
  undo_intersections(one.surface, one.start, ctx);
  ctx.threads = 3;
  undo_intersections(three.surface, three.start, ctx);
  EXPECT_EQ(digest_of(one.surface), digest_of(three.surface));
}

TEST(UndoIntersections, StopsWhenCancelled) {
  Deformed deformed = pushed_spheres(0.9, 5);
  RunContext ctx;
  ctx.on_cancelled = [] { return true; };
  EXPECT_TRUE(undo_intersections(deformed.surface, deformed.start, ctx).cancelled);
}

}  // namespace
}  // namespace voxtet
