// Signed distances from voxel centres to the boundaries of labels.
#include "remesh/field/label_distances.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "remesh/field/thin_voxels.h"
#include "support/test_surfaces.h"

namespace voxtet::remesh {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kSize = 14, kRim = 4;

LabelVolume make_grid(const std::function<Label(const Vector3d&)>& label_at,
                      const Matrix3d& linear = Matrix3d::Identity(),
                      const Vector3d& origin = Vector3d::Zero()) {
  LabelVolume grid;
  grid.size = {kSize, kSize, kSize};
  grid.index_to_mm.topLeftCorner<3, 3>() = linear;
  grid.index_to_mm.topRightCorner<3, 1>() = origin;
  for (int k = 0; k < kSize; ++k)
    for (int j = 0; j < kSize; ++j)
      for (int i = 0; i < kSize; ++i) {
        const bool rim = std::min({i, j, k}) < 2 || std::max({i, j, k}) > kSize - 3;
        grid.labels.push_back(rim ? kBackground : label_at(Vector3d(i, j, k)));
      }
  return grid;
}

/// A patch of the plane normal . x = offset around the grid's middle between labels 2 and 1, vertices
/// `step` apart.
SurfaceMesh plane_patch(const Vector3d& normal, double offset, double step) {
  SurfaceMesh s;
  const Vector3d middle = Vector3d::Constant(0.5 * kSize);
  const Vector3d start = middle + (offset - normal.dot(middle)) * normal;
  const Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  const int n = static_cast<int>(kSize / step);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      s.points.push_back(start + (i * step - 0.5 * kSize + 0.13) * u + (j * step - 0.5 * kSize + 0.29) * v);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto a = static_cast<std::uint32_t>(i + (n + 1) * j), b = a + static_cast<std::uint32_t>(n) + 1;
      s.triangles.insert(s.triangles.end(), {{a, a + 1, b + 1}, {a, b + 1, b}});
    }
  s.sides.assign(s.triangles.size(), {2, 1});
  return s;
}

void to_frame(SurfaceMesh& surface, const Matrix3d& linear, const Vector3d& origin) {
  for (Vector3d& p : surface.points) p = linear * p + origin;
}

std::size_t voxel(int i, int j, int k) {
  return static_cast<std::size_t>(i + kSize * (j + kSize * k));
}

std::map<Label, float> entries(const LabelDistances& distances, std::size_t v) {
  std::map<Label, float> out;
  for (std::uint32_t e = distances.offsets[v]; e < distances.offsets[v + 1]; ++e)
    out[distances.labels[e]] = distances.values[e];
  return out;
}

struct Plane {
  Vector3d normal;  ///< of index space
  double offset;
  Matrix3d linear;
};

/// Calls check(distance from the plane in smallest spacings, entries) for the voxels near the plane and far
/// from the grid's rim.
template <class Check>
int check_voxels(const Plane& plane, Check&& check) {
  const Vector3d origin(12, -300, 4.5), n = plane.normal.normalized();
  const LabelVolume grid =
      make_grid([&](const Vector3d& x) { return n.dot(x) > plane.offset ? 2 : 1; }, plane.linear, origin);
  SurfaceMesh surface = plane_patch(n, plane.offset, 0.7);
  to_frame(surface, plane.linear, origin);
  const LabelDistances distances = label_distances(grid, surface);
  const double unit = plane.linear.colwise().norm().minCoeff();
  const double stretch = (plane.linear.inverse().transpose() * n).norm();
  int checked = 0;
  for (int k = kRim; k < kSize - kRim; ++k)
    for (int j = kRim; j < kSize - kRim; ++j)
      for (int i = kRim; i < kSize - kRim; ++i) {
        const std::map<Label, float> found = entries(distances, voxel(i, j, k));
        if (found.empty()) continue;
        check((n.dot(Vector3d(i, j, k)) - plane.offset) / stretch / unit, found);
        ++checked;
      }
  return checked;
}

TEST(LabelDistances, AreThoseToAPlaneInEveryFrame) {
  const Matrix3d turned = Eigen::AngleAxisd(0.7, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const Matrix3d mirrored = turned * Vector3d(0.8, -0.8, 0.8).asDiagonal();
  const Matrix3d slices = turned * Vector3d(1.5, 1, 2.2).asDiagonal();
  for (const Matrix3d& linear : {Matrix3d(Matrix3d::Identity()), mirrored, slices})
    for (const Vector3d& normal : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, -1)})
      for (const double inside : {0.3, 0.5, 0.8}) {
        const double offset = normal.sum() * 6 + inside;
        const int checked = check_voxels({normal, offset, linear}, [&](double distance, const auto& found) {
          const double clamped = std::clamp(std::abs(distance), 0.05, 2.0), sign = distance > 0 ? 1 : -1;
          ASSERT_EQ(found.size(), 2U);
          EXPECT_NEAR(found.at(1), -sign * clamped, 0.02);
          EXPECT_NEAR(found.at(2), sign * clamped, 0.02);
        });
        EXPECT_EQ(checked, 2 * (kSize - 2 * kRim) * (kSize - 2 * kRim));
      }
}

TEST(LabelDistances, AreExactToATiltedPlaneWithinAVoxel) {
  const Vector3d normal(2, 1, -0.7);
  int near = 0;
  check_voxels({normal, 6.1, Matrix3d::Identity()}, [&](double distance, const auto& found) {
    if (std::abs(distance) > 1 || std::abs(distance) < 0.05) return;
    EXPECT_NEAR(found.at(2), distance, 0.02);
    EXPECT_NEAR(found.at(1), -distance, 0.02);
    ++near;
  });
  EXPECT_GT(near, 50);
}

