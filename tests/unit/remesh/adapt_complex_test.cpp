// The transactional remesher: whatever it does, labels keep their topology and nothing intersects.
#include "remesh/adapt/adapt_complex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "base/digest.h"
#include "geometry/elements/surface_measures.h"
#include "geometry/intersect/self_intersections.h"
#include "geometry/search/closest_point.h"
#include "io/volume/read_volume.h"
#include "support/check_surface.h"
#include "support/data.h"
#include "support/label_bodies.h"
#include "support/random_labels.h"
#include "support/test_surfaces.h"
#include "surface/extract/extract_surface.h"
#include "surface/smooth/smooth_surface.h"
#include "surface_report.h"

namespace voxtet::remesh {
namespace {

struct Adapted {
  SurfaceMesh surface;
  AdaptRecord record;
  test::SurfaceReport report;
};

/// Largest distance from the corners and centroids of `from` to the triangles of `to` between the same
/// labels.
double largest_distance(const SurfaceMesh& from, const SurfaceMesh& to) {
  std::map<Sides, std::vector<Triangle>> parts;
  for (std::size_t t = 0; t < to.triangles.size(); ++t) parts[to.sides[t]].push_back(to.triangles[t]);
  double largest = 0;
  for (const auto& [sides, triangles] : parts) {
    const ClosestPointTree tree(to.points, triangles);
    for (std::size_t t = 0; t < from.triangles.size(); ++t) {
      if (from.sides[t] != sides) continue;
      const auto& [a, b, c] = from.triangles[t];
      const Eigen::Vector3d &p = from.points[a], &q = from.points[b], &r = from.points[c];
      for (const Eigen::Vector3d& at : {p, q, r, Eigen::Vector3d((p + q + r) / 3)})
        largest = std::max(largest, tree.closest(at).distance_mm);
    }
  }
  return largest;
}

void expect_same_topology(const SurfaceMesh& before, const SurfaceMesh& after) {
  ASSERT_EQ(test::labels_of(before), test::labels_of(after));
  const auto old = test::label_topologies(before), now = test::label_topologies(after);
  for (std::size_t i = 0; i < old.size(); ++i) {
    SCOPED_TRACE("label " + std::to_string(test::labels_of(before)[i]));
    EXPECT_EQ(now[i].euler(), old[i].euler());
    EXPECT_EQ(now[i].components, old[i].components);
    EXPECT_EQ(now[i].bad_edges, 0U);
    EXPECT_EQ(now[i].pinched_points, 0U);
  }
}

/// Adapts twice and checks every promise of the header.
Adapted adapt(const SurfaceMesh& reference, const SizingField& sizing, AdaptParams params) {
  Adapted out;
  RunContext ctx;
  const Result<SurfaceMesh> first = adapt_complex(reference, sizing, params, ctx, &out.record);
  EXPECT_TRUE(first.ok());
  if (!first.ok()) return out;
  out.surface = *first;
  params.verify = false;
  const Result<SurfaceMesh> second = adapt_complex(reference, sizing, params, ctx);
  EXPECT_EQ(digest_of(*second), digest_of(*first));
  EXPECT_TRUE(test::is_valid_surface(*first));
  EXPECT_EQ(find_self_intersections(*first).size(), 0U);
  EXPECT_EQ(out.record.violations, 0U);
  expect_same_topology(reference, *first);
  // The envelope holds at samples; between them a facet may go a little farther.
  EXPECT_LE(largest_distance(reference, *first), params.voxel_mm);
  EXPECT_LE(largest_distance(*first, reference), params.voxel_mm);
  ::testing::Test::RecordProperty("digest", digest_of(*first));
  out.report = test::report_on(*first, sizing);
  return out;
}

SurfaceMesh extracted(const LabelVolume& volume, bool smooth) {
  RunContext ctx;
  const SurfaceMesh raw = extract_surface(volume, {}, ctx).value();
  return smooth ? smooth_surface(raw, volume, {}, ctx).value() : raw;
}

void expect_volumes_kept(const SurfaceMesh& before, const SurfaceMesh& after, double share) {
  const std::vector<double> old = enclosed_volumes_mm3(before), now = enclosed_volumes_mm3(after);
  ASSERT_EQ(now.size(), old.size());
  for (std::size_t l = 1; l < old.size(); ++l) EXPECT_NEAR(now[l], old[l], share * old[l]) << "label " << l;
}

TEST(AdaptComplex, MeshesASphereEvenly) {
  const SurfaceMesh sphere = test::sphere({1, 2, 3}, 10, 5, 1, 0);
  AdaptParams params;
  params.voxel_mm = 0.5;
  params.shape_weight = 0.5;
  const Adapted out = adapt(sphere, test::uniform_sizing(1), params);
  EXPECT_GE(out.report.least_planar_deg, 30);
  EXPECT_NEAR(out.report.size_median, 0, 0.05);
  double sum = 0, squares = 0;
  for (const auto& [a, b, c] : out.surface.triangles) {
    const double area =
        triangle_area_mm2(out.surface.points[a], out.surface.points[b], out.surface.points[c]);
    sum += area;
    squares += area * area;
  }
  const auto n = static_cast<double>(out.surface.triangles.size());
  EXPECT_LE(std::sqrt(n * squares / (sum * sum) - 1), 0.12);
  expect_volumes_kept(sphere, out.surface, 1e-3);
}

TEST(AdaptComplex, FollowsALinearSizeOnASlab) {
  const LabelVolume volume = test::make_volume(40, 24, 6, [](int, int, int) { return 1; });
  const SizingField sizing = test::sampled_sizing(
      {-1, -1, -1}, {40, 24, 6}, 1, [](const Eigen::Vector3d& p) { return 1 + 0.06 * (p.x() + 1); });
  const Adapted out = adapt(extracted(volume, true), sizing, {});
  EXPECT_NEAR(out.report.size_median, 0, 0.08);
  EXPECT_LE(std::max(out.report.size_p95, -out.report.size_p5), 0.6);
  EXPECT_GE(out.report.least_planar_deg, 18);
}

TEST(AdaptComplex, KeepsACubeOfThreeMaterialsConforming) {
  const LabelVolume volume = test::make_volume(16, 16, 16, [](int i, int j, int) {
    return i < 8 ? 1 : j < 8 ? 2 : 3;
  });
  const SurfaceMesh reference = extracted(volume, true);
  const Adapted out = adapt(reference, test::uniform_sizing(2), {});
  EXPECT_LT(out.surface.triangles.size(), reference.triangles.size() / 4);
  EXPECT_GE(out.report.least_planar_deg, 18);
  EXPECT_GE(out.report.least_dihedral_deg, 25);
  expect_volumes_kept(reference, out.surface, 5e-3);
}

TEST(AdaptComplex, KeepsTheSheetsOfAThinSlabApart) {
  // Two voxels thick, edges asked for twice as long.
  const LabelVolume volume = test::make_volume(
      28, 28, 10, [](int i, int j, int k) { return i > 3 && i < 24 && j > 3 && j < 24 && k > 3 && k < 6; });
  const SurfaceMesh reference = extracted(volume, true);
  const Adapted out = adapt(reference, test::uniform_sizing(4), {});
  expect_volumes_kept(reference, out.surface, 0.02);
}

TEST(AdaptComplex, KeepsTheHoleOfATorus) {
  const SurfaceMesh torus = test::torus(8, 2.5, 120, 48, 1);
  AdaptParams params;
  params.voxel_mm = 0.5;
  const Adapted out = adapt(torus, test::uniform_sizing(1), params);
  EXPECT_GE(out.report.least_planar_deg, 25);
  expect_volumes_kept(torus, out.surface, 2e-3);
}

TEST(AdaptComplex, KeepsNestedBoxesApart) {
  const LabelVolume volume = test::make_volume(24, 24, 24, [](int i, int j, int k) {
    const int depth = std::min({i, j, k, 23 - i, 23 - j, 23 - k});
    return depth < 3 ? 0 : depth < 5 ? 1 : depth < 7 ? 2 : 3;
  });
  const SurfaceMesh reference = extracted(volume, true);
  const Adapted out = adapt(reference, test::uniform_sizing(3), {});
  expect_volumes_kept(reference, out.surface, 5e-3);
}

TEST(AdaptComplex, CoarsensThenCutsInFour) {
  const LabelVolume volume = test::make_volume(28, 28, 28, [](int i, int j, int k) {
    const Eigen::Vector3d p(i - 13.3, j - 13.4, k - 13.6);
    return p.norm() > 12 ? 0 : i < 14 ? 1 : 2;
  });
  const SizingField sizing = test::sampled_sizing({0, 0, 0}, {28, 28, 28}, 4, [](const Eigen::Vector3d& p) {
    return std::clamp(0.3 * (p - Eigen::Vector3d(14, 1, 14)).norm(), 1.2, 4.0);
  });
  AdaptParams params;
  params.schedule = AdaptSchedule::kPaper;
  const SurfaceMesh reference = extracted(volume, true);
  const Adapted out = adapt(reference, sizing, params);
  EXPECT_GT(out.record.accepted[0], 0U);
  EXPECT_LE(std::max(out.report.size_p95, -out.report.size_p5), 0.85);
  EXPECT_GE(out.report.least_planar_deg, 18);
  expect_volumes_kept(reference, out.surface, 5e-3);
}

class AdaptNoise : public ::testing::TestWithParam<int> {};

TEST_P(AdaptNoise, NeverChangesTopologyNorIntersects) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  const LabelVolume volume = test::random_volume(4 + GetParam() % 3, 1 + GetParam() % 5, seed);
  AdaptParams params;
  params.schedule = GetParam() % 4 == 3 ? AdaptSchedule::kPaper : AdaptSchedule::kAdaptive;
  params.verify = GetParam() < 2 || GetParam() % 5 == 0;
  adapt(extracted(volume, false), test::uniform_sizing(0.6 + GetParam() % 4), params);
}
INSTANTIATE_TEST_SUITE_P(Seeds, AdaptNoise, ::testing::Range(0, 12));

TEST(AdaptComplex, LeavesWhatAdmitsNoOperation) {
  // One tetrahedron: no collapse keeps it, no split is asked for.
  SurfaceMesh tet;
  tet.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  tet.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  tet.sides.assign(4, {1, 0});
  const Adapted out = adapt(tet, test::uniform_sizing(100), {});
  EXPECT_EQ(out.surface.triangles.size(), 4U);
}

TEST(AdaptComplex, StopsWhenCancelled) {
  RunContext ctx;
  ctx.on_cancelled = [] { return true; };
  const Result<SurfaceMesh> out =
      adapt_complex(test::sphere({0, 0, 0}, 10, 3, 1, 0), test::uniform_sizing(2), {}, ctx);
  ASSERT_FALSE(out.ok());
  EXPECT_EQ(out.error().code, ErrorCode::kCancelled);
}

TEST(AdaptComplex, AdaptsScarredMyocardium) {
  const std::string path = test::shared_data("biv_ed_scar_1mm.nii.gz");
  if (path.empty()) GTEST_SKIP() << "biv_ed_scar_1mm.nii.gz is not present";
  Result<LabelVolume> whole = read_volume_file(path);
  ASSERT_TRUE(whole.ok());
  const std::vector<Label> keep{1, 2, 5, 6};
  const LabelVolume crop = test::make_volume(26, 26, 26, [&](int i, int j, int k) {
    const Label label = whole->at_or_background(i + 104, j + 50, k + 50);
    return std::find(keep.begin(), keep.end(), label) == keep.end() ? kBackground : label;
  });
  const SurfaceMesh reference = extracted(crop, true);
  ASSERT_EQ(find_self_intersections(reference).size(), 0U);
  ASSERT_GE(test::labels_of(reference).size(), 3U);
  const Adapted out = adapt(reference, test::uniform_sizing(2), {});
  EXPECT_GE(out.report.least_planar_deg, 15);
  EXPECT_GE(out.report.least_dihedral_deg, 20);
}

}  // namespace
}  // namespace voxtet::remesh
