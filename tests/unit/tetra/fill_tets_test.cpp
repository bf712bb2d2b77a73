#include "tetra/fill/fill_tets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/digest.h"
#include "geometry/intersect/self_intersections.h"
#include "support/check_tets.h"
#include "support/test_surfaces.h"
#include "support/tet_sizes.h"

namespace voxtet {
namespace {

using test::append;
using test::cells;
using test::check_tets;
using test::edges_of;
using test::graded_sizing;
using test::graded_spheres;
using test::inner_size_bias;
using test::median;
using test::sampled_sizing;
using test::smallest_dihedral_deg;
using test::sphere;
using test::torus;
using test::uniform_sizing;
using test::volume_of;

Result<TetMesh> fill(const SurfaceMesh& surface, const SizingField& sizing,
                     const FillParams& params = {TetBackend::kTetgen}) {
  RunContext ctx;
  return fill_tets(surface, sizing, params, ctx);
}

TEST(FillTets, FillsASphereKeepingItsSurface) {
  const SurfaceMesh surface = sphere({3, -2, 7}, 10, 3, 1, 0);
  const auto mesh = fill(surface, uniform_sizing(1.4));
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  check_tets(*mesh, surface);
  EXPECT_GT(smallest_dihedral_deg(*mesh), 5);
}

TEST(FillTets, LeavesTheCavityOfAShellEmpty) {
  SurfaceMesh surface = sphere({0, 0, 0}, 15, 4, 1, 0);
  append(surface, sphere({0, 0, 0}, 10, 4, 0, 1));
  const auto mesh = fill(surface, uniform_sizing(1.2));
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  check_tets(*mesh, surface);
  const double exact = 4.18879020478639 * (15 * 15 * 15 - 10 * 10 * 10);
  EXPECT_NEAR(volume_of(*mesh, 1) / exact, 1, 0.01);
  for (const Eigen::Vector3d& p : mesh->points) EXPECT_GT(p.norm(), 9.9);
}

TEST(FillTets, KeepsNestedCavitiesAndIslandsApart) {
  // A ball of label 2 floats in the cavity of a shell of label 1 and has a cavity of its own.
  SurfaceMesh surface = sphere({0, 0, 0}, 15, 3, 1, 0);
  append(surface, sphere({0, 0, 0}, 12, 3, 0, 1));
  append(surface, sphere({1, 0, 0}, 8, 3, 2, 0));
  append(surface, sphere({1, 0, 0}, 4, 2, 0, 2));
  const auto mesh = fill(surface, uniform_sizing(2));
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  check_tets(*mesh, surface);
  EXPECT_NEAR(volume_of(*mesh, 2) / (4.18879020478639 * (512 - 64)), 1, 0.02);
}

TEST(FillTets, LabelsBothSidesOfASharedPlane) {
  const SurfaceMesh surface = cells({4, 6, 8}, 1, [](int, int, int k) { return Label(k < 3 ? 1 : 2); });
  const auto mesh = fill(surface, uniform_sizing(1));
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  check_tets(*mesh, surface);
  EXPECT_NEAR(volume_of(*mesh, 1), 4 * 6 * 3, 1e-9);
  EXPECT_NEAR(volume_of(*mesh, 2), 4 * 6 * 5, 1e-9);
}

TEST(FillTets, FillsLabelsThatMeetAlongAnEdgeOrAtACorner) {
  // Four cubes around an edge: two of label 1 touch only there; a third stands at a corner of label 2.
  const SurfaceMesh surface = cells({4, 4, 4}, 1.5, [](int i, int j, int k) -> Label {
    const int octant = i / 2 + 2 * (j / 2) + 4 * (k / 2);
    return octant == 0 || octant == 3 ? 1 : octant == 5 ? 2 : octant == 6 ? 3 : 0;
  });
  const auto mesh = fill(surface, uniform_sizing(1.5));
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  check_tets(*mesh, surface);
  EXPECT_NEAR(volume_of(*mesh, 1), 2 * 27, 1e-9);
  EXPECT_NEAR(volume_of(*mesh, 2), 27, 1e-9);
}

TEST(FillTets, LeavesTwoCavitiesTouchingAlongAnEdgeEmpty) {
  const SurfaceMesh surface = cells({6, 6, 4}, 1, [](int i, int j, int k) -> Label {
    const bool hollow = (k == 1 || k == 2) && ((i == 2 && j == 2) || (i == 3 && j == 3));
    return hollow ? 0 : 1;
  });
  const auto mesh = fill(surface, uniform_sizing(1));
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  check_tets(*mesh, surface);
  EXPECT_NEAR(volume_of(*mesh, 1), 6 * 6 * 4 - 4, 1e-9);
}

TEST(FillTets, FillsATorus) {
  const SurfaceMesh surface = torus(10, 4, 48, 20, 7);
  const auto mesh = fill(surface, uniform_sizing(1.3));
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  check_tets(*mesh, surface);
}

TEST(FillTets, FollowsAUniformSizeInsideTheSurface) {
  for (const double h : {0.8, 1.0, 1.6}) {
    const SurfaceMesh surface = sphere({0, 0, 0}, h * 8, 3, 1, 0);
    const auto mesh = fill(surface, uniform_sizing(h));
    ASSERT_TRUE(mesh.ok()) << mesh.error().message;
    check_tets(*mesh, surface);
    EXPECT_NEAR(inner_size_bias(*mesh, 1, uniform_sizing(h)), 0, 0.1) << "h " << h;
  }
}

TEST(FillTets, FollowsAGradedSizeInEveryLabel) {
  const SurfaceMesh surface = graded_spheres();
  const SizingField sizing = graded_sizing();
  const auto mesh = fill(surface, sizing);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  check_tets(*mesh, surface);
  EXPECT_NEAR(inner_size_bias(*mesh, 1, sizing), 0, 0.1);
  EXPECT_NEAR(inner_size_bias(*mesh, 2, sizing), 0, 0.1);
  std::vector<double> lengths;
  for (const auto& [a, b] : edges_of(*mesh, 2)) lengths.push_back((mesh->points[a] - mesh->points[b]).norm());
  EXPECT_NEAR(median(lengths) / 0.8, 1, 0.15);
}

TEST(FillTets, GivesTheSameBytesOnASecondRunInOneProcess) {
  const SurfaceMesh surface = graded_spheres();
  const auto first = fill(surface, graded_sizing());
  // Something else between the two, so that state left behind would show.
  const auto between = fill(sphere({0, 0, 0}, 3, 2, 1, 0), uniform_sizing(1));
  const auto second = fill(surface, graded_sizing());
  ASSERT_TRUE(first.ok() && between.ok() && second.ok());
  check_tets(*first, surface);
  EXPECT_EQ(first->points, second->points);
  EXPECT_EQ(first->tets, second->tets);
  EXPECT_EQ(first->labels, second->labels);
}

TEST(FillTets, GivesTheSameBytesOnEveryPlatform) {
  const SurfaceMesh surface = graded_spheres();
  const auto mesh = fill(surface, graded_sizing());
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  check_tets(*mesh, surface);
  EXPECT_EQ(digest_of(surface), "4cf67e9cd00b1455f93b86b4213f183d950318c155f413a9b21c4683e83be220");
  EXPECT_EQ(digest_of(*mesh), "5909b4840b15f1ecfa182987405825ec5196e45831b17c68ddc6a6bac4863cf9");
}

TEST(FillTets, RefusesAnOpenSurfaceAndSaysWhere) {
  SurfaceMesh surface = sphere({0, 0, 0}, 5, 2, 1, 0);
  const Triangle removed = surface.triangles.back();
  surface.triangles.pop_back();
  surface.sides.pop_back();
  const auto mesh = fill(surface, uniform_sizing(1));
  ASSERT_FALSE(mesh.ok());
  EXPECT_EQ(mesh.error().code, ErrorCode::kMeshing);
  EXPECT_NE(mesh.error().message.find("open"), std::string::npos) << mesh.error().message;
  ASSERT_EQ(mesh.error().where.points.size(), 3U);
  for (const Eigen::Vector3d& p : mesh.error().where.points) {
    double nearest = 1e9;
    for (std::size_t c = 0; c < 3; ++c) {
      const Eigen::Vector3d middle = (surface.points[removed[c]] + surface.points[removed[(c + 1) % 3]]) / 2;
      nearest = std::min(nearest, (middle - p).norm());
    }
    EXPECT_LT(nearest, 1e-12);
  }
}

TEST(FillTets, RefusesATriangleWithSwappedCornersAsOpen) {
  SurfaceMesh surface = sphere({0, 0, 0}, 5, 2, 1, 0);
  std::swap(surface.triangles[7][0], surface.triangles[7][1]);
  const auto mesh = fill(surface, uniform_sizing(1));
  ASSERT_FALSE(mesh.ok());
  EXPECT_EQ(mesh.error().code, ErrorCode::kMeshing);
  EXPECT_NE(std::count(mesh.error().where.elements.begin(), mesh.error().where.elements.end(), 7U), 0);
}

TEST(FillTets, RefusesASelfIntersectingSurfaceAndNamesTheTriangles) {
  SurfaceMesh surface = sphere({0, 0, 0}, 5, 2, 1, 0);
  append(surface, sphere({6, 0.1, 0.2}, 5, 2, 2, 0));
  const auto mesh = fill(surface, uniform_sizing(1));
  ASSERT_FALSE(mesh.ok());
  EXPECT_EQ(mesh.error().code, ErrorCode::kMeshing);
  EXPECT_NE(mesh.error().message.find("intersects itself"), std::string::npos) << mesh.error().message;
  EXPECT_GT(mesh.error().where.elements.size(), 10U);
  EXPECT_EQ(mesh.error().where.elements.size(), mesh.error().where.points.size());
  // The two spheres cross in the plane halfway between their centres.
  for (const Eigen::Vector3d& p : mesh.error().where.points) EXPECT_NEAR(p.x(), 3, 2.5);
}

TEST(FillTets, CountsAllFaultyTrianglesThoughItNamesTheFirstThousand) {
  SurfaceMesh flat;
  flat.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  flat.triangles.assign(1500, {0, 1, 2});
  flat.sides.assign(1500, {1, 0});
  const auto mesh = fill(flat, uniform_sizing(1));
  ASSERT_FALSE(mesh.ok());
  EXPECT_EQ(mesh.error().message, "1500 triangles of the surface have no area");
  EXPECT_EQ(mesh.error().where.elements.size(), 1000U);

  // The search for triangles that meet ends after so many pairs: no count that looks like all of them.
  SurfaceMesh spheres;
  for (int i = 0; i < 40; ++i) append(spheres, sphere({0.1 * i, 0.07 * i, 0.03 * i}, 5, 2, 1, 0));
  const auto crossing = fill(spheres, uniform_sizing(1));
  ASSERT_FALSE(crossing.ok());
  EXPECT_EQ(crossing.error().message.find("the surface intersects itself: at least "), 0U)
      << crossing.error().message;
}

TEST(FillTets, RefusesWhatIsInsideOutAndNamesTheTriangles) {
  EXPECT_TRUE(fill(test::stacked_tetrahedra(3), uniform_sizing(3)).ok());
  const SurfaceMesh surface = test::stacked_tetrahedra(-3);
  ASSERT_TRUE(find_self_intersections(surface).empty());
  const auto mesh = fill(surface, uniform_sizing(3));
  ASSERT_FALSE(mesh.ok());
  EXPECT_EQ(mesh.error().code, ErrorCode::kMeshing);
  EXPECT_NE(mesh.error().message.find("labels overlap at 3 edges"), std::string::npos)
      << mesh.error().message;
  EXPECT_EQ(mesh.error().where.elements.size(), 7U);
}

TEST(FillTets, GivesAValidMeshOrTheIntersectingTrianglesForRandomlyDentedSpheres) {
  std::uint64_t state = 12345;
  const auto random = [&state] {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state >> 33) / 2147483648.0 - 0.5;
  };
  int meshed = 0, refused = 0;
  for (int seed = 0; seed < 60; ++seed) {
    SurfaceMesh surface = sphere({0, 0, 0}, 5, 2, 1, 0);
    append(surface, sphere({0, 0, 0}, 3, 1, 0, 1));
    const double dent = 0.04 * seed;
    for (Eigen::Vector3d& p : surface.points) p += dent * Eigen::Vector3d(random(), random(), random());
    const bool intersects = !find_self_intersections(surface).empty();
    const auto mesh = fill(surface, uniform_sizing(1.5));
    ASSERT_EQ(mesh.ok(), !intersects) << "seed " << seed << (mesh.ok() ? "" : ": " + mesh.error().message);
    if (mesh.ok()) {
      check_tets(*mesh, surface);
      ++meshed;
    } else {
      EXPECT_EQ(mesh.error().code, ErrorCode::kMeshing);
      EXPECT_FALSE(mesh.error().where.elements.empty());
      ++refused;
    }
  }
  EXPECT_GT(meshed, 10);
  EXPECT_GT(refused, 10);
}

TEST(FillTets, TriesAFinerToleranceWhenPointsNearlyCoincide) {
  SurfaceMesh surface = cells({1, 1, 1}, 2, [](int, int, int) { return Label(1); });
  SurfaceMesh tip;
  tip.points = {{2 + 1e-8, 2, 2}, {4, 2, 2}, {3, 4, 2}, {3, 3, 4}};
  tip.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  tip.sides.assign(4, {1, 0});
  append(surface, tip);
  RunContext ctx;
  std::string warning;
  ctx.on_warning = [&](const std::string&, const std::string& message) { warning += message; };
  const auto mesh = fill_tets(surface, uniform_sizing(1), {TetBackend::kTetgen}, ctx);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  check_tets(*mesh, surface);
  EXPECT_NE(warning.find("finer tolerance"), std::string::npos) << warning;
}

TEST(FillTets, RefusesDegenerateTrianglesBadIndicesAndUnusedPoints) {
  const SurfaceMesh good = sphere({0, 0, 0}, 5, 1, 1, 0);
  SurfaceMesh flat = good, beyond = good, unused = good, sided = good;
  flat.points[flat.triangles[0][0]] = flat.points[flat.triangles[0][1]];
  beyond.triangles[0][0] = 100000;
  unused.points.emplace_back(0, 0, 0);
  sided.sides[3] = {0, 1};
  for (const SurfaceMesh& surface : {flat, beyond, unused, sided, SurfaceMesh{}}) {
    const auto mesh = fill(surface, uniform_sizing(1));
    ASSERT_FALSE(mesh.ok());
    EXPECT_EQ(mesh.error().code, ErrorCode::kMeshing);
    EXPECT_EQ(mesh.error().stage, "tetra");
  }
}

TEST(FillTets, WarnsOfTrianglesMeetingAtASharpAngle) {
  SurfaceMesh wedge;
  wedge.points = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, 1, 0.05}};
  wedge.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  wedge.sides.assign(4, {1, 0});
  RunContext ctx;
  std::string warning;
  ctx.on_warning = [&](const std::string&, const std::string& message) { warning += message; };
  const auto mesh = fill_tets(wedge, uniform_sizing(1), {TetBackend::kTetgen}, ctx);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  check_tets(*mesh, wedge);
  EXPECT_NE(warning.find("2.86 degrees"), std::string::npos) << warning;
}

