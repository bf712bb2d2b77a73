// Local operations over surfaces that are adapted already.
#include "remesh/adapt/improve_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "base/digest.h"
#include "geometry/elements/surface_measures.h"
#include "geometry/intersect/self_intersections.h"
#include "geometry/topology/label_topology.h"
#include "remesh/adapt/local_operations.h"
#include "remesh/complex/gabriel_balls.h"
#include "remesh/editor/complex_editor.h"
#include "support/check_surface.h"
#include "support/label_bodies.h"
#include "support/test_surfaces.h"
#include "surface/extract/extract_surface.h"
#include "surface/smooth/smooth_surface.h"
#include "surface_report.h"

namespace voxtet::remesh {
namespace {

AdaptParams strict_params() {
  AdaptParams params;
  params.min_angle_deg = 29.25;
  params.min_dihedral_deg = 30;
  params.envelope_voxels = 0.45;
  params.verify = true;
  return params;
}

SurfaceMesh label_surface(const LabelVolume& volume) {
  RunContext ctx;
  return smooth_surface(extract_surface(volume, {}, ctx).value(), volume, {}, ctx).value();
}

/// Improves what was adapted to smaller edges than are asked for now; returns both.
std::array<SurfaceMesh, 2> expect_coarser_and_as_good(const SurfaceMesh& reference, double edge_before_mm,
                                                      double edge_mm) {
  RunContext ctx;
  const SurfaceMesh fine = adapt_complex(reference, test::uniform_sizing(edge_before_mm), {}, ctx).value();
  const SizingField sizing = test::uniform_sizing(edge_mm);
  AdaptRecord record;
  const SurfaceMesh surface = improve_surface(fine, reference, sizing, strict_params(), ctx, &record).value();
  EXPECT_LT(surface.triangles.size(), fine.triangles.size());
  EXPECT_GT(record.accepted[1], 0U);
  EXPECT_EQ(record.violations, 0U);
  EXPECT_TRUE(test::is_valid_surface(surface));
  EXPECT_EQ(label_topology(surface), label_topology(reference));
  EXPECT_TRUE(find_self_intersections(surface, 1).empty());
  const test::SurfaceReport before = test::report_on(fine, sizing), after = test::report_on(surface, sizing);
  EXPECT_GE(after.least_planar_deg, std::min(before.least_planar_deg, 29.25) - 1e-9);
  EXPECT_GT(after.size_median, before.size_median + 0.2);
  const std::vector<double> target = enclosed_volumes_mm3(reference), found = enclosed_volumes_mm3(surface);
  EXPECT_EQ(found.size(), target.size());
  for (std::size_t l = 1; l < target.size(); ++l) EXPECT_NEAR(found[l], target[l], 0.01 * target[l]);
  EXPECT_EQ(digest_of(improve_surface(fine, reference, sizing, strict_params(), ctx).value()),
            digest_of(surface));
  return {fine, surface};
}

TEST(ImproveSurface, CoarsensASphereThatIsTooFine) {
  const auto [fine, surface] = expect_coarser_and_as_good(test::sphere({1, 2, 3}, 12, 5, 1, 0), 1.2, 2);
  const SizingField sizing = test::uniform_sizing(2);
  EXPECT_GT(test::report_on(surface, sizing).size_p5, test::report_on(fine, sizing).size_p5 + 0.1);
}

TEST(ImproveSurface, CoarsensAConformingHeart) {
  expect_coarser_and_as_good(label_surface(test::heart_volume(34, 30, 30)), 1.2, 2);
}

TEST(ImproveSurface, GivesTheSameBytesOnAnyNumberOfThreads) {
  const SurfaceMesh heart = label_surface(test::heart_volume(34, 30, 30));
  RunContext ctx;
  const SizingField sizing = test::uniform_sizing(2);
  const SurfaceMesh fine = adapt_complex(heart, test::uniform_sizing(1.2), {}, ctx).value();
  const auto on = [&](int threads) {
    ctx.threads = threads;
    return digest_of(improve_surface(fine, heart, sizing, strict_params(), ctx).value()) +
           digest_of(adapt_complex(heart, sizing, {}, ctx).value());
  };
  const std::string first = on(1);
  for (const int threads : {2, 8}) EXPECT_EQ(on(threads), first) << threads;
}

TEST(ImproveSurface, BringsBackWhatIsBeyondTheEnvelope) {
  const SurfaceMesh reference = test::sphere({0, 0, 0}, 12, 5, 1, 0);
  RunContext ctx;
  SurfaceMesh dented = adapt_complex(reference, test::uniform_sizing(2), {}, ctx).value();
  dented.points[7] *= 11.3 / 12;
  const SurfaceMesh surface =
      improve_surface(dented, reference, test::uniform_sizing(2), strict_params(), ctx).value();
  double deepest = 0;
  for (const Eigen::Vector3d& p : surface.points) deepest = std::max(deepest, std::abs(p.norm() - 12));
  EXPECT_LE(deepest, 0.45 + 1e-9);
}

/// Triangles that are no facets of the Delaunay triangulation of all points, or far from its small balls.
std::size_t count_without_balls(const SurfaceMesh& surface) {
  std::size_t count = 0;
  for (const Triangle& t : surface.triangles) {
    GabrielBalls balls({surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]});
    for (std::uint32_t v = 0; v < surface.points.size(); ++v)
      if (v != t[0] && v != t[1] && v != t[2]) balls.leave_out(surface.points[v]);
    count += !balls.any();
  }
  return count;
}

TEST(ImproveSurface, KeepsFacetsOfThinBodiesDelaunay) {
  // As thick in the middle as half a target edge.
  SurfaceMesh reference = test::sphere({0, 0, 0}, 12, 5, 1, 0);
  for (Eigen::Vector3d& p : reference.points) p.z() *= 0.06;
  RunContext ctx;
  AdaptParams coarse;
  coarse.min_dihedral_deg = 10;
  const SurfaceMesh fine = adapt_complex(reference, test::uniform_sizing(0.9), coarse, ctx).value();
  AdaptParams params = strict_params();
  params.min_dihedral_deg = 10;
  const SurfaceMesh surface =
      improve_surface(fine, reference, test::uniform_sizing(2.4), params, ctx).value();
  EXPECT_LT(surface.triangles.size(), fine.triangles.size());
  EXPECT_LT(count_without_balls(fine), fine.triangles.size() / 50);
  EXPECT_LT(100 * count_without_balls(surface), surface.triangles.size());
}

TEST(ImproveSurface, OpensTheFoldsOfARoughSurface) {
  const SurfaceMesh reference = test::sphere({0, 0, 0}, 6, 5, 1, 0);
  const SizingField sizing = test::uniform_sizing(0.4);
  RunContext ctx;
  const SurfaceMesh smooth = adapt_complex(reference, sizing, {}, ctx).value();
  for (const unsigned seed : {1U, 3U}) {
    SurfaceMesh rough = smooth;
    std::mt19937 random(seed);
    for (Eigen::Vector3d& p : rough.points) p *= 1 + 0.5 / 6 * (random() % 1000 / 500.0 - 1);
    EXPECT_LT(test::report_on(rough, sizing).least_dihedral_deg, 40);
    const SurfaceMesh surface = improve_surface(rough, reference, sizing, strict_params(), ctx).value();
    EXPECT_GE(test::report_on(surface, sizing).least_dihedral_deg, 60 - 1e-9);
    EXPECT_TRUE(test::is_valid_surface(surface));
    EXPECT_TRUE(find_self_intersections(surface, 1).empty());
  }
}

TEST(ImproveSurface, StopsWhenCancelled) {
  const SurfaceMesh sphere = test::sphere({0, 0, 0}, 12, 4, 1, 0);
  RunContext ctx;
  ctx.on_cancelled = [] { return true; };
  const Result<SurfaceMesh> out =
      improve_surface(sphere, sphere, test::uniform_sizing(2), strict_params(), ctx);
  ASSERT_FALSE(out.ok());
  EXPECT_EQ(out.error().code, ErrorCode::kCancelled);
}

TEST(ComplexEditor, TurnsNoBumpOfThreeFacetsInsideOut) {
  const ComplexMesh mesh(test::stacked_tetrahedra(3));
  const SizingField sizing = test::uniform_sizing(5);
  ComplexEditor editor(mesh, mesh, same_complex(mesh), sizing);
  editor.limits.reach_mm = 100;
  editor.limits.turn_cosine = -1;
  editor.limits.crease_cosine = editor.limits.junction_cosine = editor.limits.angle_cosine = 0.99;
  editor.set_cell(5);
  Edit change;
  for (const std::uint32_t t : mesh.star(3)) {
    change.removed.push_back(t);
    change.added.push_back({mesh.triangle(t), mesh.pair(t)});
  }
  change.moved = 3;
  change.position = {0, 0, 2.5};
  EXPECT_TRUE(editor.attempt(change, Demand::kAllowed));
  change.removed.assign(editor.mesh().star(3).begin(), editor.mesh().star(3).end());
  change.position = {0, 0, -2.5};
  EXPECT_FALSE(editor.attempt(change, Demand::kAllowed));
  EXPECT_EQ(editor.refusals(Refusal::kIntersection), 1U);
  EXPECT_EQ(editor.mesh().point(3).z(), 2.5);
}

/// Moves every vertex a little, with verification; what that finds.
std::uint64_t violations_found(const SurfaceMesh& surface) {
  const ComplexMesh mesh(surface);
  const SizingField sizing = test::uniform_sizing(2);
  ComplexEditor editor(mesh, mesh, same_complex(mesh), sizing);
  editor.limits.reach_mm = 100;
  editor.limits.verify = true;
  editor.set_cell(2);
  std::size_t accepted = 0;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    Edit change;
    for (const std::uint32_t t : editor.mesh().star(v)) {
      change.removed.push_back(t);
      change.added.push_back({editor.mesh().triangle(t), editor.mesh().pair(t)});
    }
    change.moved = v;
    change.position = editor.mesh().point(v) + Eigen::Vector3d(1e-4, 2e-4, -1e-4);
    accepted += editor.attempt(change, Demand::kAllowed);
  }
  EXPECT_GT(accepted, 100U);
  return editor.violations();
}

