#include "anatomy/labels_across.h"

#include <gtest/gtest.h>

#include "anatomy/facet_sets.h"
#include "meshed_image.h"
#include "support/label_bodies.h"

namespace voxtet {
namespace {

/// Beside label 1, in this order along x: 2, 1, 3, and background everywhere else.
LabelVolume row() {
  return test::make_volume(12, 8, 8, [](int i, int j, int k) {
    if (j < 2 || j > 5 || k < 2 || k > 5) return 0;
    return i < 2 ? 0 : i < 4 ? 2 : i < 8 ? 1 : i < 10 ? 3 : 0;
  });
}

TEST(LabelsAcross, AreThoseOfTheVoxelsBeyond) {
  const LabelVolume image = row();
  const TetMesh mesh = test::voxel_mesh(image, {1});
  const std::vector<Label> across = labels_across(mesh, image);
  ASSERT_EQ(across.size(), mesh.faces.size());
  std::array<int, 4> faces{};
  for (std::size_t f = 0; f < across.size(); ++f) {
    const Eigen::Vector3d beyond = test::centre_of(mesh, f) + 0.5 * test::area_vector(mesh, f).normalized();
    EXPECT_EQ(across[f], image.at(static_cast<int>(beyond.x() + 0.5), static_cast<int>(beyond.y() + 0.5),
                                  static_cast<int>(beyond.z() + 0.5)));
    ++faces[across[f]];
  }
  EXPECT_EQ(faces, (std::array<int, 4>{128, 0, 32, 32}));
}

TEST(LabelsAcross, AreThoseOfTheMeshWhereItGoesOn) {
  const LabelVolume image = row();
  const TetMesh mesh = test::voxel_mesh(image, {1, 2});
  const std::vector<Label> across = labels_across(mesh, image);
  std::array<int, 4> faces{};
  for (std::size_t f = 0; f < across.size(); ++f) {
    if (mesh.face_sides[f][1] != 0) {
      EXPECT_EQ(across[f], mesh.face_sides[f][1]);
    }
    ++faces[across[f]];
  }
  EXPECT_EQ(faces, (std::array<int, 4>{128 + 64 + 32, 32, 0, 32}));
}

TEST(LabelsAcross, TakeLabelsThatTheMeshMergesForItsOwn) {
  LabelVolume image = row();
  TetMesh mesh = test::voxel_mesh(image, {1, 2});
  for (Label& label : mesh.labels) label = 1;
  add_label_faces(mesh);
  // Its sides lie so deep in the voxels of label 2 that these are what they look at first.
  for (Eigen::Vector3d& p : mesh.points) p.y() = 3.5 + 0.75 * (p.y() - 3.5);
  for (const Label label : labels_across(mesh, image)) EXPECT_TRUE(label == 0 || label == 3) << label;
}

TEST(FacetSets, HoldEveryNamedFaceOnceAndTheEdgesOfTheBase) {
  const TetMesh mesh = test::voxel_mesh(row(), {1});
  HeartSurfaces surfaces;
  // The base at high x, the left endocardium at high z, the epicardium elsewhere.
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Eigen::Vector3d normal = test::area_vector(mesh, f).normalized();
    surfaces.faces.push_back(normal.x() > 0.5   ? HeartSurface::kBase
                             : normal.z() > 0.5 ? HeartSurface::kLvEndocardium
                                                : HeartSurface::kEpicardium);
  }
  const std::vector<NamedSet> sets = facet_sets(surfaces);
  ASSERT_EQ(sets.size(), 3U);
  EXPECT_EQ(sets[0].name, "epicardium");
  EXPECT_EQ(sets[1].name, "lv_endocardium");
  EXPECT_EQ(sets[2].name, "base");
  std::vector<int> held(mesh.faces.size(), 0);
  for (const NamedSet& set : sets)
    for (const std::uint32_t f : set.members) ++held[f];
  EXPECT_EQ(held, std::vector<int>(mesh.faces.size(), 1));

  const std::vector<NamedSet> rims = rim_sets(mesh, surfaces);
  ASSERT_EQ(rims.size(), 1U);
  EXPECT_EQ(rims[0].name, "lv_rim");
  EXPECT_EQ(rims[0].members.size(), 5U);
  for (const std::uint32_t point : rims[0].members) {
    EXPECT_EQ(mesh.points[point].x(), 7.5);
    EXPECT_EQ(mesh.points[point].z(), 5.5);
  }
}

}  // namespace
}  // namespace voxtet
