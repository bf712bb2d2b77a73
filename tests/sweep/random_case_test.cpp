// The random sweep in small; the whole one is sweep_random.
#include "sweep/random_case.h"

#include <gtest/gtest.h>

#include "geometry/intersect/exact_intersections.h"
#include "geometry/intersect/self_intersections.h"
#include "support/test_random.h"
#include "support/test_surfaces.h"

namespace voxtet::sweep {
namespace {

#ifdef __EMSCRIPTEN__
constexpr std::uint64_t kCount = 10;  // the native build meshes more, with the same bytes
#else
constexpr std::uint64_t kCount = 40;
#endif
constexpr std::uint64_t kFirstSeed = 1, kTetsEvery = 5;

std::string words(const RandomCase& c) {
  std::string text = "seed " + std::to_string(c.seed) + " (" + c.kind + ", " + c.affine + "):";
  for (const Defect& d : c.defects) text += " [" + d.stage + " " + d.kind + ": " + d.detail + "]";
  return text;
}

TEST(RandomSweep, FindsNoDefectInAnySurfaceOrMesh) {
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + kCount; ++seed) {
    const Result<RandomCase> done = run_random_case(seed, "delaunay", seed % kTetsEvery == 0);
    ASSERT_TRUE(done.ok()) << done.error().message;
    EXPECT_TRUE(done->defects.empty()) << words(*done);
  }
}

/// Triangles on few small whole coordinates: coplanar, touching, folded and crossing ones all occur.
SurfaceMesh triangle_soup(std::uint64_t seed) {
  test::TestRandom random(seed);
  SurfaceMesh soup;
  for (int i = 0; i < 12; ++i) {
    Eigen::Vector3d p;
    for (int d = 0; d < 3; ++d) p[d] = random.below(4);
    soup.points.push_back(p);
  }
  while (soup.triangles.size() < 20) {
    Triangle t{};
    for (std::uint32_t& v : t) v = static_cast<std::uint32_t>(random.below(12));
    if (t[0] == t[1] || t[1] == t[2] || t[0] == t[2]) continue;
    const auto& p = soup.points;
    if ((p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm() > 0) soup.triangles.push_back(t);
  }
  soup.sides.assign(soup.triangles.size(), {1, 0});
  return soup;
}

TEST(ExactIntersections, AgreesWithTheSearchOfTheCore) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const SurfaceMesh soup = triangle_soup(seed);
    EXPECT_EQ(count_self_intersections(soup), find_self_intersections(soup).size()) << "seed " << seed;
  }
}

TEST(ExactIntersections, FindsNoneInASphereAndSomeWhereTwoCross) {
  SurfaceMesh surface = test::sphere({0, 0, 0}, 5, 3, 1, 0);
  EXPECT_EQ(count_self_intersections(surface), 0U);
  test::append(surface, test::sphere({1, 0.1, 0.2}, 5, 3, 2, 0));
  EXPECT_GT(count_self_intersections(surface), 20U);
}

TEST(ExactIntersections, CountsTrianglesWithoutAnArea) {
  SurfaceMesh surface = test::sphere({0, 0, 0}, 5, 1, 1, 0);
  surface.points.insert(surface.points.end(), {{20, 0, 0}, {21, 0, 0}, {22, 0, 0}});
  const auto n = static_cast<std::uint32_t>(surface.points.size());
  surface.triangles.push_back({n - 3, n - 2, n - 1});
  surface.sides.push_back({1, 0});
  EXPECT_EQ(count_self_intersections(surface), 1U);
}

}  // namespace
}  // namespace voxtet::sweep