TEST(FillTets, CancelsQuicklyWhileRefining) {
  // This size asks for some ten million tetrahedra.
  RunContext ctx;
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  double asked_at = 0;
  ctx.on_cancelled = [&] {
    if (seconds() < 0.3) return false;
    if (asked_at == 0) asked_at = seconds();
    return true;
  };
  const auto mesh =
      fill_tets(sphere({0, 0, 0}, 10, 4, 1, 0), uniform_sizing(0.15), {TetBackend::kTetgen}, ctx);
  ASSERT_FALSE(mesh.ok());
  EXPECT_EQ(mesh.error().code, ErrorCode::kCancelled);
  EXPECT_LT(seconds() - asked_at, 1.0);
}

TEST(FillTets, ReportsProgressThatNeverFalls) {
  RunContext ctx;
  std::vector<double> fractions;
  ctx.on_progress = [&](const std::string& stage, double fraction) {
    EXPECT_EQ(stage, "tetra");
    fractions.push_back(fraction);
  };
  ASSERT_TRUE(
      fill_tets(sphere({0, 0, 0}, 10, 4, 1, 0), uniform_sizing(0.7), {TetBackend::kTetgen}, ctx).ok());
  ASSERT_GT(fractions.size(), 5U);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.front(), 0);
  EXPECT_EQ(fractions.back(), 1);
}

}  // namespace
}  // namespace voxtet
