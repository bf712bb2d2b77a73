// Points of a surface put into the planes of cuts.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/cut/cut_faces.h"

namespace voxtet {
namespace {

constexpr Label kBody = 1, kBeyond = 9;

/// The plane z = 0, with what is above it beyond.
CutPlanes level() {
  CutPlane cut;
  cut.beyond = kBeyond;
  cut.normal = Eigen::Vector3d::UnitZ();
  cut.labels = {kBody};
  return {cut};
}

/// The angle between the triangles a b p and a b q, degrees; 0 where one lies upon the other.
double angle_deg(const SurfaceMesh& surface, std::uint32_t a, std::uint32_t b, std::uint32_t p,
                 std::uint32_t q) {
  const Eigen::Vector3d along = (surface.points[b] - surface.points[a]).normalized();
  const auto across = [&](std::uint32_t c) -> Eigen::Vector3d {
    const Eigen::Vector3d d = surface.points[c] - surface.points[a];
    return d - d.dot(along) * along;
  };
  return std::atan2(across(p).cross(across(q)).norm(), across(p).dot(across(q))) * 57.29578;
}

// A thin part of the body: its wall has all corners on the rim, and would lie upon the cut's face in the
// plane.
TEST(FlattenCuts, FoldsNoWallUponTheCut) {
  constexpr double kDepth = 0.3, kOff = 0.05;
  SurfaceMesh surface;
  surface.points = {{0, 0, 0}, {4, 0, 0}, {2, 3, 0}, {2, 1, -kDepth}, {5, 4, 0}, {8, 0, kOff}, {8, 4, kOff}};
  surface.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 3, 4}, {4, 5, 6}};
  surface.sides = {{kBeyond, kBody}, {kBody, 0}, {kBody, 0}, {kBeyond, kBody}, {kBeyond, kBody}};
  const double before = angle_deg(surface, 0, 1, 2, 3);
  const double remains = flatten_cuts(surface, level());
  EXPECT_GT(angle_deg(surface, 0, 1, 2, 3), 4);
  EXPECT_LT(angle_deg(surface, 0, 1, 2, 3), before);
  EXPECT_GT(angle_deg(surface, 1, 2, 0, 3), 4);
  EXPECT_NEAR(remains, -surface.points[3].z(), 1e-12);  // it says how far the one point is off
  EXPECT_LT(remains, kDepth);
  for (const std::uint32_t p : {0U, 1U, 2U, 4U, 5U, 6U})
    EXPECT_LT(std::abs(surface.points[p].z()), 1e-12) << p;
}

// A rim at which the wall turns away goes into the plane as a whole.
TEST(FlattenCuts, PutsARimIntoThePlane) {
  SurfaceMesh surface;
  surface.points = {{0, 0, 0.1}, {2, 0, -0.1}, {1, 2, 0.1}, {1, 0.2, -1}};
  surface.triangles = {{0, 2, 1}, {0, 1, 3}};
  surface.sides = {{kBeyond, kBody}, {kBody, 0}};
  EXPECT_LT(flatten_cuts(surface, level()), 1e-12);
  for (const std::uint32_t p : {0U, 1U, 2U}) EXPECT_LT(std::abs(surface.points[p].z()), 1e-12) << p;
  EXPECT_DOUBLE_EQ(surface.points[3].z(), -1);
}

}  // namespace
}  // namespace voxtet
