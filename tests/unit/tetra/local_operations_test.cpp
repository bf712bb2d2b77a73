#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>
#include <utility>

#include "support/check_tets.h"
#include "support/labelled_mesh.h"
#include "support/test_surfaces.h"
#include "tetra/interfaces/nearby_surface.h"
#include "tetra/operations/edge_removal.h"
#include "tetra/operations/face_removal.h"
#include "tetra/operations/size_smoothing.h"
#include "tetra/operations/vertex_insertion.h"
#include "tetra/operations/vertex_smoothing.h"

namespace voxtet::tetra {
namespace {

/// All of label 1.
TetMesh mesh_of(std::vector<Point> points, std::vector<Tet> tets) {
  TetMesh mesh;
  mesh.points = std::move(points);
  mesh.tets = std::move(tets);
  mesh.labels.assign(mesh.tets.size(), 1);
  test::add_faces(mesh);
  return mesh;
}

double lowest_quality(const TetMesh& mesh) {
  double lowest = 1;
  for (const Tet& t : mesh.tets)
    lowest =
        std::min(lowest, quality(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]], mesh.points[t[3]]));
  return lowest;
}

std::size_t tets_with(const TetMesh& mesh, std::uint32_t v, std::uint32_t w) {
  return static_cast<std::size_t>(std::count_if(mesh.tets.begin(), mesh.tets.end(), [&](const Tet& t) {
    return std::count(t.begin(), t.end(), v) + std::count(t.begin(), t.end(), w) == 2;
  }));
}

/// Around the edge from (0, 0, height) to (0, 0, -height), points 0 and 1; the ring, from point 2 on, is
/// counterclockwise seen from point 0.
TetMesh ring_mesh(double height, const std::vector<Point>& ring) {
  std::vector<Point> points{{0, 0, height}, {0, 0, -height}};
  points.insert(points.end(), ring.begin(), ring.end());
  std::vector<Tet> tets;
  const auto n = static_cast<std::uint32_t>(ring.size());
  for (std::uint32_t i = 0; i < n; ++i) tets.push_back({1, 0, 2 + i, 2 + (i + 1) % n});
  return mesh_of(points, tets);
}

const std::vector<Point> kTriangle{{1, 0, 0}, {-0.5, 0.8, 0}, {-0.5, -0.8, 0}};
/// Its shorter diagonal joins points 3 and 5.
const std::vector<Point> kSquare{{1, 0, 0}, {0, 0.9, 0}, {-1, 0, 0}, {0, -0.9, 0}};

const SizingField kTarget = test::uniform_sizing(2);

/// Tries the side opposite to `apex` of each tet at it.
bool remove_faces_below(TetComplex& complex, std::uint32_t apex, const SizeGuard& guard) {
  for (std::uint32_t t = 0; t < complex.places(); ++t)
    if (complex.corner_at(t, apex) < 4 && remove_faces(complex, t, complex.corner_at(t, apex), guard))
      return true;
  return false;
}

/// The edge from point 0 to point 1 is between the first two corners of tet 0.
TetMesh without_edge(TetMesh mesh, bool expected) {
  TetComplex complex(std::move(mesh));
  EXPECT_EQ(remove_edge(complex, 0, 0, 1, SizeGuard(kTarget)), expected);
  return std::move(complex).release();
}

TEST(RemoveEdge, MakesTwoOfThreeTetsWhereTheAxisIsLong) {
  const TetMesh before = ring_mesh(1.2, kTriangle), after = without_edge(before, true);
  EXPECT_EQ(after.tets.size(), 2U);
  EXPECT_EQ(tets_with(after, 0, 1), 0U);
  EXPECT_GT(lowest_quality(after), lowest_quality(before));
  test::check_tets(after);
}