TEST(LabelDistances, AreNeverNearerThanATwentiethAndNeverFartherThanTwo) {
  int nearest = 0, farthest = 0;
  check_voxels({{1, 0, 0}, 6.01, Matrix3d::Identity()}, [&](double, const auto& found) {
    nearest += std::abs(found.at(1)) == LabelDistances::kNearest;
  });
  check_voxels({{0, 0, 1}, 6.5, Matrix3d(Vector3d(1, 1, 5).asDiagonal())}, [&](double, const auto& found) {
    farthest += std::abs(found.at(1)) == LabelDistances::kFarthest;
  });
  EXPECT_EQ(nearest, 36);
  EXPECT_EQ(farthest, 72);
}

TEST(LabelDistances, KeepTheVoxelsLabelWhereTheSurfaceHasPassedItsCentre) {
  const LabelVolume grid = make_grid([](const Vector3d& x) { return x[0] > 6.5 ? 2 : 1; });
  const LabelDistances distances = label_distances(grid, plane_patch({1, 0, 0}, 5.8, 0.7));
  EXPECT_NEAR(entries(distances, voxel(6, 7, 7)).at(1), 0.2, 0.02);
  EXPECT_NEAR(entries(distances, voxel(6, 7, 7)).at(2), -0.2, 0.02);
}

TEST(LabelDistances, KnowEveryLabelOfAJunction) {
  // Cell 0 of the surface reaches from 0 to 1: its centre is the first voxel's.
  const LabelVolume grid = make_grid(
      [](const Vector3d& x) {
        return static_cast<Label>(x[0] < 6.5 ? 1 : x[1] < 6.5 ? 2 : 40000);
      },
      Matrix3d::Identity(), Vector3d::Constant(0.5));
  const SurfaceMesh surface =
      test::cells(grid.size, 1, [&](int i, int j, int k) { return grid.labels[voxel(i, j, k)]; });
  const LabelDistances distances = label_distances(grid, surface);
  const auto expect = [&](int i, int j, float one, float two, float three) {
    const std::map<Label, float> found = entries(distances, voxel(i, j, 7));
    ASSERT_EQ(found.size(), 3U) << i << ' ' << j;
    EXPECT_NEAR(found.at(1), one, 0.02) << i << ' ' << j;
    EXPECT_NEAR(found.at(2), two, 0.02) << i << ' ' << j;
    EXPECT_NEAR(found.at(40000), three, 0.02) << i << ' ' << j;
  };
  const float diagonal = 0.7071F;
  expect(6, 6, 0.5F, -0.5F, -diagonal);
  expect(6, 7, 0.5F, -diagonal, -0.5F);
  expect(7, 6, -0.5F, 0.5F, -0.5F);
  expect(7, 7, -0.5F, -0.5F, 0.5F);
}

TEST(LabelDistances, AreLeftOutAmongEqualVoxels) {
  const LabelVolume grid = make_grid([](const Vector3d& x) { return x[0] > 6.5 ? 2 : 1; });
  const LabelDistances distances = label_distances(grid, plane_patch({1, 0, 0}, 6.5, 0.7));
  ASSERT_EQ(distances.offsets.size(), grid.voxel_count() + 1);
  EXPECT_TRUE(entries(distances, voxel(4, 7, 7)).empty());
  EXPECT_TRUE(entries(distances, voxel(0, 0, 0)).empty());
  EXPECT_EQ(entries(distances, voxel(6, 7, 7)).size(), 2U);
}

TEST(ThinVoxels, AreThoseOfSheetsAndWiresNotOfBumpsAndBodies) {
  // A body with a bump, a wire that leaves it, and a sheet apart.
  LabelVolume grid;
  grid.size = {20, 12, 12};
  grid.labels.assign(grid.voxel_count(), kBackground);
  const auto at = [](std::size_t i, std::size_t j, std::size_t k) { return i + 20 * (j + 12 * k); };
  for (std::size_t k = 3; k < 8; ++k)
    for (std::size_t j = 3; j < 8; ++j) {
      for (std::size_t i = 3; i < 7; ++i) grid.labels[at(i, j, k)] = 1;
      grid.labels[at(16, j, k)] = 1;
    }
  grid.labels[at(4, 5, 8)] = 1;
  for (std::size_t i = 7; i < 12; ++i) grid.labels[at(i, 5, 5)] = 1;
  EXPECT_FALSE(is_thin(grid, at(3, 3, 3))) << "corner of the body";
  EXPECT_FALSE(is_thin(grid, at(4, 5, 8))) << "bump";
  EXPECT_FALSE(is_thin(grid, at(4, 5, 7))) << "under the bump";
  EXPECT_TRUE(is_thin(grid, at(7, 5, 5))) << "root of the wire";
  EXPECT_TRUE(is_thin(grid, at(11, 5, 5))) << "end of the wire";
  EXPECT_TRUE(is_thin(grid, at(16, 5, 5))) << "sheet";
  EXPECT_TRUE(is_thin(grid, at(16, 3, 3))) << "corner of the sheet";
  EXPECT_FALSE(is_thin(grid, at(9, 5, 9))) << "background";
}

}  // namespace
}  // namespace voxtet::remesh
