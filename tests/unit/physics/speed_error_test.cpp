#include "physics/monodomain/speed_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/wave_speed_error.h"
#include "physics/monodomain/cell.h"
#include "support/bricks.h"
#include "support/uniform_tissue.h"

namespace voxtet {
namespace {

TEST(SpeedError, OfATetrahedronIsThatAcrossItsFibre) {
  const TetMesh mesh = test::bricks({2, 2, 2}, {1, 1, 1});
  Tissue tissue = test::uniform_tissue(mesh, 0.5, 0.2, Eigen::Vector3d::UnitX());
  tissue.kind[0] = Tissue::kNone;
  const auto errors = speed_errors_percent(mesh, tissue, 0);
  EXPECT_TRUE(std::isnan(errors[0]));
  // Kuhn's tetrahedron of a cube: three edges, two face diagonals, one space diagonal.
  const double edge = 2 * (3 + 2 * std::sqrt(2) + std::sqrt(3)) / 6;
  EXPECT_NEAR(errors[1], wave_speed_error_percent(edge, diffusivity_of(0.2, {}), 0), 1e-5);
}

TEST(SpeedError, IsGoneWhereTheDiffusivityIsCorrected) {
  for (const double mass : {0.0, 0.5, 1.0})
    for (const double edge : {0.3, 1.0, 2.5}) {
      const double d = diffusivity_of(0.5, {}), found = diffusivity_on_mesh(edge, d, mass);
      EXPECT_NEAR(std::sqrt(found / d) * (100 + wave_speed_error_percent(edge, found, mass)), 100, 1e-6)
          << mass << " " << edge;
    }
  const TetMesh mesh = test::bricks({2, 2, 2}, {1, 1, 1});
  const Tissue tissue = test::uniform_tissue(mesh, 0.5, 0.2, Eigen::Vector3d::UnitX());
  EXPECT_LT(speed_errors_percent(mesh, tissue, 0)[0], -10);
  // Beyond what was measured (here as 6 mm would be in tissue of 0.5) a part stays.
  EXPECT_GT(speed_errors_percent(mesh, tissue, 0, true)[0], speed_errors_percent(mesh, tissue, 0)[0] / 2);
}

}  // namespace
}  // namespace voxtet
