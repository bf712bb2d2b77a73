// The cavities of ventricles beside the voxels of their blood pools.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "anatomy/find_heart_surfaces.h"
#include "io/volume/read_volume.h"
#include "meshed_image.h"
#include "phantom/make_phantom.h"
#include "physics/cavities/cavity.h"
#include "physics/cavities/enclosure.h"
#include "support/data.h"

namespace voxtet {
namespace {

double pool_mm3(const LabelVolume& image, Label label) {
  const auto voxels = std::count(image.labels.begin(), image.labels.end(), label);
  return static_cast<double>(voxels) * std::abs(image.index_to_mm.topLeftCorner<3, 3>().determinant());
}

void expect_pools(const TetMesh& mesh, const LabelVolume& image, const std::vector<Label>& wall) {
  RunContext ctx;
  const auto surfaces = find_heart_surfaces(mesh, image, {wall, {3}, {4}}, ctx);
  ASSERT_TRUE(surfaces.ok()) << surfaces.error().message;
  for (const auto& [ventricle, label] : {std::pair{Ventricle::kLeft, 3}, std::pair{Ventricle::kRight, 4}}) {
    const auto cavity = ventricle_cavity(mesh, *surfaces, ventricle);
    ASSERT_TRUE(cavity.ok()) << cavity.error().message;
    EXPECT_NEAR(volume_mm3(*cavity, mesh.points) / pool_mm3(image, static_cast<Label>(label)), 1, 0.03)
        << label;
  }
}

TEST(Cavities, HoldTheirBloodPools) {
  const LabelVolume image = make_phantom({}).value();
  expect_pools(test::mesh_image(image, {1, 2}, 4), image, {1, 2});
}

TEST(Cavities, HoldTheirBloodPoolsWhereTheseAreMeshed) {
  const LabelVolume image = make_phantom({}).value();
  expect_pools(test::mesh_image(image, {}, 5), image, {1, 2});
}

TEST(Cavities, HoldTheBloodPoolsOfAPatient) {
  const std::string path = test::shared_data("biv_ed_scar_1mm.nii.gz");
  if (path.empty()) GTEST_SKIP() << "the volume is not there: set VOXTET_DATA";
  const LabelVolume image = read_volume_file(path).value();
  const std::vector<Label> wall{1, 2, 5, 6};
  expect_pools(test::mesh_image(image, wall, 3), image, wall);
}

}  // namespace
}  // namespace voxtet
