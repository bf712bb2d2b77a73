// fill_tets with its Delaunay backend.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/digest.h"
#include "geometry/elements/surface_measures.h"
#include "geometry/intersect/self_intersections.h"
#include "support/check_tets.h"
#include "support/nasty_surfaces.h"
#include "support/test_surfaces.h"
#include "support/tet_sizes.h"
#include "tetra/fill/fill_tets.h"
#include "tetra/optimise/optimise_tets.h"

namespace voxtet {
namespace {

using test::append;
using test::cells;
using test::check_tets;
using test::smallest_dihedral_deg;
using test::sphere;
using test::uniform_sizing;
using test::volume_of;

struct DelaunayFilled {
  Result<TetMesh> mesh;
  std::string notes, warnings;
};

DelaunayFilled fill_delaunay(const SurfaceMesh& surface, const SizingField& sizing, int threads = 1) {
  DelaunayFilled out{Error{}, "", ""};
  RunContext ctx;
  ctx.threads = threads;
  ctx.on_note = [&](const std::string&, const std::string& text) { out.notes += text + "\n"; };
  ctx.on_warning = [&](const std::string&, const std::string& text) { out.warnings += text + "\n"; };
  FillParams params;
  params.backend = TetBackend::kDelaunay;
  out.mesh = fill_tets(surface, sizing, params, ctx);
  return out;
}

/// Filled by refinement, the surface's points first, each label as large as the surface has it.
void expect_refined(const DelaunayFilled& out, const SurfaceMesh& surface, double volume_tolerance = 1e-9) {
  ASSERT_TRUE(out.mesh.ok()) << out.mesh.error().message;
  const TetMesh& mesh = *out.mesh;
  check_tets(mesh);
  EXPECT_NE(out.notes.find("filled by Delaunay refinement (strategy 1 of 6)"), std::string::npos)
      << out.notes;
  ASSERT_GE(mesh.points.size(), surface.points.size());
  EXPECT_TRUE(std::equal(surface.points.begin(), surface.points.end(), mesh.points.begin()));
  const std::vector<double> wanted = enclosed_volumes_mm3(surface);
  for (std::size_t label = 1; label < wanted.size(); ++label)
    EXPECT_NEAR(volume_of(mesh, static_cast<Label>(label)), wanted[label], volume_tolerance * wanted[label]);
}

TEST(DelaunayBackend, KeepsASurfaceThatIsDelaunay) {
  const SurfaceMesh surface = sphere({3, -2, 7}, 10, 3, 1, 0);
  const DelaunayFilled out = fill_delaunay(surface, uniform_sizing(1.4));
  expect_refined(out, surface);
  check_tets(*out.mesh, surface);
  EXPECT_EQ(out.notes.find("flipped"), std::string::npos) << out.notes;
}

TEST(DelaunayBackend, LeavesCavitiesEmptyAndIslandsApart) {
  SurfaceMesh surface = sphere({0, 0, 0}, 15, 3, 1, 0);
  append(surface, sphere({0, 0, 0}, 12, 3, 0, 1));
  append(surface, sphere({1, 0, 0}, 8, 3, 2, 0));
  append(surface, sphere({1, 0, 0}, 4, 2, 0, 2));
  expect_refined(fill_delaunay(surface, uniform_sizing(2)), surface);
}

TEST(DelaunayBackend, FillsLabelsThatShareAPlaneAnEdgeOrACorner) {
  // Any diagonal of the squares is Delaunay; the given ones need not be those that are taken.
  const SurfaceMesh surface = cells({4, 4, 4}, 1.5, [](int i, int j, int k) -> Label {
    const int octant = i / 2 + 2 * (j / 2) + 4 * (k / 2);
    return octant == 0 || octant == 3 ? 1 : octant == 5 ? 2 : octant == 6 ? 3 : octant == 7 ? 4 : 0;
  });
  expect_refined(fill_delaunay(surface, uniform_sizing(1.5)), surface);
}

TEST(DelaunayBackend, TakesTheMaximalLabel) {
  const SurfaceMesh surface = sphere({0, 0, 0}, 5, 2, 65535, 0);
  expect_refined(fill_delaunay(surface, uniform_sizing(2)), surface);
}

TEST(DelaunayBackend, FlipsEdgesThatAreNotDelaunayWhereTheSurfaceIsFlat) {
  SurfaceMesh surface = cells({6, 6, 2}, 1, [](int, int, int) { return Label(1); });
  test::Random random(1);
  for (Eigen::Vector3d& p : surface.points)
    if (p.head<2>().minCoeff() > 0.5 && p.head<2>().maxCoeff() < 5.5)
      p.head<2>() += 0.2 * random.within_one().head<2>();
  const DelaunayFilled out = fill_delaunay(surface, uniform_sizing(1));
  expect_refined(out, surface);
  EXPECT_NE(out.notes.find(" edges were flipped and 0 halved"), std::string::npos) << out.notes;
  surface.triangles = out.mesh->faces;
  surface.sides = out.mesh->face_sides;
  const DelaunayFilled again = fill_delaunay(surface, uniform_sizing(1));
  expect_refined(again, surface);
  check_tets(*again.mesh, surface);
  EXPECT_EQ(again.notes.find("flipped"), std::string::npos) << again.notes;
}

/// A coarse sphere between two fine ones.
SurfaceMesh sandwich(double outer, double inner) {
  SurfaceMesh surface = sphere({0, 0, 0}, 10, 2, 2, 1);
  append(surface, sphere({0, 0, 0}, outer, 4, 1, 0));
  append(surface, sphere({0, 0, 0}, inner, 4, 3, 2));
  return surface;
}

TEST(DelaunayBackend, HalvesEdgesOfACoarseSheetBetweenFineOnes) {
  const SurfaceMesh surface = sandwich(10.8, 9);
  const DelaunayFilled out = fill_delaunay(surface, uniform_sizing(2));
  expect_refined(out, surface, 1e-3);
  EXPECT_EQ(out.notes.find(" and 0 halved"), std::string::npos) << out.notes;
  EXPECT_GT(out.mesh->faces.size(), surface.triangles.size());
}

TEST(DelaunayBackend, LeavesSheetsMuchCloserThanTheirEdgesToTetGen) {
  const SurfaceMesh surface = sandwich(10.05, 9.75);
  const DelaunayFilled out = fill_delaunay(surface, uniform_sizing(2));
  ASSERT_TRUE(out.mesh.ok()) << out.mesh.error().message;
  check_tets(*out.mesh, surface);
  EXPECT_NE(out.notes.find("not filled by Delaunay refinement: the surface is too far from a Delaunay one"),
            std::string::npos)
      << out.warnings;
}

TEST(DelaunayBackend, FollowsUniformAndGradedSizes) {
  for (const double h : {0.8, 1.6}) {
    const SurfaceMesh surface = sphere({0, 0, 0}, h * 8, 3, 1, 0);
    const DelaunayFilled out = fill_delaunay(surface, uniform_sizing(h));
    expect_refined(out, surface);
    EXPECT_NEAR(test::inner_size_bias(*out.mesh, 1, uniform_sizing(h)), 0, 0.1) << "h " << h;
  }
  const SurfaceMesh surface = test::graded_spheres();
  const DelaunayFilled out = fill_delaunay(surface, test::graded_sizing());
  expect_refined(out, surface);
  for (const Label label : {1, 2})
    EXPECT_NEAR(test::inner_size_bias(*out.mesh, label, test::graded_sizing()), 0, 0.1);
}

TEST(DelaunayBackend, GivesTheOptimiserWhatItNeeds) {
  const SurfaceMesh surface = test::graded_spheres();
  RunContext ctx;
  DelaunayFilled out = fill_delaunay(surface, test::graded_sizing());
  ASSERT_TRUE(out.mesh.ok());
  const auto mesh = optimise_tets(*std::move(out.mesh), surface, test::graded_sizing(), {}, ctx);
  ASSERT_TRUE(mesh.ok());
  check_tets(*mesh);
  EXPECT_GT(smallest_dihedral_deg(*mesh), 28);
}

TEST(DelaunayBackend, GivesTheSameBytesOnEveryPlatform) {
  const DelaunayFilled out = fill_delaunay(test::graded_spheres(), test::graded_sizing());
  ASSERT_TRUE(out.mesh.ok());
  EXPECT_EQ(digest_of(*out.mesh), "3d9c1f1d79bdb90de5900060838f83d55f683c1c2156bbcfd070fbb02cf2ad3e");
}

/// Balls of many cubes, and a graded body, where some cells reach farther than a cube.
TEST(DelaunayBackend, GivesTheSameBytesOnAnyNumberOfThreads) {
  SurfaceMesh balls = sphere({0, 0, 0}, 9, 4, 1, 0);
  append(balls, sphere({20, 3, -2}, 6, 4, 2, 0));
  for (const auto& [surface, sizing] :
       {std::pair{balls, uniform_sizing(0.9)}, std::pair{test::graded_spheres(), test::graded_sizing()}}) {
    const DelaunayFilled one = fill_delaunay(surface, sizing);
    expect_refined(one, surface);
    for (const int threads : {2, 8}) {
      const DelaunayFilled out = fill_delaunay(surface, sizing, threads);
      ASSERT_TRUE(out.mesh.ok());
      EXPECT_EQ(digest_of(*out.mesh), digest_of(*one.mesh)) << threads;
    }
  }
}

TEST(DelaunayBackend, FillsRandomBodiesOfManyLabels) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const SurfaceMesh surface = test::random_cells(4, 4, 0, seed);
    expect_refined(fill_delaunay(surface, uniform_sizing(1)), surface);
  }
}