TEST(ComplexEditor, FindsWhatMeetsWhenItVerifies) {
  SurfaceMesh two = test::sphere({0, 0, 0}, 5, 3, 1, 0);
  EXPECT_EQ(violations_found(two), 0U);
  test::append(two, test::sphere({9.5, 0.3, 0.2}, 5, 3, 1, 0));
  EXPECT_GT(violations_found(two), 0U) << "spheres that cross";
}

TEST(EditTrials, PutBackEveryTriangleWhereItWas) {
  const SurfaceMesh heart = label_surface(test::heart_volume(20, 18, 18));
  const SizingField sizing = test::uniform_sizing(3);
  const ComplexMesh mesh(heart);
  ComplexEditor editor(mesh, mesh, same_complex(mesh), sizing);
  editor.set_cell(1);
  LocalOperations operations(editor);
  editor.begin_trial();
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (editor.mesh().star(v).empty()) continue;
    operations.relocate(v);
    const std::vector<std::uint32_t> around = operations.neighbours(v);
    for (std::size_t i = 0; i < around.size(); ++i)
      if (i % 3 == 0   ? operations.collapse(v, around[i], 2)
          : i % 3 == 1 ? operations.split(v, around[i])
                       : operations.flip(v, around[i], Demand::kAllowed))
        break;
  }
  for (const std::uint64_t count : operations.accepted) EXPECT_GT(count, 20U);
  ASSERT_NE(digest_of(editor.mesh().to_surface()), digest_of(heart));
  editor.undo_trial();
  for (std::uint32_t t = 0; t < mesh.slot_count(); ++t) {
    ASSERT_TRUE(editor.mesh().alive(t));
    ASSERT_EQ(editor.mesh().triangle(t), mesh.triangle(t)) << t;
    ASSERT_EQ(editor.mesh().pair(t), mesh.pair(t));
  }
  for (std::uint32_t t = static_cast<std::uint32_t>(mesh.slot_count()); t < editor.mesh().slot_count(); ++t)
    ASSERT_FALSE(editor.mesh().alive(t));
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) ASSERT_EQ(editor.mesh().point(v), mesh.point(v));
}

}  // namespace
}  // namespace voxtet::remesh
