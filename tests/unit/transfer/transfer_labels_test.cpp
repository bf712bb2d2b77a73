#include "transfer/transfer_labels.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "geometry/elements/rotation.h"
#include "geometry/elements/tet_measures.h"
#include "support/labelled_mesh.h"

namespace voxtet {
namespace {

Result<LabelTransfer> transfer(const TetMesh& mesh, const LabelVolume& volume, std::vector<Label> labels,
                               int samples_min = 4, int samples_max = 64) {
  RunContext ctx;
  return transfer_labels(mesh, volume, {std::move(labels), samples_min, samples_max}, ctx);
}

/// n^3 cells of Kuhn's six tets over the box [low, high]; one label.
TetMesh box_mesh(std::uint32_t n, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  TetMesh mesh = test::kuhn_cube(n);
  std::size_t p = 0;
  for (std::uint32_t k = 0; k <= n; ++k)
    for (std::uint32_t j = 0; j <= n; ++j)
      for (std::uint32_t i = 0; i <= n; ++i)
        mesh.points[p++] = low + (high - low).cwiseProduct(Eigen::Vector3d(i, j, k)) / n;
  mesh.labels.assign(mesh.tets.size(), 1);
  return mesh;
}

/// 10 voxels a side of 1 mm, the first centre at (0.5, 0.5, 0.5): label 5 where `inside`, else 1.
LabelVolume cube_volume(const std::function<bool(const Eigen::Vector3d&)>& inside) {
  LabelVolume volume;
  volume.size = {10, 10, 10};
  volume.index_to_mm.topRightCorner<3, 1>().setConstant(0.5);
  for (int k = 0; k < 10; ++k)
    for (int j = 0; j < 10; ++j)
      for (int i = 0; i < 10; ++i)
        volume.labels.push_back(inside(volume.to_mm(Eigen::Vector3d(i, j, k))) ? 5 : 1);
  return volume;
}

double volume_of(const TetMesh& mesh, std::size_t t) {
  const auto [a, b, c, d] = mesh.tets[t];
  return std::abs(tet_volume_mm3({mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]}));
}

TEST(TransferLabels, GivesNothingWhereNothingIsAsked) {
  const auto found = transfer(test::kuhn_cube(2), cube_volume([](auto&) { return true; }), {});
  ASSERT_TRUE(found.ok());
  EXPECT_TRUE(found->labels.empty());
  EXPECT_TRUE(found->fields.empty());
}

TEST(TransferLabels, IsExactWhereVoxelFacesAreTetFaces) {
  // Cells of 5 mm: the plane z = 5 between the labels is a plane of faces.
  const TetMesh mesh = box_mesh(2, {0, 0, 0}, {10, 10, 10});
  const auto found = transfer(mesh, cube_volume([](const auto& p) { return p.z() > 5; }), {5});
  ASSERT_TRUE(found.ok()) << found.error().message;
  const TransferredLabel& label = found->labels.front();
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    double z = 0;
    for (const std::uint32_t v : mesh.tets[t]) z += mesh.points[v].z() / 4;
    const bool above = z > 5;
    EXPECT_EQ(found->fraction(0)[t], above ? 1 : 0);
    EXPECT_EQ(found->centroid()[t], above ? 5 : 1);
    EXPECT_EQ(found->majority()[t], above ? 5 : 1);
  }
  for (const double mm3 : {label.voxel_mm3, label.fraction_mm3, label.centroid_mm3, label.majority_mm3})
    EXPECT_NEAR(mm3, 500, 1e-9);
  EXPECT_EQ(label.centroid_dice, 1);
  EXPECT_EQ(label.majority_dice, 1);
}

TEST(TransferLabels, GivesTheVolumeFractionOfATetCutByAPlane) {
  // Corner tets of 10 mm: the part beyond x = 5 is (1/2)^3 of one with three edges at its far corner.
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}};
  mesh.tets = {{0, 1, 2, 3}};
  mesh.labels = {1};
  const LabelVolume volume = cube_volume([](const auto& p) { return p.x() > 5; });
  const auto found = transfer(mesh, volume, {1, 5}, 4, 4096);
  ASSERT_TRUE(found.ok());
  EXPECT_NEAR(found->fraction(1)[0], 0.125, 0.01);
  EXPECT_EQ(found->majority()[0], 1);
}

