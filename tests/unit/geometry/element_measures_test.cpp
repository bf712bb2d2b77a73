#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "geometry/elements/tet_measures.h"
#include "geometry/elements/triangle_measures.h"

namespace voxtet {
namespace {

using Eigen::Vector3d;

const TetCorners kRegular{Vector3d(1, 1, 1), Vector3d(-1, 1, -1), Vector3d(1, -1, -1), Vector3d(-1, -1, 1)};
const TetCorners kCorner{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1)};

TEST(MeasureTet, GivesOneForTheRegularTetrahedron) {
  const TetShape s = measure_tet(kRegular);
  EXPECT_NEAR(s.volume_mm3, 8.0 / 3, 1e-14);
  for (const double angle : s.dihedral_deg) EXPECT_NEAR(angle, 70.528779365509308, 1e-12);
  for (const double edge : s.edge_mm) EXPECT_NEAR(edge, std::sqrt(8), 1e-14);
  EXPECT_NEAR(s.radius_ratio, 1, 1e-14);
  EXPECT_NEAR(s.mean_ratio, 1, 1e-14);
  EXPECT_NEAR(s.aspect_ratio, 1, 1e-14);
}

TEST(MeasureTet, MatchesClosedFormsOnTheCornerOfACube) {
  const TetShape s = measure_tet(kCorner);
  EXPECT_NEAR(s.volume_mm3, 1.0 / 6, 1e-15);
  for (int e = 0; e < 3; ++e) EXPECT_NEAR(s.dihedral_deg[e], 90, 1e-12);
  for (int e = 3; e < 6; ++e) EXPECT_NEAR(s.dihedral_deg[e], 54.735610317245346, 1e-12);
  const double r = 3 * (1.0 / 6) / (1.5 + std::sqrt(3) / 2);
  EXPECT_NEAR(s.radius_ratio, 3 * r / (std::sqrt(3) / 2), 1e-14);
  EXPECT_NEAR(s.mean_ratio, 12 * std::pow(0.5, 2.0 / 3) / 9, 1e-14);
  EXPECT_NEAR(s.aspect_ratio, std::sqrt(2) / (2 * std::sqrt(6) * r), 1e-13);
}

TEST(MeasureTet, SeesEveryKindOfBadTetrahedron) {
  const double t = 1e-4;
  const TetCorners sliver{Vector3d(1, 0, t), Vector3d(0, 1, -t), Vector3d(-1, 0, t), Vector3d(0, -1, -t)};
  const TetCorners cap{Vector3d(1, 0, 0), Vector3d(-0.5, 0.8, 0), Vector3d(-0.5, -0.8, 0), Vector3d(0, 0, t)};
  const TetCorners needle{Vector3d(0, 0, 0), Vector3d(t, 0, 0), Vector3d(0, t, 0), Vector3d(0, 0, 1)};
  const TetCorners wedge{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0.5, 0.8, -t), Vector3d(0.5, 0.8, t)};
  for (TetCorners p : {sliver, cap, needle, wedge}) {
    if (tet_volume_mm3(p) < 0) std::swap(p[0], p[1]);
    const TetShape s = measure_tet(p);
    EXPECT_GT(s.volume_mm3, 0);
    EXPECT_LT(s.radius_ratio, 0.01);
    EXPECT_LT(s.mean_ratio, 0.02);
    EXPECT_GT(s.aspect_ratio, 10);
  }
  const TetShape s = measure_tet(sliver);
  EXPECT_LT(*std::min_element(s.dihedral_deg.begin(), s.dihedral_deg.end()), 0.05);
  EXPECT_GT(*std::max_element(s.dihedral_deg.begin(), s.dihedral_deg.end()), 179.9);
}

