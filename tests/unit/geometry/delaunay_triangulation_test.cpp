// The triangulation against its definition, and against CGAL's.
#include "geometry/delaunay/delaunay_triangulation.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "geometry/elements/orientation.h"
#include "support/test_random.h"
#include "support/triangulated.h"

namespace voxtet {
namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using test::triangulated;
using Corners = std::array<std::uint32_t, 4>;

double between(test::TestRandom& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random.next() >> 11) / 9007199254740992.0;
}

std::vector<std::uint32_t> cells_of(const DelaunayTriangulation& t) {
  std::vector<std::uint32_t> cells;
  for (std::uint32_t c = 0; c < t.slots(); ++c)
    if (t.is_cell(c)) cells.push_back(c);
  return cells;
}

/// Neighbours know each other and share the corners of their facet.
void expect_linked(const DelaunayTriangulation& t) {
  for (const std::uint32_t c : cells_of(t))
    for (std::uint32_t i = 0; i < 4; ++i) {
      const DelaunayTriangulation::Facet other = t.across(c, i);
      ASSERT_TRUE(t.is_cell(DelaunayTriangulation::cell_of(other)));
      ASSERT_EQ(t.across(other), 4 * c + i);
      Corners own = t.corners(c), theirs = t.corners(DelaunayTriangulation::cell_of(other));
      own[i] = theirs[DelaunayTriangulation::corner_of(other)] = 0xfffffffeU;
      std::sort(own.begin(), own.end());
      std::sort(theirs.begin(), theirs.end());
      ASSERT_EQ(own, theirs);
    }
}

/// Every finite cell is positive, no point is inside of a ball or beyond a facet of the hull, and each point
/// has its star.
void expect_delaunay(const DelaunayTriangulation& t) {
  expect_linked(t);
  std::size_t corners = 0;
  for (const std::uint32_t c : cells_of(t)) {
    const Corners& v = t.corners(c);
    if (!t.is_infinite(c))
      ASSERT_EQ(orientation(t.point(v[0]), t.point(v[1]), t.point(v[2]), t.point(v[3])), 1);
    for (std::uint32_t p = 0; p < t.point_count(); ++p)
      if (t.corner_at(c, p) == 4) ASSERT_FALSE(t.is_in_conflict(c, t.point(p))) << c << " " << p;
    corners += static_cast<std::size_t>(std::count_if(
        v.begin(), v.end(), [](std::uint32_t w) { return w != DelaunayTriangulation::kInfinite; }));
  }
  DelaunayTriangulation::Cavity star;
  for (std::uint32_t p = 0; p < t.point_count(); ++p) {
    if (!t.in_use(p)) continue;
    t.find_star(p, star);
    for (const std::uint32_t c : star.cells) ASSERT_LT(t.corner_at(c, p), 4U);
    corners -= star.cells.size();
  }
  EXPECT_EQ(corners, 0U);
}

std::set<Corners> finite_cells(const DelaunayTriangulation& t) {
  std::set<Corners> cells;
  for (const std::uint32_t c : cells_of(t)) {
    if (t.is_infinite(c)) continue;
    Corners corners = t.corners(c);
    std::sort(corners.begin(), corners.end());
    cells.insert(corners);
  }
  return cells;
}

std::set<Corners> cells_by_cgal(const std::vector<Vector3d>& points) {
  using Vertices = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
  using Structure =
      CGAL::Triangulation_data_structure_3<Vertices, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
  CGAL::Delaunay_triangulation_3<Kernel, Structure> t;
  for (std::uint32_t v = 0; v < points.size(); ++v)
    t.insert(Kernel::Point_3(points[v].x(), points[v].y(), points[v].z()))->info() = v;
  std::set<Corners> cells;
  for (const auto c : t.finite_cell_handles()) {
    Corners corners{c->vertex(0)->info(), c->vertex(1)->info(), c->vertex(2)->info(), c->vertex(3)->info()};
    std::sort(corners.begin(), corners.end());
    cells.insert(corners);
  }
  return cells;
}

TEST(DelaunayTriangulation, IsTheOnlyOneOfPointsInGeneralPosition) {
  test::TestRandom random(1);
  for (int round = 0; round < 20; ++round) {
    std::vector<Vector3d> points;
    points.reserve(150);
    const double flatness = round % 2 ? 1 : 1e-3;  // flat cells, large balls
    for (int i = 0; i < 150; ++i)
      points.emplace_back(between(random, 90, 110), between(random, -5, 5),
                          flatness * between(random, -5, 5));
    const DelaunayTriangulation t = triangulated(points);
    expect_delaunay(t);
    EXPECT_EQ(finite_cells(t), cells_by_cgal(points));
  }
}