TEST(TransferLabels, CutsATetIntoPartsOfEqualVolumeAsSymmetricAsKuhns) {
  // A plane through the barycentre parallel to a face leaves 27/64 of the volume on the side of the corner.
  for (std::uint32_t corner = 0; corner < 4; ++corner) {
    TetMesh mesh;
    mesh.points = {{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {8, 8, 8}};
    std::swap(mesh.points[corner], mesh.points[3]);
    mesh.tets = {{0, 1, 2, 3}};
    mesh.labels = {1};
    const LabelVolume volume = cube_volume([](const auto& p) { return p.z() > 2; });
    const auto found = transfer(mesh, volume, {1, 5}, 64, 64);
    ASSERT_TRUE(found.ok());
    EXPECT_NEAR(found->fraction(1)[0], 27.0 / 64, 0.05) << corner;
  }
}

TEST(TransferLabels, FractionsOfAllLabelsAndBackgroundSumToOne) {
  LabelVolume volume = cube_volume([](const auto& p) { return p.norm() < 6; });
  for (std::size_t i = 0; i < volume.labels.size(); i += 3) volume.labels[i] = 7;
  const TetMesh mesh = box_mesh(4, {1, 1, 1}, {9, 9, 9});
  const auto found = transfer(mesh, volume, {7, 1, 5, 5});
  ASSERT_TRUE(found.ok());
  ASSERT_EQ(found->labels.size(), 3U);
  EXPECT_EQ(found->labels[0].label, 1);
  EXPECT_EQ(found->labels[1].label, 5);
  EXPECT_EQ(found->labels[2].label, 7);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    float sum = 0;
    for (std::size_t i = 0; i < found->labels.size(); ++i) sum += found->fraction(i)[t];
    EXPECT_NEAR(sum, 1, 1e-6);
  }
}

TEST(TransferLabels, FindsBackgroundOutsideOfTheVolume) {
  const TetMesh mesh = box_mesh(2, {20, 20, 20}, {30, 30, 30});
  const auto found = transfer(mesh, cube_volume([](const auto& p) { return p.x() > 5; }), {5});
  ASSERT_TRUE(found.ok());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    EXPECT_EQ(found->centroid()[t], kBackground);
    EXPECT_EQ(found->majority()[t], kBackground);
    EXPECT_EQ(found->fraction(0)[t], 0);
  }
  EXPECT_EQ(found->labels[0].majority_dice, 0);
}

TEST(TransferLabels, TakesMoreSamplesOfLargerTets) {
  // n^3 samples make every fraction a multiple of 1/n^3; 8 samples a voxel are asked for.
  const LabelVolume volume = cube_volume([](const auto& p) { return p.x() + p.y() > 9; });
  for (const auto& [cells, parts] : {std::pair{10U, 8.0}, std::pair{5U, 27.0}, std::pair{2U, 64.0}}) {
    const TetMesh mesh = box_mesh(cells, {0, 0, 0}, {10, 10, 10});
    const auto found = transfer(mesh, volume, {5});
    ASSERT_TRUE(found.ok());
    for (const float f : found->fraction(0)) EXPECT_NEAR(f * parts, std::round(f * parts), 1e-4);
  }
}

TEST(TransferLabels, ConvergesToTheVolumeOfTheVoxels) {
  const LabelVolume volume =
      cube_volume([](const auto& p) { return (p - Eigen::Vector3d(5, 5, 5)).norm() < 4; });
  double last = 1;
  for (const std::uint32_t cells : {3U, 6U, 12U, 24U}) {
    const TetMesh mesh = box_mesh(cells, {0, 0, 0}, {10, 10, 10});
    const auto found = transfer(mesh, volume, {5}, 64, 64);
    ASSERT_TRUE(found.ok());
    last = std::abs(found->labels[0].fraction_mm3 / found->labels[0].voxel_mm3 - 1);
    EXPECT_LT(last, 0.06) << cells;
  }
  EXPECT_LT(last, 0.005);
}

TEST(TransferLabels, FollowsAnObliqueMirroredAnisotropicAffine) {
  // The same voxels and the same mesh, both moved: the same answers.
  const LabelVolume volume = cube_volume([](const auto& p) { return p.norm() < 7; });
  const TetMesh mesh = box_mesh(5, {0.0313, 0.0217, 0.0131}, {9.9271, 9.9173, 9.9119});
  Eigen::Matrix4d motion = Eigen::Matrix4d::Identity();
  motion.topLeftCorner<3, 3>() =
      rotation_from_degrees({25, -40, 110}) * Eigen::Vector3d(-1.5, 0.7, 3).asDiagonal();
  motion.topRightCorner<3, 1>() << 120, -80, 400;
  LabelVolume moved = volume;
  moved.index_to_mm = motion * volume.index_to_mm;
  TetMesh moved_mesh = mesh;
  for (Eigen::Vector3d& p : moved_mesh.points)
    p = motion.topLeftCorner<3, 3>() * p + motion.topRightCorner<3, 1>();
  const auto straight = transfer(mesh, volume, {5}), oblique = transfer(moved_mesh, moved, {5});
  ASSERT_TRUE(straight.ok() && oblique.ok());
  EXPECT_EQ(straight->centroid(), oblique->centroid());
  EXPECT_EQ(straight->majority(), oblique->majority());
  EXPECT_EQ(straight->fraction(0), oblique->fraction(0));
  EXPECT_NEAR(oblique->labels[0].fraction_mm3 / straight->labels[0].fraction_mm3, 1.5 * 0.7 * 3, 1e-9);
  EXPECT_EQ(straight->labels[0].majority_dice, oblique->labels[0].majority_dice);
}

