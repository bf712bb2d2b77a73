#include "physics/ventricles/bislerp.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/heart_fibres.h"

namespace voxtet {
namespace {

using test::kRadians;

Eigen::Matrix3d turn(const Eigen::Vector3d& axis, double degrees) {
  return Eigen::AngleAxisd(degrees * kRadians, axis.normalized()).toRotationMatrix();
}

double distance(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

/// A frame without symmetry.
Eigen::Matrix3d frame() {
  return turn({1, 2, -0.5}, 73);
}

TEST(Bislerp, TurnsEvenlyAboutTheCommonAxis) {
  for (const double angle : {0.0, 1e-9, 10.0, 45.0, 89.0, -60.0})
    for (const double t : {0.0, 0.25, 0.5, 1.0}) {
      const Eigen::Matrix3d b = frame() * turn({0, 0, 1}, angle);
      EXPECT_LT(distance(bislerp(frame(), b, t), frame() * turn({0, 0, 1}, t * angle)), 1e-14)
          << angle << ' ' << t;
    }
}

TEST(Bislerp, GoesTheShorterWayToTheSameDirectionsWithOtherSigns) {
  // A frame turned by 120 degrees about its third column has the directions of one turned by -60: half a turn
  // lies between them.
  const Eigen::Matrix3d b = frame() * turn({0, 0, 1}, 120);
  for (const double t : {0.25, 0.5, 1.0}) {
    const Eigen::Matrix3d expected = frame() * turn({0, 0, 1}, 180 - 60 * t);
    EXPECT_LT(distance(bislerp(frame(), b, t), expected), 1e-14) << t;
  }
}

TEST(Bislerp, SignsOfColumnsDoNotMatter) {
  const Eigen::Matrix3d a = frame(), b = turn({0.3, -1, 2}, 150);
  const Eigen::Matrix3d expected = bislerp(a, b, 0.3);
  for (const Eigen::Vector3d& signs :
       {Eigen::Vector3d(1, -1, -1), Eigen::Vector3d(-1, 1, -1), Eigen::Vector3d(-1, -1, 1)}) {
    EXPECT_LT(distance(bislerp(a * signs.asDiagonal(), b, 0.3), expected), 1e-14);
    const Eigen::Matrix3d other = bislerp(a, b * signs.asDiagonal(), 0.3);
    for (int column = 0; column < 3; ++column)
      EXPECT_NEAR(std::abs(other.col(column).dot(expected.col(column))), 1, 1e-14);
  }
}

TEST(Bislerp, IsSlerpOfTheNearestFrame) {
  for (int i = 0; i < 50; ++i) {
    const Eigen::Matrix3d a = turn({1.0 * i - 20, 3, 0.7 * i}, 7 * i),
                          b = turn({2, 0.5 * i, -9}, 360 - 11 * i);
    double nearest = 4;
    Eigen::Matrix3d expected;
    for (const Eigen::Vector3d& signs : {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1, -1, -1),
                                         Eigen::Vector3d(-1, 1, -1), Eigen::Vector3d(-1, -1, 1)}) {
      const Eigen::Quaterniond from(Eigen::Matrix3d(a * signs.asDiagonal())), to(b);
      if (from.angularDistance(to) >= nearest) continue;
      nearest = from.angularDistance(to);
      expected = from.slerp(0.35, to).toRotationMatrix();
    }
    const Eigen::Matrix3d found = bislerp(a, b, 0.35);
    EXPECT_LT(distance(found, expected), 1e-13) << i;
    EXPECT_LT(distance(found.transpose() * found, Eigen::Matrix3d::Identity()), 1e-14);
    EXPECT_LT(distance(bislerp(a, b, 1), b), 1e-13);
  }
}

}  // namespace
}  // namespace voxtet