TEST(DelaunayTriangulation, OfPointsOnASphereIsThatOfTheirHull) {
  test::TestRandom random(2);
  std::vector<Vector3d> points{Vector3d::Zero()};
  while (points.size() < 300) {
    const Vector3d p(between(random, -1, 1), between(random, -1, 1), between(random, -1, 1));
    if (p.norm() > 0.1) points.push_back(1e3 * p.normalized());
  }
  expect_delaunay(triangulated(points));
}

TEST(DelaunayTriangulation, HoldsWhereManyPointsLieOnSpheresAndInPlanes) {
  test::TestRandom random(3);
  for (const double step : {1.0, 0.1, 1.0 / 3}) {
    std::vector<Vector3d> points;
    points.reserve(216);
    for (int i = 0; i < 216; ++i) points.push_back(step * Vector3d(i % 6, i / 6 % 6, i / 36));
    for (std::size_t i = points.size() - 1; i > 0; --i) std::swap(points[i], points[random.below(i + 1)]);
    expect_delaunay(triangulated(points));
    std::sort(points.begin(), points.end(), [](const Vector3d& p, const Vector3d& q) {
      return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
    });
    const DelaunayTriangulation t = triangulated(points);
    expect_delaunay(t);
    double volume = 0;
    for (const Corners& c : finite_cells(t))
      volume += std::abs((t.point(c[1]) - t.point(c[0]))
                             .dot((t.point(c[2]) - t.point(c[0])).cross(t.point(c[3]) - t.point(c[0])))) /
                6;
    EXPECT_NEAR(volume, 125 * step * step * step, 1e-10);
  }
}

TEST(DelaunayTriangulation, LeavesOutPointsThatAreThere) {
  const std::vector<Vector3d> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  std::vector<Vector3d> twice = corners;
  twice.insert(twice.end(), corners.begin(), corners.end());
  const DelaunayTriangulation t = triangulated(twice);
  for (std::uint32_t v = 0; v < 10; ++v) EXPECT_EQ(t.in_use(v), v < 5);
  EXPECT_EQ(finite_cells(t), finite_cells(triangulated(corners)));
}

TEST(DelaunayTriangulation, BeginsWithNoPointsInOnePlane) {
  DelaunayTriangulation t;
  std::vector<std::uint32_t> order;
  order.reserve(18);
  for (int i = 0; i < 16; ++i) order.push_back(t.add_point({0.1 * (i % 4), 0.1 * (i / 4), 0.3}));
  EXPECT_FALSE(t.begin(order));
  EXPECT_FALSE(t.begin({}));
  order.insert(order.begin(), t.add_point(t.point(3)));
  order.push_back(t.add_point({0, 0, 1}));
  EXPECT_TRUE(t.begin(order));
  EXPECT_TRUE(t.in_use(order.back()));
  expect_linked(t);
}

TEST(DelaunayTriangulation, CavitiesMayBeBoundedByTheCaller) {
  test::TestRandom random(4);
  std::vector<Vector3d> points;
  points.reserve(200);
  for (int i = 0; i < 200; ++i)
    points.emplace_back(between(random, 0, 1), between(random, 0, 1), between(random, 0, 1));
  const DelaunayTriangulation t = triangulated(points);
  const Vector3d p(0.5, 0.5, 0.5);
  DelaunayTriangulation::Cavity all, part;
  const std::uint32_t first = t.locate(p, cells_of(t).front());
  t.find_cavity(p, first, all);
  const auto all_but_last = [&](std::uint32_t cell) { return cell != all.cells.back(); };
  EXPECT_TRUE(t.find_cavity(p, first, part, all_but_last, [](std::uint32_t) { return true; }));
  EXPECT_LT(part.cells.size(), all.cells.size());
  for (const std::uint32_t c : part.cells)
    EXPECT_TRUE(t.is_in_conflict(c, p) && std::count(all.cells.begin(), all.cells.end(), c) == 1);
  for (const DelaunayTriangulation::Facet f : part.rim) {
    EXPECT_EQ(std::count(part.cells.begin(), part.cells.end(), DelaunayTriangulation::cell_of(f)), 1);
    EXPECT_EQ(std::count(part.cells.begin(), part.cells.end(), DelaunayTriangulation::cell_of(t.across(f))),
              0);
  }
}

}  // namespace
}  // namespace voxtet