TEST(RemoveEdge, MakesFourOfFourTetsAroundTheShorterDiagonal) {
  const TetMesh before = ring_mesh(2, kSquare), after = without_edge(before, true);
  EXPECT_EQ(after.tets.size(), 4U);
  EXPECT_EQ(tets_with(after, 3, 5), 4U);
  EXPECT_GT(lowest_quality(after), lowest_quality(before));
  test::check_tets(after);
}

TEST(RemoveEdge, LeavesWhatWouldNotGainAndEdgesOnInterfaces) {
  EXPECT_EQ(without_edge(ring_mesh(0.3, kTriangle), false).tets.size(), 3U);
  TetMesh two_labels = ring_mesh(1.2, kTriangle);
  two_labels.labels[0] = 2;
  two_labels.faces.clear();
  two_labels.face_sides.clear();
  test::add_faces(two_labels);
  EXPECT_EQ(without_edge(two_labels, false).tets.size(), 3U);
}

TEST(RemoveEdge, KeepsNewEdgesNearTheTarget) {
  const SizingField small = test::uniform_sizing(0.4);
  TetComplex complex(ring_mesh(0.8, {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}));
  EXPECT_FALSE(remove_edge(complex, 0, 0, 1, SizeGuard(small)))
      << "diagonals of 2 for an edge of 1.6, target 0.4";
}

TEST(RemoveFaces, MakesThreeOfTwoTetsWhereTheApexesAreNear) {
  const SizeGuard guard(kTarget);
  TetMesh before = mesh_of({{0, 0, 0.42}, {0, 0, -0.42}, kTriangle[0], kTriangle[1], kTriangle[2]},
                           {{2, 3, 4, 0}, {2, 4, 3, 1}});
  TetComplex complex(before);
  ASSERT_TRUE(remove_faces_below(complex, 0, guard));
  const TetMesh after = std::move(complex).release();
  EXPECT_EQ(tets_with(after, 0, 1), 3U);
  EXPECT_EQ(after.tets.size(), 3U);
  EXPECT_GT(lowest_quality(after), lowest_quality(before));
  test::check_tets(after);
}

TEST(RemoveFaces, TakesTwoFacesBetweenTheSameApexes) {
  const SizeGuard guard(kTarget);
  const TetMesh before = mesh_of({{0, 0, 0.6}, {0, 0, -0.6}, kSquare[0], kSquare[1], kSquare[2], kSquare[3]},
                                 {{2, 3, 5, 0}, {3, 4, 5, 0}, {2, 5, 3, 1}, {3, 5, 4, 1}});
  TetComplex complex(before);
  ASSERT_TRUE(remove_faces_below(complex, 0, guard));
  const TetMesh after = std::move(complex).release();
  EXPECT_EQ(tets_with(after, 0, 1), 4U);
  EXPECT_EQ(after.tets.size(), 4U);
  EXPECT_GT(lowest_quality(after), lowest_quality(before));
  test::check_tets(after);
}

/// The best lowest quality over all triangulations of the ring from i to j.
double best_by_trying(const TetComplex& complex, const EdgeRing& ring, std::uint32_t i, std::uint32_t j) {
  if (j < i + 2) return std::numeric_limits<double>::infinity();
  double best = 0;
  for (std::uint32_t k = i + 1; k < j; ++k) {
    const std::uint32_t x = ring.ring[i], y = ring.ring[k], z = ring.ring[j];
    best = std::max(best,
                    std::min({best_by_trying(complex, ring, i, k), best_by_trying(complex, ring, k, j),
                              complex.quality_at({x, y, z, ring.b}), complex.quality_at({x, z, y, ring.a})}));
  }
  return best;
}

