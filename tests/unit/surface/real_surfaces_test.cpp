// Extraction and smoothing of the real volumes, where they are present.
#include <gtest/gtest.h>

#include "geometry/elements/surface_measures.h"
#include "geometry/intersect/self_intersections.h"
#include "io/volume/read_volume.h"
#include "support/check_surface.h"
#include "support/data.h"
#include "support/label_bodies.h"
#include "support/surface_labels.h"
#include "surface/extract/extract_surface.h"
#include "surface/smooth/smooth_surface.h"

namespace voxtet {
namespace {

class RealSurfaces : public ::testing::TestWithParam<const char*> {};

TEST_P(RealSurfaces, AreClosedAndKeepTheirVolumes) {
  const std::string path = test::shared_data(GetParam());
  if (path.empty()) GTEST_SKIP() << GetParam() << " is not present";
  const Result<LabelVolume> volume = read_volume_file(path);
  ASSERT_TRUE(volume.ok()) << volume.error().message;
  RunContext ctx;
  const Result<SurfaceMesh> raw = extract_surface(*volume, {}, ctx);
  ASSERT_TRUE(raw.ok()) << raw.error().message;
  EXPECT_TRUE(test::is_valid_surface(*raw));
  const Result<SurfaceMesh> smooth = smooth_surface(*raw, *volume, {}, ctx);
  ASSERT_TRUE(smooth.ok()) << smooth.error().message;
  EXPECT_TRUE(test::is_valid_surface(*smooth));

  const std::vector<double> counts = test::label_counts(*volume);
  double worst = 0;
  for (const Label label : test::labels_of(*smooth)) {
    const double voxels = enclosed_volume_mm3(*smooth, label) / volume->voxel_mm3();
    const double error = std::abs(voxels / counts[label] - 1);
    worst = std::max(worst, error);
    if (counts[label] < 1000) continue;
    EXPECT_LE(error, 0.001) << label << " of " << counts[label] << " voxels";
  }
  const double before = staircase_energy_mm(*raw), after = staircase_energy_mm(*smooth);
  const test::ChangedVoxels changed = test::changed_voxels(*smooth, *volume);
  EXPECT_EQ(changed.inner, 0U);
  EXPECT_EQ(changed.thin, 0U);
  EXPECT_TRUE(find_self_intersections(*smooth, 1).empty());
  RecordProperty("triangles", static_cast<int>(raw->triangles.size()));
  RecordProperty("worst_volume_error", std::to_string(worst));
  RecordProperty("energy_ratio", std::to_string(before / after));
  RecordProperty("changed_voxels", static_cast<int>(changed.all));
}

INSTANTIATE_TEST_SUITE_P(Shared, RealSurfaces,
                         ::testing::Values("biv_ed_scar_1mm.nii.gz", "ct_torso_62labels_3mm.nii.gz",
                                           "biv_es_oblique_sax.nii.gz", "prostate_phantom.nrrd",
                                           "mickey.nrrd", "skull.nrrd"),
                         [](const auto& info) {
                           std::string name = info.param;
                           name = name.substr(0, name.find('.'));
                           return name;
                         });

}  // namespace
}  // namespace voxtet