TEST(TransferLabels, LetsTheCentroidDecideBetweenEqualLabels) {
  TetMesh mesh;
  mesh.points = {{4, 1, 1}, {6, 1, 1}, {4.9, 3, 1}, {4.9, 1, 3}};
  mesh.tets = {{0, 1, 2, 3}};
  mesh.labels = {1};
  // Eight samples; shift the plane until they are divided evenly.
  for (const double shift : {-0.2, -0.1, 0.0, 0.1, 0.2}) {
    LabelVolume volume = cube_volume([](const auto& p) { return p.x() > 5; });
    volume.index_to_mm(0, 3) += shift;
    const auto found = transfer(mesh, volume, {5}, 8, 8);
    ASSERT_TRUE(found.ok());
    const float fraction = found->fraction(0)[0];
    EXPECT_EQ(found->majority()[0], fraction > 0.5F ? 5 : fraction < 0.5F ? 1 : found->centroid()[0]);
  }
}

TEST(TransferLabels, TakesDegenerateTetsByWhereTheyAre) {
  TetMesh mesh;
  mesh.points = {{2, 2, 2}, {3, 2, 2}, {4, 2, 2}, {8, 8, 8}};
  mesh.tets = {{0, 0, 0, 0}, {0, 1, 2, 0}, {3, 3, 3, 3}, {0, 2, 1, 3}};
  mesh.labels = {1, 1, 1, 1};
  const auto found = transfer(mesh, cube_volume([](const auto& p) { return p.x() > 7; }), {5});
  ASSERT_TRUE(found.ok());
  EXPECT_EQ(found->majority()[0], 1);
  EXPECT_EQ(found->majority()[1], 1);
  EXPECT_EQ(found->majority()[2], 5);
  EXPECT_NEAR(found->labels[0].fraction_mm3, volume_of(mesh, 3) * found->fraction(0)[3], 1e-12);
}

TEST(TransferLabels, RefusesLabelsThatTheVolumeDoesNotHold) {
  const TetMesh mesh = box_mesh(1, {0, 0, 0}, {10, 10, 10});
  const LabelVolume volume = cube_volume([](const auto& p) { return p.x() > 7; });
  for (const Label label : {Label{9}, kBackground}) {
    const auto found = transfer(mesh, volume, {5, label});
    ASSERT_FALSE(found.ok());
    EXPECT_EQ(found.error().code, ErrorCode::kUsage);
    EXPECT_EQ(found.error().stage, "transfer");
    EXPECT_NE(found.error().message.find("holds 1, 5"), std::string::npos) << found.error().message;
  }
}

TEST(TransferLabels, RefusesBoundsOnSamplesOutOfOrderAndBrokenMeshes) {
  const LabelVolume volume = cube_volume([](const auto& p) { return p.x() > 7; });
  TetMesh mesh = box_mesh(1, {0, 0, 0}, {10, 10, 10});
  EXPECT_EQ(transfer(mesh, volume, {5}, 0, 64).error().code, ErrorCode::kUsage);
  EXPECT_EQ(transfer(mesh, volume, {5}, 8, 4).error().code, ErrorCode::kUsage);
  TetMesh unlabelled = mesh;
  unlabelled.labels.clear();
  EXPECT_EQ(transfer(unlabelled, volume, {5}).error().code, ErrorCode::kInternal);
  mesh.tets[2][1] = 1000;
  EXPECT_EQ(transfer(mesh, volume, {5}).error().where.elements, std::vector<std::uint32_t>{2});
}

TEST(TransferLabels, CanBeCancelled) {
  RunContext ctx;
  ctx.on_cancelled = [] { return true; };
  const auto found = transfer_labels(box_mesh(1, {0, 0, 0}, {10, 10, 10}),
                                     cube_volume([](const auto& p) { return p.x() > 7; }), {{5}, 4, 64}, ctx);
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().code, ErrorCode::kCancelled);
}

TEST(TransferLabels, NamesItsFields) {
  const auto found = transfer(box_mesh(2, {0, 0, 0}, {10, 10, 10}),
                              cube_volume([](const auto& p) { return p.x() > 5; }), {5, 1});
  ASSERT_TRUE(found.ok());
  const std::vector<Field>& data = found->fields;
  ASSERT_EQ(data.size(), 4U);
  EXPECT_EQ(data[0].name, "centroid_label");
  EXPECT_EQ(data[1].name, "majority_label");
  EXPECT_EQ(data[2].name, "fraction_1");
  EXPECT_EQ(data[3].name, "fraction_5");
  for (const Field& one : data) EXPECT_EQ(one.values.size(), 48U);
  EXPECT_EQ(data[1].values[0], static_cast<float>(found->majority()[0]));
}

}  // namespace
}  // namespace voxtet