TEST(FillRing, FindsTheBestOfAllTriangulations) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.4, 0.4);
  constexpr double kTurn[7][2] = {{1, 0},        {0.62, 0.78},   {-0.22, 0.97}, {-0.9, 0.43},
                                  {-0.9, -0.43}, {-0.22, -0.97}, {0.62, -0.78}};
  int filled = 0;
  for (std::size_t size = 3; size <= 7; ++size)
    for (int i = 0; i < 100; ++i) {
      std::vector<Point> points;
      for (std::size_t r = 0; r < size; ++r) {
        const double* turn = kTurn[size < 5 ? 7 * r / size : r];
        Point p(turn[0], turn[1], 0);
        for (int d = 0; d < 3; ++d) p[d] += (d == 2 ? 1 : 0.5) * shift(random);
        points.push_back(p);
      }
      const TetMesh mesh = ring_mesh(1.5, points);
      if (lowest_quality(mesh) == 0) continue;
      const TetComplex complex(mesh);
      EdgeRing ring;
      ASSERT_TRUE(complex.find_ring(0, 0, 1, ring));
      ASSERT_EQ(ring.size, size);
      const RingFilling filling = fill_ring(complex, ring, 0);
      EXPECT_EQ(filling.quality, best_by_trying(complex, ring, 0, ring.size - 1));
      if (filling.quality == 0) continue;
      ++filled;
      EXPECT_EQ(fill_ring(complex, ring, filling.quality).quality, 0) << "nothing is better than the best";
    }
  EXPECT_GT(filled, 100);
}

TEST(NearestInHull, IsNoFartherThanAnyPointOfTheHull) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 400; ++i) {
    std::vector<Point> points(1 + static_cast<std::size_t>(i % 4));
    const double away = i % 3;
    for (Point& p : points)
      for (int d = 0; d < 3; ++d) p[d] = normal(random) + (d == 0 ? away : 0);
    const Point nearest = nearest_in_hull(points);
    // The origin is separated from the hull by the plane through the nearest point.
    for (const Point& p : points) EXPECT_GE(p.dot(nearest), nearest.squaredNorm() * (1 - 1e-9) - 1e-12) << i;
  }
}

/// The tets of a cube's six faces, two triangles each, with the point 8 inside.
TetMesh star_in_cube(const Point& apex) {
  std::vector<Point> points;
  for (int c = 0; c < 8; ++c) points.emplace_back(c & 1, (c >> 1) & 1, c >> 2);
  points.push_back(apex);
  std::vector<Tet> tets;
  for (const Triangle& t : {Triangle{0, 2, 3},
                            {0, 3, 1},
                            {4, 5, 7},
                            {4, 7, 6},
                            {0, 1, 5},
                            {0, 5, 4},
                            {2, 6, 7},
                            {2, 7, 3},
                            {0, 4, 6},
                            {0, 6, 2},
                            {1, 3, 7},
                            {1, 7, 5}})
    tets.push_back({8, t[2], t[1], t[0]});
  for (Tet& t : tets)
    if (quality(points[t[0]], points[t[1]], points[t[2]], points[t[3]]) == 0) std::swap(t[2], t[3]);
  return mesh_of(points, tets);
}

TEST(VertexSmoother, CentresTheVertexOfACube) {
  TetComplex complex(star_in_cube({0.8, 0.7, 0.25}));
  const SizingField target = test::uniform_sizing(1);
  const SizeGuard guard(target);
  VertexSmoother smoother(complex, guard);
  for (int i = 0; i < 10; ++i) smoother.smooth(8, 1, 10);
  EXPECT_FALSE(smoother.smooth(8, 0.1, 10)) << "good enough";
  EXPECT_LT((complex.point(8) - Point(0.5, 0.5, 0.5)).norm(), 0.03);
}

TEST(SizeSmoother, EvensOutTheEdgesOfAVertex) {
  const Point start(0.75, 0.65, 0.3), centre(0.5, 0.5, 0.5);
  TetComplex complex(star_in_cube(start));
  const SizingField target = test::uniform_sizing(0.866);
  const SizeGuard guard(target);
  SizeSmoother smoother(complex, guard);
  for (int i = 0; i < 10; ++i) smoother.smooth(8, 0);
  EXPECT_LT((complex.point(8) - centre).norm(), 0.7 * (start - centre).norm());
  EXPECT_FALSE(smoother.smooth(8, 0)) << "near enough";
}

