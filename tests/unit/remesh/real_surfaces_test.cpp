// The adapted surfaces of the real volumes, where they are present.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/digest.h"
#include "geometry/elements/surface_measures.h"
#include "geometry/intersect/self_intersections.h"
#include "geometry/topology/label_topology.h"
#include "io/volume/read_volume.h"
#include "quality/surface_distance.h"
#include "remesh/remesh_surface.h"
#include "support/check_surface.h"
#include "support/data.h"
#include "support/label_bodies.h"
#include "support/label_surface.h"
#include "support/test_surfaces.h"
#include "surface_report.h"
#include "volume/prepare_volume.h"

namespace voxtet {
namespace {

struct RealCase {
  const char* file;
  std::vector<Label> keep;  ///< empty: all labels
  double edge_mm;
  // Measured, with a margin:
  double least_planar_deg, least_dihedral_deg;
  double volume_share;     ///< error of the enclosed volume of any label of 1000 voxels or more
  double farthest_voxels;  ///< between label surface and adapted surface, either way
};

class RemeshReal : public ::testing::TestWithParam<RealCase> {};

/// The label of 1000 voxels or more whose enclosed volume differs most, relatively, from its voxels'.
std::pair<double, Label> worst_volume(const SurfaceMesh& surface, const LabelVolume& volume) {
  std::pair<double, Label> worst{0, kBackground};
  const std::vector<double> counts = test::label_counts(volume);
  for (const Label label : test::labels_of(surface)) {
    if (counts[label] < 1000) continue;
    const double voxels = enclosed_volume_mm3(surface, label) / volume.voxel_mm3();
    worst = std::max(worst, {std::abs(voxels / counts[label] - 1), label});
  }
  return worst;
}

/// Null where the file is not present.
std::shared_ptr<const LabelVolume> prepared(const char* name, const std::vector<Label>& keep,
                                            const std::vector<std::vector<Label>>& merge = {}) {
  const std::string path = test::shared_data(name);
  if (path.empty()) return nullptr;
  const Result<LabelVolume> file = read_volume_file(path);
  EXPECT_TRUE(file.ok()) << file.error().message;
  RunContext ctx;
  const Result<PreparedVolume> prepared =
      prepare_volume(std::make_shared<const LabelVolume>(*file), keep, merge, {}, ctx);
  EXPECT_TRUE(prepared.ok()) << prepared.error().message;
  return prepared->prepared;
}

TEST_P(RemeshReal, IsClosedWellShapedCloseAndReadyToFill) {
  const RealCase& real = GetParam();
  const std::shared_ptr<const LabelVolume> present = prepared(real.file, real.keep);
  if (!present) GTEST_SKIP() << real.file << " is not present";
  const LabelVolume& volume = *present;
  RunContext ctx;

  const SizingField sizing = test::uniform_sizing(real.edge_mm);
  const SurfaceMesh reference = test::label_surface(volume);
  std::string said;
  ctx.on_note =
      ctx.on_warning = [&](const std::string&, const std::string& message) { said += message + "; "; };
  const Result<SurfaceMesh> surface = remesh_surface(volume, reference, sizing, {}, ctx);
  ASSERT_TRUE(surface.ok()) << surface.error().message;

  EXPECT_TRUE(test::is_valid_surface(*surface));
  EXPECT_EQ(label_topology(*surface), label_topology(reference));
  EXPECT_EQ(find_self_intersections(*surface, 1).size(), 0U);
  const test::SurfaceReport report = test::report_on(*surface, sizing);
  EXPECT_GE(report.least_planar_deg, real.least_planar_deg);
  EXPECT_GE(report.least_dihedral_deg, real.least_dihedral_deg);
  const auto [volume_error, worst_label] = worst_volume(*surface, volume);
  EXPECT_LE(volume_error, real.volume_share) << worst_label;

  const double voxel = volume.smallest_spacing_mm();
  const Result<SurfaceDistances> distances =
      measure_distances({surface->points, surface->triangles, surface->sides},
                        {reference.points, reference.triangles, reference.sides}, {voxel, 0.1 * voxel}, ctx);
  ASSERT_TRUE(distances.ok());
  for (const DistanceSummary& way : {distances->forth, distances->back}) {
    EXPECT_LE(way.mean_mm, 0.15 * voxel);
    EXPECT_LE(way.p95_mm, 0.4 * voxel);
    EXPECT_LE(way.max_mm, real.farthest_voxels * voxel);
  }
  RecordProperty("said", said);
  RecordProperty("digest", digest_of(*surface));
  RecordProperty("triangles", static_cast<int>(surface->triangles.size()));
  RecordProperty("planar_deg", std::to_string(report.least_planar_deg));
  RecordProperty("dihedral_deg", std::to_string(report.least_dihedral_deg));
  RecordProperty("size_median", std::to_string(report.size_median));
  RecordProperty("volume_error", std::to_string(volume_error));
  RecordProperty("worst_label", static_cast<int>(worst_label));
  RecordProperty("mean_voxels", std::to_string(distances->forth.mean_mm / voxel));
  RecordProperty("p95_voxels", std::to_string(distances->forth.p95_mm / voxel));
  RecordProperty("max_voxels", std::to_string(distances->forth.max_mm / voxel));
  RecordProperty("max_back_voxels", std::to_string(distances->back.max_mm / voxel));
}

TEST(RemeshRealMerged, KeepsItsNarrowestTunnelByRefinementAndIsCoarseAroundItsNecks) {
  const std::shared_ptr<const LabelVolume> volume = prepared("biv_es_oblique_sax.nii.gz", {1, 2}, {{1, 2}});
  if (!volume) GTEST_SKIP() << "biv_es_oblique_sax.nii.gz is not present";
  RunContext ctx;
  std::string warned;
  ctx.on_warning = [&](const std::string&, const std::string& message) { warned += message + "; "; };
  const SurfaceMesh reference = test::label_surface(*volume);
  for (const double edge_mm : {2.8, 3.0}) {
    const SizingField sizing = test::uniform_sizing(edge_mm);
    const Result<SurfaceMesh> surface = remesh_surface(*volume, reference, sizing, {}, ctx);
    ASSERT_TRUE(surface.ok()) << surface.error().message;
    EXPECT_EQ(warned, "");
    EXPECT_EQ(label_topology(*surface), label_topology(reference));
    EXPECT_GE(test::report_on(*surface, sizing).size_p5, -0.5);
  }
}

/// What single operations leave has one angle of 18.1 degrees here.
TEST(RemeshRealByOperations, OpensTheSmallestAnglesWithHealing) {
  const std::shared_ptr<const LabelVolume> volume = prepared("biv_es_oblique_sax.nii.gz", {1, 2});
  if (!volume) GTEST_SKIP() << "biv_es_oblique_sax.nii.gz is not present";
  const SizingField sizing = test::uniform_sizing(2 * volume->smallest_spacing_mm());
  RemeshParams params;
  params.method = RemeshMethod::kAdapt;
  RunContext ctx;
  const SurfaceMesh reference = test::label_surface(*volume);
  const Result<SurfaceMesh> surface = remesh_surface(*volume, reference, sizing, params, ctx);
  ASSERT_TRUE(surface.ok()) << surface.error().message;
  EXPECT_TRUE(test::is_valid_surface(*surface));
  EXPECT_EQ(label_topology(*surface), label_topology(reference));
  EXPECT_EQ(find_self_intersections(*surface, 1).size(), 0U);
  EXPECT_GE(test::report_on(*surface, sizing).least_planar_deg, 19.5);
}

INSTANTIATE_TEST_SUITE_P(
    Shared, RemeshReal,
    ::testing::Values(RealCase{"biv_mean_1mm.nii.gz", {1, 2}, 1.56, 29, 30, 0.002, 0.5},
                      RealCase{"biv_ed_scar_1mm.nii.gz", {1, 2, 5, 6}, 2, 29, 30, 0.002, 0.5},
                      RealCase{"ct_heart_1.5mm.nii.gz", {}, 3, 29, 60, 0.002, 0.75},
                      // A junction's curve is too far away where none of the facets beside it is.
                      RealCase{"ct_aorta_dissection_1.5mm.nii.gz", {}, 2.5, 29, 30, 0.002, 0.5},
                      // A vertex gets there only after an edge at it is split.
                      RealCase{"ct_aorta_dissection_1.5mm.nii.gz", {}, 3.3, 29, 30, 0.002, 0.5},
                      RealCase{"biv_es_oblique_sax.nii.gz", {1, 2}, 3, 29, 30, 0.002, 0.5},
                      // One place is 0.51 voxel away.
                      RealCase{"prostate_phantom.nrrd", {8, 9}, 2, 29, 30, 0.005, 0.55},
                      RealCase{"mickey.nrrd", {}, 2, 29, 55, 0.002, 0.5}),
    [](const auto& info) {
      const std::string name = info.param.file;
      return name.substr(0, name.find_first_of('.')) + "_at_" +
             std::to_string(std::lround(1000 * info.param.edge_mm)) + "um";
    });

}  // namespace
}  // namespace voxtet