TEST(DelaunayBackend, LeavesLabelsThatWouldChangeTheirVolumeToTetGen) {
  // Labels of a few cubes with displaced corners: where the squares are bent, a flip takes part of a label.
  int left = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const SurfaceMesh surface = test::random_cells(4, 4, 0.1, seed);
    const DelaunayFilled out = fill_delaunay(surface, uniform_sizing(1));
    ASSERT_TRUE(out.mesh.ok()) << "seed " << seed << ": " << out.mesh.error().message;
    if (out.notes.find("would change the volume of label") == std::string::npos) {
      expect_refined(out, surface, 5e-3);
    } else {
      check_tets(*out.mesh, surface);
      ++left;
    }
  }
  EXPECT_GT(left, 0);
}

TEST(DelaunayBackend, StopsWhenAskedTo) {
  FillParams params;
  params.backend = TetBackend::kDelaunay;
  RunContext ctx;
  int asked = 0;
  ctx.on_cancelled = [&] { return ++asked > 10; };
  const auto mesh = fill_tets(sphere({0, 0, 0}, 10, 4, 1, 0), uniform_sizing(0.15), params, ctx);
  ASSERT_FALSE(mesh.ok());
  EXPECT_EQ(mesh.error().code, ErrorCode::kCancelled);
  EXPECT_LT(asked, 20);
}

}  // namespace
}  // namespace voxtet
