#include "tetra/mesh/tet_quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/elements/tet_measures.h"

namespace voxtet::tetra {
namespace {

/// Corners in the unit cube, the third and fourth swapped where the tet would be negative.
TetCorners random_tet(std::mt19937& random) {
  std::uniform_real_distribution<double> unit;
  TetCorners p;
  for (Point& corner : p)
    for (int d = 0; d < 3; ++d) corner[d] = unit(random);
  if (tet_volume_mm3(p) < 0) std::swap(p[2], p[3]);
  return p;
}

TEST(TetQuality, IsTheSquaredSineOfTheWorstAngleObtuseOnesOverSevenTenths) {
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    const TetCorners p = random_tet(random);
    double worst = 10;
    for (const double angle : measure_tet(p).dihedral_deg) {
      const double sine = std::sin(angle * EIGEN_PI / 180) / (angle > 90 ? 0.7 : 1);
      worst = std::min(worst, sine * sine);
    }
    EXPECT_NEAR(quality(p[0], p[1], p[2], p[3]) / worst, 1, 1e-6) << i;
  }
}

TEST(TetQuality, IsZeroForATetThatIsNotPositive) {
  const Point a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), d(0, 0, 1);
  EXPECT_GT(quality(a, b, c, d), 0);
  EXPECT_EQ(quality(a, c, b, d), 0);
  EXPECT_EQ(quality(a, b, c, Point(1, 1, 0)), 0);
}

TEST(TetQuality, TendsToZeroWithTheVolumeWhenThreeCornersAreInLine) {
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    TetCorners p = random_tet(random);
    const auto line = static_cast<std::size_t>(i % 4);
    p[line] = 0.3 * p[(line + 1) % 4] + 0.7 * p[(line + 2) % 4];
    EXPECT_LT(quality(p[0], p[1], p[2], p[3]), 1e-20) << i;
    EXPECT_LT(quality(p[0], p[2], p[1], p[3]), 1e-20) << i;
  }
}

TEST(TetQuality, OfAnAngleIsItsSquaredSine) {
  for (double angle = 1; angle <= 90; angle += 0.5)
    EXPECT_NEAR(quality_of_angle(angle), std::pow(std::sin(angle * EIGEN_PI / 180), 2), 2e-15) << angle;
}

TEST(ApexSines, HaveTheGradientsOfFiniteDifferences) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    const TetCorners p = random_tet(random);
    const ApexSines sines(p[0], p[1], p[2], p[3]);
    const double step = 1e-6 * std::cbrt(tet_volume_mm3(p));
    for (std::size_t e = 0; e < 6; ++e) {
      const Point gradient = sines.gradient(e);
      for (int d = 0; d < 3; ++d) {
        const Point shift = step * Point::Unit(d);
        const double difference = ApexSines(p[0] + shift, p[1], p[2], p[3]).values()[e] -
                                  ApexSines(p[0] - shift, p[1], p[2], p[3]).values()[e];
        EXPECT_NEAR(gradient[d], difference / (2 * step), 1e-5 * (gradient.norm() + 1 / step * 1e-9))
            << i << " edge " << e;
      }
    }
  }
}

}  // namespace
}  // namespace voxtet::tetra
