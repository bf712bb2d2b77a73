#include "geometry/intersect/self_intersections.h"

#include <gtest/gtest.h>

#include "support/exact_intersection.h"
#include "support/test_random.h"
#include "support/test_surfaces.h"

namespace voxtet {
namespace {

using Pairs = std::vector<std::array<std::uint32_t, 2>>;

SurfaceMesh triangles(std::vector<Eigen::Vector3d> points, std::vector<Triangle> corners) {
  SurfaceMesh surface;
  surface.points = std::move(points);
  surface.triangles = std::move(corners);
  surface.sides.assign(surface.triangles.size(), {1, 0});
  return surface;
}

TEST(FindSelfIntersections, FindsNoneInSpheresAndLabelledCells) {
  EXPECT_EQ(find_self_intersections(test::sphere({0, 0, 0}, 5, 3, 1, 0)), Pairs{});
  const auto labels = [](int i, int j, int k) { return Label((i * 7 + j * 5 + k * 3) % 4); };
  EXPECT_EQ(find_self_intersections(test::cells({5, 5, 5}, 1, labels)), Pairs{});
}

TEST(FindSelfIntersections, FindsTrianglesThatCrossWithoutACommonCorner) {
  const SurfaceMesh crossing = triangles(
      {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, -1}, {0.6, 0.5, 1}, {3, 3, 1}}, {{0, 1, 2}, {3, 4, 5}});
  EXPECT_EQ(find_self_intersections(crossing), (Pairs{{0, 1}}));
}

TEST(FindSelfIntersections, FindsTrianglesThatCrossBeyondACommonCorner) {
  const std::vector<Eigen::Vector3d> points{{0, 0, 0},  {2, 0, 0},   {0, 2, 0},
                                            {1, 1, -1}, {1, 0.5, 1}, {1, 3, 1}};
  EXPECT_EQ(find_self_intersections(triangles(points, {{0, 1, 2}, {0, 3, 4}, {0, 5, 4}})), (Pairs{{0, 1}}));
}

TEST(FindSelfIntersections, FindsTrianglesFoldedOntoEachOtherAlongAnEdge) {
  const std::vector<Eigen::Vector3d> points{{0, 0, 0}, {2, 0, 0},  {1, 1, 0},
                                            {1, 2, 0}, {1, -2, 0}, {1, 1, 1e-300}};
  EXPECT_EQ(find_self_intersections(triangles(points, {{0, 1, 2}, {1, 0, 3}, {1, 0, 4}})), (Pairs{{0, 1}}));
  EXPECT_EQ(find_self_intersections(triangles(points, {{0, 1, 3}, {1, 0, 5}})), Pairs{});
}

TEST(FindSelfIntersections, FindsDuplicates) {
  const std::vector<Eigen::Vector3d> points{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}};
  EXPECT_EQ(find_self_intersections(triangles(points, {{0, 1, 2}, {1, 0, 2}})), (Pairs{{0, 1}}));
}

TEST(FindSelfIntersections, StopsAtTheMaximum) {
  SurfaceMesh surface = test::sphere({0, 0, 0}, 5, 3, 1, 0);
  test::append(surface, test::sphere({1, 0.1, 0.2}, 5, 3, 2, 0));
  EXPECT_GT(find_self_intersections(surface).size(), 20U);
  EXPECT_EQ(find_self_intersections(surface, 20).size(), 20U);
}

/// Triangles between neighbouring points of a shuffled lattice, and some between any points.
SurfaceMesh soup(std::uint64_t seed) {
  test::TestRandom random(seed);
  SurfaceMesh surface;
  for (int i = 0; i < 48; ++i)
    surface.points.push_back(Eigen::Vector3d{1.0 * random.below(6), 1.0 * random.below(6),
                                             0.5 * random.below(6) + 1e-9 * random.below(2)});
  while (surface.triangles.size() < 64) {
    const auto any = [&] { return static_cast<std::uint32_t>(random.below(48)); };
    const Triangle t{any(), any(), any()};
    const auto far = [&](std::uint32_t a, std::uint32_t b) {
      return (surface.points[a] - surface.points[b]).squaredNorm() > 9;
    };
    if (t[0] == t[1] || t[1] == t[2] || t[0] == t[2]) continue;
    if (random.below(10) > 0 && (far(t[0], t[1]) || far(t[1], t[2]) || far(t[0], t[2]))) continue;
    if (test::has_area(surface.points, t)) surface.triangles.push_back(t);
  }
  return surface;
}

TEST(FindSelfIntersections, AgreesWithAllPairsConstructedExactly) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const SurfaceMesh surface = soup(seed);
    std::vector<std::uint8_t> concerned(surface.triangles.size(), 0);
    for (std::size_t t = 0; t < concerned.size(); t += 7) concerned[t] = 1;
    Pairs all, some;
    for (std::uint32_t a = 0; a < surface.triangles.size(); ++a)
      for (std::uint32_t b = a + 1; b < surface.triangles.size(); ++b) {
        if (!test::meet_beyond_shared(surface.points, surface.triangles[a], surface.triangles[b])) continue;
        all.push_back({a, b});
        if (concerned[a] || concerned[b]) some.push_back({a, b});
      }
    EXPECT_GT(some.size(), 20U);
    EXPECT_LT(some.size(), all.size());
    EXPECT_EQ(find_self_intersections(surface), all) << seed;
    EXPECT_EQ(SelfIntersectionTree(surface).find(concerned), some) << seed;
  }
}

TEST(FindSelfIntersections, FollowsPointsThatMoveAfterTheTreeWasBuilt) {
  SurfaceMesh surface = test::sphere({0, 0, 0}, 5, 3, 1, 0);
  test::append(surface, test::sphere({20, 0, 0}, 5, 3, 2, 0));
  SelfIntersectionTree tree(surface);
  EXPECT_TRUE(tree.find().empty());
  for (std::size_t v = surface.points.size() / 2; v < surface.points.size(); ++v) surface.points[v].x() -= 19;
  EXPECT_EQ(tree.find(), find_self_intersections(surface));
  EXPECT_FALSE(tree.find().empty());
}

TEST(FindSelfIntersections, GivesTheSamePairsForAnyNumberOfThreads) {
  SurfaceMesh surface = test::sphere({0, 0, 0}, 5, 5, 1, 0);
  test::append(surface, test::sphere({1, 0.1, 0.2}, 5, 5, 2, 0));
  for (const std::size_t most : {std::size_t{1}, std::size_t{50}, std::size_t{100000}}) {
    const Pairs one = find_self_intersections(surface, most, 1);
    EXPECT_EQ(find_self_intersections(surface, most, 2), one);
    EXPECT_EQ(find_self_intersections(surface, most, 5), one);
  }
}

TEST(FindSelfIntersections, TakesAnEmptySurface) {
  EXPECT_TRUE(find_self_intersections(SurfaceMesh{}).empty());
}

}  // namespace
}  // namespace voxtet
