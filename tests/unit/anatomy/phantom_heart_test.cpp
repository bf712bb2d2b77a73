// The named surfaces of the phantom's two ventricles, whose geometry is known: core/phantom/biventricle.cpp.
#include <gtest/gtest.h>

#include "anatomy/find_heart_surfaces.h"
#include "meshed_image.h"
#include "phantom/body.h"

namespace voxtet {
namespace {

constexpr double kEdge = 5;  // mm
const Eigen::Vector3d kCentre(12, 2, -14), kBaseNormal(0.06, 0.08, std::sqrt(1 - 0.06 * 0.06 - 0.08 * 0.08));
constexpr double kBaseHeight = 22;
const Ellipsoid kLvEpicardium{{0, 0, 0}, {33.5, 33.5, 52}};
const Ellipsoid kRvCavity = Ellipsoid{{16, 1, 6}, {41, 35.5, 47}}.shrunk(3.8);

double depth_mm(const Eigen::Vector3d& mm) {
  return kBaseHeight - kBaseNormal.dot(mm + kCentre);
}

/// What a face is by the body itself; kNone near edges, where names meet.
HeartSurface truth(const Eigen::Vector3d& centre, const Eigen::Vector3d& outwards,
                   const std::function<Label(const Eigen::Vector3d&)>& label_at) {
  const Eigen::Vector3d p = centre + kCentre;
  const double depth = depth_mm(centre), upright = kBaseNormal.dot(outwards);
  if (depth < 1 && upright > 0.9) return HeartSurface::kBase;
  if (depth < 6) return HeartSurface::kNone;
  switch (label_at(centre + 2 * outwards)) {
    case 0: return HeartSurface::kEpicardium;
    case 3: return HeartSurface::kLvEndocardium;
    case 4: break;
    default: return HeartSurface::kNone;
  }
  const double to_septum = kLvEpicardium.distance(p);
  if (to_septum > 8) return HeartSurface::kRvEndocardium;
  return to_septum < 1.5 && kRvCavity.distance(p) < -8 ? HeartSurface::kRvSeptum : HeartSurface::kNone;
}

PhantomParams rough_heart() {
  PhantomParams params;
  params.roughness_mm = 1.2;
  params.scar = true;
  return params;
}

void expect_named(const PhantomParams& params, const TetMesh& mesh, const HeartSurfaces& found,
                  const std::vector<Label>& wall) {
  PhantomParams with_pools = params;
  with_pools.blood_pools = true;
  const auto label_at = phantom_body(with_pools);
  const auto in_wall = [&](Label label) { return std::find(wall.begin(), wall.end(), label) != wall.end(); };
  ASSERT_EQ(found.faces.size(), mesh.faces.size());
  ASSERT_EQ(found.wall.size(), mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) EXPECT_EQ(found.wall[t], in_wall(mesh.labels[t]));
  std::array<double, 6> right{}, all{};
  double unknown = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& [behind, front] = mesh.face_sides[f];
    if (in_wall(behind) == in_wall(front)) {
      EXPECT_EQ(found.faces[f], HeartSurface::kNone);
      continue;
    }
    EXPECT_NE(found.faces[f], HeartSurface::kNone);
    const Eigen::Vector3d area = in_wall(behind) ? test::area_vector(mesh, f) : -test::area_vector(mesh, f);
    const HeartSurface expected = truth(test::centre_of(mesh, f), area.normalized(), label_at);
    (expected == HeartSurface::kNone ? unknown : all[static_cast<std::size_t>(expected)]) += area.norm();
    if (expected == found.faces[f]) right[static_cast<std::size_t>(expected)] += area.norm();
  }
  double known = 0;
  for (std::size_t s = 1; s < 6; ++s) {
    EXPECT_GT(right[s], 0.99 * all[s]) << name_of(static_cast<HeartSurface>(s));
    EXPECT_GT(all[s], 700) << name_of(static_cast<HeartSurface>(s));
    EXPECT_EQ(test::count_parts(mesh, found, static_cast<HeartSurface>(s)), 1)
        << name_of(static_cast<HeartSurface>(s));
    known += all[s];
  }
  EXPECT_GT(known, 0.7 * (known + unknown));
  EXPECT_TRUE(found.right);
  // The point of the outer ellipsoid whose normal is that of the base, downwards.
  const Eigen::Vector3d squares = kLvEpicardium.semi_axes.cwiseAbs2();
  const Eigen::Vector3d tip =
      -squares.cwiseProduct(kBaseNormal) / std::sqrt(squares.dot(kBaseNormal.cwiseAbs2())) - kCentre;
  EXPECT_LT((mesh.points[found.apex] - tip).norm(), kEdge) << mesh.points[found.apex].transpose();
}

HeartSurfaces surfaces_of_heart(const TetMesh& mesh, const LabelVolume& image, const AnatomyParams& params) {
  RunContext ctx;
  const Result<HeartSurfaces> found = find_heart_surfaces(mesh, image, params, ctx);
  EXPECT_TRUE(found.ok()) << (found.ok() ? "" : found.error().message);
  return found.ok() ? *found : HeartSurfaces{};
}

TEST(PhantomSurfaces, AreFoundByPools) {
  const PhantomParams params = rough_heart();
  const LabelVolume image = make_phantom(params).value();
  const std::vector<Label> wall{1, 2, 5, 6};
  const TetMesh mesh = test::mesh_image(image, wall, kEdge);
  expect_named(params, mesh, surfaces_of_heart(mesh, image, {wall, {3}, {4}}), wall);
}

TEST(PhantomSurfaces, AreFoundWithoutPools) {
  PhantomParams params = rough_heart();
  params.blood_pools = false;
  const LabelVolume image = make_phantom(params).value();
  const std::vector<Label> wall{1, 2, 5, 6};
  const TetMesh mesh = test::mesh_image(image, wall, kEdge);
  expect_named(params, mesh, surfaces_of_heart(mesh, image, {wall, {}, {}}), wall);
}

TEST(PhantomSurfaces, AreFoundBesideMeshedPools) {
  PhantomParams params;
  const LabelVolume image = make_phantom(params).value();
  const TetMesh mesh = test::mesh_image(image, {}, kEdge + 1);
  expect_named(params, mesh, surfaces_of_heart(mesh, image, {{1, 2}, {3}, {4}}), {1, 2});
  expect_named(params, mesh, surfaces_of_heart(mesh, image, {{1, 2}, {}, {}}), {1, 2});
}

TEST(PhantomSurfaces, AreFoundInTurnedAndMirroredImages) {
  PhantomParams params;
  params.rotation_deg = {20, -35, 50};
  params.mirrored = true;
  params.blood_pools = false;
  const LabelVolume image = make_phantom(params).value();
  const TetMesh mesh = test::mesh_image(image, {}, kEdge);
  expect_named(params, mesh, surfaces_of_heart(mesh, image, {{1, 2}, {}, {}}), {1, 2});
}

TEST(PhantomSurfaces, AreFoundWhereTheMeshMergesScarAndWall) {
  const PhantomParams params = rough_heart();
  const LabelVolume image = make_phantom(params).value();
  const TetMesh mesh = test::mesh_image(image, {1, 2, 5, 6}, kEdge, {{1, 5, 6}});
  expect_named(params, mesh, surfaces_of_heart(mesh, image, {{1, 2}, {3}, {4}}), {1, 2});
}

// Background in the pools, as papillary muscles leave it, and a hole in the right free wall.
TEST(PhantomSurfaces, AreFoundInSpiteOfFaultyLabels) {
  PhantomParams params;
  LabelVolume image = make_phantom(params).value();
  const Eigen::Vector3d hole(46, -4, 2);  // on the free wall, far from base and septum
  image.visit([&](int i, int j, int k, std::size_t at) {
    const bool faulty = (i / 4 + j / 4 + k / 4) % 5 == 0;
    if (faulty && depth_mm(image.to_mm(i, j, k)) > 8 && image.labels[at] >= 3) image.labels[at] = 0;
    const Eigen::Vector3d way = image.to_mm(i, j, k) - hole;
    if (way.tail<2>().norm() < 2.5 && std::abs(way.x()) < 12 && image.labels[at] == 2) image.labels[at] = 0;
  });
  const TetMesh mesh = test::mesh_image(image, {1, 2}, kEdge);
  const HeartSurfaces found = surfaces_of_heart(mesh, image, {{1, 2}, {3}, {4}});
  for (const HeartSurface surface : {HeartSurface::kEpicardium, HeartSurface::kLvEndocardium,
                                     HeartSurface::kRvEndocardium, HeartSurface::kRvSeptum})
    EXPECT_EQ(test::count_parts(mesh, found, surface), 1) << name_of(surface);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const double depth = depth_mm(test::centre_of(mesh, f));
    if (found.faces[f] == HeartSurface::kBase) {
      EXPECT_LT(depth, 6);  // the faults begin at 8 mm; facets of the base have edges of 5 mm
    }
  }
}

}  // namespace
}  // namespace voxtet
