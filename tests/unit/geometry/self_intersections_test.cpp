#include "geometry/self_intersections.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace voxtet
