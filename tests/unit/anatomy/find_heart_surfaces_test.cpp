#include "anatomy/find_heart_surfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "base/digest.h"
#include "meshed_image.h"

namespace voxtet {
namespace {

using test::mesh_image;

constexpr double kTop = 10;  // mm above the middle of the ellipsoids

/// Sampled about the origin with `mm` wide voxels.
LabelVolume sample(const Eigen::Vector3d& half_extent, double mm,
                   const std::function<Label(const Eigen::Vector3d&)>& label_at) {
  LabelVolume image;
  for (int d = 0; d < 3; ++d)
    image.size[static_cast<std::size_t>(d)] = 2 * static_cast<int>(half_extent[d] / mm + 3);
  image.index_to_mm.topLeftCorner<3, 3>() *= mm;
  for (int d = 0; d < 3; ++d)
    image.index_to_mm(d, 3) = -mm * (image.size[static_cast<std::size_t>(d)] / 2 - 0.37);
  image.labels.resize(image.voxel_count());
  image.visit(
      [&](int i, int j, int k, std::size_t at) { image.labels[at] = label_at(image.to_mm(i, j, k)); });
  return image;
}

/// A spheroid about z through `radius` and `height`.
struct Spheroid {
  double radius, height;
  bool holds(const Eigen::Vector3d& p) const {
    return p.head<2>().squaredNorm() / (radius * radius) + p.z() * p.z() / (height * height) < 1;
  }
  double disc_mm2(double z) const {
    return std::numbers::pi * radius * radius * (1 - z * z / (height * height));
  }
  /// Of the surface below z: the integral of 2 pi radius sqrt(1 - k^2 z^2).
  double area_mm2(double z) const {
    const double k = std::sqrt(1 - radius * radius / (height * height)) / height;
    const auto part = [&](double t) { return t * std::sqrt(1 - k * k * t * t) + std::asin(k * t) / k; };
    return std::numbers::pi * radius * (part(z) - part(-height));
  }
};

constexpr Spheroid kInner{16, 30}, kOuter{25, 38};

/// A ventricle that is cut off at kTop: wall 1, pool 3.
Label ventricle(const Eigen::Vector3d& p) {
  if (p.z() > kTop) return 0;
  return kInner.holds(p) ? 3 : kOuter.holds(p) ? 1 : 0;
}

LabelVolume single_ventricle(double mm = 1.5) {
  return sample({26, 26, 39}, mm, ventricle);
}

Result<HeartSurfaces> find(const TetMesh& mesh, const LabelVolume& image, const AnatomyParams& params,
                           int threads = 1) {
  RunContext ctx;
  ctx.threads = threads;
  return find_heart_surfaces(mesh, image, params, ctx);
}

TEST(FindHeartSurfaces, HaveTheAreasOfATruncatedEllipsoid) {
  const LabelVolume image = single_ventricle();
  const TetMesh mesh = mesh_image(image, {1}, 5);
  for (const std::vector<Label>& pool : {std::vector<Label>{3}, std::vector<Label>{}}) {
    const HeartSurfaces found = find(mesh, image, {{1}, pool, {}}).value();
    EXPECT_FALSE(found.right);
    const auto area = [&](HeartSurface surface) { return test::area_of(mesh, found, surface); };
    EXPECT_EQ(area(HeartSurface::kNone), 0);
    EXPECT_EQ(area(HeartSurface::kRvEndocardium) + area(HeartSurface::kRvSeptum), 0);
    EXPECT_NEAR(area(HeartSurface::kEpicardium) / kOuter.area_mm2(kTop), 1, 0.03);
    EXPECT_NEAR(area(HeartSurface::kLvEndocardium) / kInner.area_mm2(kTop), 1, 0.03);
    EXPECT_NEAR(area(HeartSurface::kBase) / (kOuter.disc_mm2(kTop) - kInner.disc_mm2(kTop)), 1, 0.1);
    for (const HeartSurface surface :
         {HeartSurface::kEpicardium, HeartSurface::kLvEndocardium, HeartSurface::kBase})
      EXPECT_EQ(test::count_parts(mesh, found, surface), 1) << name_of(surface);
    EXPECT_LT((mesh.points[found.apex] - Eigen::Vector3d(0, 0, -kOuter.height)).norm(), 3);
  }
}

// A knob beside the tip is the lowest place of all.
TEST(FindHeartSurfaces, PutTheApexInTheMiddleOfARoughTip) {
  const Eigen::Vector3d knob(9, 0, -36);
  const LabelVolume image = sample({26, 26, 42}, 1.5, [&](const Eigen::Vector3d& p) -> Label {
    const Label label = ventricle(p);
    return label == 0 && (p - knob).norm() < 4 ? 1 : label;
  });
  const TetMesh mesh = mesh_image(image, {1}, 4);
  double lowest = 0, lowest_x = 0;
  for (const Eigen::Vector3d& p : mesh.points)
    if (p.z() < lowest) lowest = p.z(), lowest_x = p.x();
  EXPECT_GT(lowest_x, 6);
  const HeartSurfaces found = find(mesh, image, {{1}, {3}, {}}).value();
  EXPECT_LT(mesh.points[found.apex].head<2>().norm(), 6) << mesh.points[found.apex].transpose();
}

// The larger cavity has the thinner wall: it is the right one, whichever comes first.
TEST(FindHeartSurfaces, TakeTheThickerOfTwoVentriclesForTheLeftOne) {
  const Eigen::Vector3d shift(34, 0, 0);
  const LabelVolume image = sample({62, 26, 39}, 1.5, [&](const Eigen::Vector3d& q) -> Label {
    const Eigen::Vector3d p = q + shift / 2;
    if (p.z() > kTop || kInner.holds(p)) return 0;
    if (kOuter.holds(p)) return 1;
    return Spheroid{24, 33}.holds(p - shift) ? 0 : Spheroid{28, 37}.holds(p - shift) ? 2 : 0;
  });
  const TetMesh mesh = mesh_image(image, {1, 2}, 5);
  const HeartSurfaces found = find(mesh, image, {{1, 2}, {}, {}}).value();
  EXPECT_TRUE(found.right);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const double x = test::centre_of(mesh, f).x() + shift.x() / 2;
    if (found.faces[f] == HeartSurface::kLvEndocardium) {
      EXPECT_LT(x, 18);
    }
    if (found.faces[f] == HeartSurface::kRvSeptum) {
      EXPECT_LT(x, 28);
    }
    if (found.faces[f] == HeartSurface::kRvEndocardium) {
      EXPECT_GT(x, 8);
    }
  }
  EXPECT_GT(test::area_of(mesh, found, HeartSurface::kRvSeptum), 500);
}

void expect_refused(const TetMesh& mesh, const LabelVolume& image, const AnatomyParams& params,
                    const std::string& message) {
  const Result<HeartSurfaces> found = find(mesh, image, params);
  ASSERT_FALSE(found.ok()) << message;
  EXPECT_EQ(found.error().code, ErrorCode::kUsage);
  EXPECT_EQ(found.error().stage, "anatomy");
  EXPECT_EQ(found.error().message.substr(0, message.size()), message);
}

TEST(FindHeartSurfaces, RefuseLabelsThatAreNotThere) {
  const LabelVolume image = single_ventricle(3);
  const TetMesh mesh = test::voxel_mesh(image, {1});
  expect_refused(mesh, image, {{}, {3}, {}}, "physics.anatomy.wall: found no labels, expected");
  expect_refused(mesh, image, {{1, 5}, {3}, {}},
                 "physics.anatomy.wall: found 5, expected labels of the mesh: 1");
  expect_refused(mesh, image, {{1}, {4}, {}},
                 "physics.anatomy.lv_pool: found 4, expected labels of the image: 1, 3");
  expect_refused(mesh, image, {{1}, {3}, {7}},
                 "physics.anatomy.rv_pool: found 7, expected labels of the image: 1, 3");
  expect_refused(mesh, image, {{1}, {}, {3}}, "physics.anatomy.lv_pool: found no labels beside rv_pool 3");
  expect_refused(mesh, image, {{1}, {3}, {3}}, "physics.anatomy.rv_pool: found 3 for the second time");
  LabelVolume other = image;
  other.index_to_mm(0, 3) += 500;
  expect_refused(mesh, other, {{1}, {3}, {}}, "physics.anatomy.wall: found 1, in whose tetrahedra no label");
}

TEST(FindHeartSurfaces, RefuseWallsWithoutACavityOrABase) {
  const LabelVolume image = single_ventricle(3);
  expect_refused(test::voxel_mesh(image, {1, 3}), image, {{1, 3}, {}, {}},
                 "physics.anatomy.wall: found 0 cavities in the wall of 1, 3");
  LabelVolume away = image;
  away.labels[0] = 9;
  expect_refused(test::voxel_mesh(image, {1}), away, {{1}, {9}, {}},
                 "physics.anatomy.lv_pool: found 9, which no face of the wall looks at");
  const LabelVolume closed = sample({26, 26, 39}, 3, [](const Eigen::Vector3d& p) -> Label {
    return kInner.holds(p) ? 3 : kOuter.holds(p) ? 1 : 0;
  });
  for (const std::vector<Label>& pool : {std::vector<Label>{3}, std::vector<Label>{}})
    expect_refused(test::voxel_mesh(closed, {1}), closed, {{1}, pool, {}},
                   "physics.anatomy.wall: found no base");
}

std::string digest(const HeartSurfaces& found) {
  Sha256 sha;
  for (const HeartSurface face : found.faces) sha.update(name_of(face));
  sha.update_values(&found.apex, 1);
  return sha.hex();
}

TEST(FindHeartSurfaces, AreTheSameOnEveryPlatformAndForAnyNumberOfThreads) {
  const LabelVolume image = single_ventricle(3);
  const TetMesh mesh = test::voxel_mesh(image, {1});
  for (const int threads : {1, 3})
    EXPECT_EQ(digest(find(mesh, image, {{1}, {}, {}}, threads).value()),
              "65c2887a1e8fafa207604ace53eef4f6eb5321e2ec14550f86bc2217f6cba3aa");
}

}  // namespace
}  // namespace voxtet