TEST(SizeSmoother, KeepsTheQualityDemanded) {
  const TetMesh before = star_in_cube({0.5, 0.5, 0.5});
  TetComplex complex(before);
  // Long edges below, short ones above: the vertex is drawn up, where its tets become flat.
  SizingField target = test::uniform_sizing(1);
  target.size = {1, 1, 2};
  target.h_mm = {2.0F, 0.3F};
  const SizeGuard guard(target);
  SizeSmoother smoother(complex, guard);
  const double regular = lowest_quality(before);
  EXPECT_FALSE(smoother.smooth(8, regular));
  const double enough = 0.6 * regular;
  bool moved = false;
  for (int i = 0; i < 10; ++i) moved = smoother.smooth(8, enough) || moved;
  EXPECT_TRUE(moved);
  EXPECT_GT(complex.point(8).z(), 0.5);
  EXPECT_GE(lowest_quality(std::move(complex).release()), enough);
}

TEST(VertexInserter, MayPutItsVertexInThePlaceOfAnother) {
  const TetMesh before = star_in_cube({0.5, 0.5, 0.05});
  TetComplex complex(before);
  const SizingField target = test::uniform_sizing(1);
  const SizeGuard guard(target);
  VertexInserter inserter(complex, guard);
  std::uint32_t worst = 0;
  for (std::uint32_t t = 0; t < complex.places(); ++t)
    if (complex.quality_of(t) < complex.quality_of(worst)) worst = t;
  ASSERT_TRUE(inserter.insert(worst));
  const TetMesh after = std::move(complex).release();
  EXPECT_EQ(after.points.size(), 9U);
  EXPECT_NE(after.points.back(), before.points.back());
  EXPECT_GT(lowest_quality(after), 2 * lowest_quality(before));
  test::check_tets(after);
}

TEST(VertexInserter, LeavesWhatWouldBecomeTooSmall) {
  const SizingField large = test::uniform_sizing(10);
  TetComplex complex(
      ring_mesh(3, {{2, 0, 0}, {1, 1.7, 0}, {-1, 1.7, 0}, {-2, 0, 0}, {-1, -1.7, 0}, {1, -1.7, 0}}));
  const SizeGuard guard(large);
  VertexInserter inserter(complex, guard);
  EXPECT_FALSE(inserter.insert(0));
}

TEST(NearbySurface, GivesTheClosestPointsOfTheWholeSurfaceBetweenTheLabels) {
  SurfaceMesh surface = test::sphere({0, 0, 0}, 10, 3, 1, 0);
  test::append(surface, test::sphere({1, 0, 0}, 9.5, 3, 2, 1));
  const std::vector<Triangle> outer(surface.triangles.begin(), surface.triangles.begin() + 1280);
  ASSERT_EQ(surface.sides[outer.size() - 1], (Sides{1, 0}));
  ASSERT_EQ(surface.sides[outer.size()], (Sides{2, 1}));
  const ClosestPointTree whole(surface.points, outer);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::vector<BoundaryPlace> places;
  for (int i = 0; i < 40; ++i) {
    const Point direction(normal(random), normal(random), normal(random));
    places.push_back({10.2 * direction.normalized(), {{1, 0}}});
  }
  const NearbySurface nearby(surface, places, 0.5);
  EXPECT_EQ(nearby.of({{2, 1}}), nullptr) << "asked for by no place";
  const ClosestPointTree* tree = nearby.of({{1, 0}});
  ASSERT_NE(tree, nullptr);
  EXPECT_LT(tree->triangles().size(), outer.size());
  for (const BoundaryPlace& place : places)
    EXPECT_EQ(tree->closest(place.at).point, whole.closest(place.at).point);
}

}  // namespace
}  // namespace voxtet::tetra