TEST(MeasureTet, GivesZeroRatiosForFlatAndInvertedOnes) {
  TetCorners p = kRegular;
  std::swap(p[0], p[1]);
  const TetShape inverted = measure_tet(p);
  EXPECT_LT(inverted.volume_mm3, 0);
  EXPECT_EQ(inverted.radius_ratio, 0);
  EXPECT_TRUE(std::isinf(inverted.aspect_ratio));
  const TetShape flat =
      measure_tet({Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(1, 1, 0)});
  EXPECT_EQ(flat.mean_ratio, 0);
}

TEST(MeasureTet, IgnoresPositionRotationAndScale) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int round = 0; round < 200; ++round) {
    TetCorners p;
    for (Vector3d& c : p) c = Vector3d(unit(random), unit(random), unit(random));
    if (tet_volume_mm3(p) < 0) std::swap(p[0], p[1]);
    if (tet_volume_mm3(p) < 1e-3) continue;
    const Eigen::AngleAxisd rotation(unit(random) * 3, Vector3d(unit(random), unit(random), 1).normalized());
    TetCorners q;
    for (std::size_t i = 0; i < 4; ++i) q[i] = 0.01 * (rotation * p[i]) + Vector3d(0.3, -0.2, 0.1);
    const TetShape a = measure_tet(p), b = measure_tet(q);
    for (std::size_t e = 0; e < 6; ++e) EXPECT_NEAR(a.dihedral_deg[e], b.dihedral_deg[e], 1e-9);
    EXPECT_NEAR(a.radius_ratio, b.radius_ratio, 1e-10);
    EXPECT_NEAR(a.mean_ratio, b.mean_ratio, 1e-12);
    EXPECT_NEAR(a.aspect_ratio, b.aspect_ratio, 1e-10 * a.aspect_ratio);
  }
}

TEST(MeasureTriangle, MatchesClosedForms) {
  const TriangleShape equilateral =
      measure_triangle({Vector3d(0, 0, 0), Vector3d(2, 0, 0), Vector3d(1, std::sqrt(3), 0)});
  EXPECT_NEAR(equilateral.area_mm2, std::sqrt(3), 1e-14);
  EXPECT_NEAR(equilateral.min_angle_deg, 60, 1e-12);
  EXPECT_NEAR(equilateral.max_angle_deg, 60, 1e-12);
  EXPECT_NEAR(equilateral.radius_ratio, 1, 1e-14);
  EXPECT_NEAR(equilateral.aspect_ratio, 1, 1e-14);
  const TriangleShape right = measure_triangle({Vector3d(0, 0, 5), Vector3d(3, 0, 5), Vector3d(0, 4, 5)});
  EXPECT_NEAR(right.max_angle_deg, 90, 1e-12);
  EXPECT_NEAR(right.radius_ratio, 2 * 1 / 2.5, 1e-14);
  EXPECT_NEAR(right.aspect_ratio, 5 / (2 * std::sqrt(3)), 1e-14);
  EXPECT_TRUE(
      std::isinf(measure_triangle({Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(2, 0, 0)}).aspect_ratio));
}

TEST(MeasureTriangle, GivesCosinesOfAnglesAndFolds) {
  EXPECT_NEAR(sharpest_cosine({Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)}), std::sqrt(0.5),
              1e-15);
  EXPECT_EQ(sharpest_cosine({Vector3d(1, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)}), 1);
  EXPECT_NEAR(fold_cosine({0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {0, 0, 3}), 0, 1e-15);
  EXPECT_NEAR(fold_cosine({0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {0, -2, 0}), -1, 1e-15);
}

TEST(MeasureTriangle, GivesTheDistanceOfACornerToAnother) {
  const TriangleCorners flat{Vector3d(0, 0, 0), Vector3d(4, 0, 0), Vector3d(0, 4, 0)};
  const TriangleCorners above{Vector3d(1, 1, 3), Vector3d(1, 1, 5), Vector3d(2, 1, 5)};
  EXPECT_NEAR(corner_distance2(flat, above), 9, 1e-14);
  EXPECT_NEAR(corner_distance2(above, flat), 9, 1e-14);
}

}  // namespace
}  // namespace voxtet
