// The adapted surfaces of the real volumes, where they are present.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "geometry/digest.h"
#include "geometry/self_intersections.h"
#include "io/read_volume.h"
#include "remesh/remesh_surface.h"
#include "support/check_surface.h"
#include "support/data.h"
#include "support/label_bodies.h"
#include "support/test_surfaces.h"
#include "surface_report.h"

namespace voxtet {
namespace {

struct RealCase {
  const char* file;
  std::vector<Label> keep;  ///< empty: all labels
  double edge_mm;
  std::size_t flaws;  ///< edges and points allowed where a label's boundary touches itself
};

class RemeshReal : public ::testing::TestWithParam<RealCase> {};

TEST_P(RemeshReal, IsClosedWellShapedAndReadyToFill) {
  const RealCase& real = GetParam();
  const std::string path = test::shared_data(real.file);
  if (path.empty()) GTEST_SKIP() << real.file << " is not present";
  Result<LabelVolume> volume = read_volume_file(path);
  ASSERT_TRUE(volume.ok()) << volume.error().message;
  for (Label& label : volume->labels)
    if (!real.keep.empty() && std::find(real.keep.begin(), real.keep.end(), label) == real.keep.end())
      label = kBackground;

  const SizingField sizing = test::uniform_sizing(real.edge_mm);
  RunContext ctx;
  const Result<SurfaceMesh> surface = remesh_surface(*volume, sizing, {}, ctx);
  ASSERT_TRUE(surface.ok()) << surface.error().message;

  EXPECT_EQ(find_self_intersections(*surface, 1).size(), 0U);
  std::size_t flaws = 0, labels = 0;
  for (const test::LabelTopology& label : test::label_topologies(*surface)) {
    flaws += label.bad_edges + label.pinched_points;
    EXPECT_GT(label.volume_mm3, 0);
    ++labels;
  }
  EXPECT_LE(flaws, real.flaws);
  const std::vector<double> counts = test::label_counts(*volume);
  EXPECT_EQ(labels, static_cast<std::size_t>(
                        std::count_if(counts.begin() + 1, counts.end(), [](double c) { return c > 0; })));
  const test::SurfaceReport report = test::report_on(*surface, sizing);
  EXPECT_GE(report.least_planar_deg, 24);
  EXPECT_GE(report.least_dihedral_deg, 20);
  RecordProperty("digest", digest_of(*surface));
  RecordProperty("triangles", static_cast<int>(surface->triangles.size()));
  RecordProperty("planar_deg", std::to_string(report.least_planar_deg));
  RecordProperty("dihedral_deg", std::to_string(report.least_dihedral_deg));
  RecordProperty("size_median", std::to_string(report.size_median));
}

INSTANTIATE_TEST_SUITE_P(Shared, RemeshReal,
                         ::testing::Values(RealCase{"biv_mean_1mm.nii.gz", {1, 2}, 1.56, 0},
                                           RealCase{"biv_ed_scar_1mm.nii.gz", {1, 2, 5, 6}, 2, 8},
                                           RealCase{"ct_heart_1.5mm.nii.gz", {}, 3, 0},
                                           RealCase{"ct_aorta_dissection_1.5mm.nii.gz", {}, 2.5, 0},
                                           RealCase{"ct_torso_62labels_3mm.nii.gz", {}, 6, 8},
                                           RealCase{"biv_es_oblique_sax.nii.gz", {1, 2}, 3, 2},
                                           RealCase{"prostate_phantom.nrrd", {8, 9}, 2, 8},
                                           RealCase{"mickey.nrrd", {}, 2, 0}),
                         [](const auto& info) {
                           std::string name = info.param.file;
                           return name.substr(0, name.find_first_of('.'));
                         });

}  // namespace
}  // namespace voxtet
