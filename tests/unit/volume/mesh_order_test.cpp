#include "volume/mesh_order.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "geometry/topology/label_components.h"
#include "support/random_labels.h"
#include "volume/prepare_volume.h"

namespace voxtet {
namespace {

using test::axis_order;
using test::kAxisOrders;

TEST(MeshOrder, KeepsEveryVoxelAtItsPlace) {
  const LabelVolume volume = test::random_labels(5).volume;
  for (int n = 0; n < kAxisOrders; ++n) {
    const LabelVolume stored = reordered(volume, axis_order(n));
    ASSERT_EQ(stored.voxel_count(), volume.voxel_count());
    const Eigen::Matrix4d to_old = volume.index_to_mm.inverse() * stored.index_to_mm;
    for (int k = 0; k < stored.size[2]; ++k)
      for (int j = 0; j < stored.size[1]; ++j)
        for (int i = 0; i < stored.size[0]; ++i) {
          const Eigen::Vector4d old = (to_old * Eigen::Vector4d(i, j, k, 1)).array().round();
          ASSERT_EQ(stored.at(i, j, k),
                    volume.at_or_background(static_cast<int>(old[0]), static_cast<int>(old[1]),
                                            static_cast<int>(old[2])))
              << "order " << n;
        }
  }
}

void expect_the_same(LabelVolume volume, const Eigen::Vector3d& spacing_mm, int step) {
  volume.index_to_mm = spacing_mm.homogeneous().asDiagonal();
  RunContext ctx;
  const auto prepared = [&](const LabelVolume& stored) {
    return prepare_volume(std::make_shared<const LabelVolume>(stored), {}, {}, {}, ctx).value();
  };
  const PreparedVolume expected = prepared(volume);
  for (int n = 0; n < kAxisOrders; n += step) {
    const PreparedVolume found = prepared(reordered(volume, axis_order(n)));
    ASSERT_EQ(found.prepared->labels, expected.prepared->labels) << "order " << n;
    ASSERT_EQ(found.anatomy->labels, expected.anatomy->labels) << "order " << n;
    ASSERT_EQ(found.selected->labels, expected.selected->labels) << "order " << n;
    ASSERT_EQ(found.prepared->index_to_mm, expected.prepared->index_to_mm) << "order " << n;
  }
}

TEST(MeshOrder, PreparesTheSameVolumeHoweverItIsStored) {
  for (const std::uint64_t seed : {1, 2, 3, 4})
    expect_the_same(test::random_labels(seed).volume, {0.5, 0.75, 1}, 1);
}

TEST(MeshOrder, PreparesTheSameThickSlicesHoweverTheyAreStored) {
  expect_the_same(test::random_labels(5).volume, {0.5, 0.75, 2}, 7);
}

/// A sheet of one voxel along the diagonals of its planes.
LabelVolume sheet(int rise_y, int rise_z) {
  LabelVolume volume;
  volume.size = {16, 16, 16};
  volume.labels.assign(volume.voxel_count(), kBackground);
  for (int k = 0; k < 16; ++k)
    for (int j = 0; j < 16; ++j)
      for (int i = 0; i < 16; ++i)
        if (i + rise_y * (j - 8) + rise_z * (k - 8) == 8) volume.labels[volume.offset(i, j, k)] = 1;
  return volume;
}

TEST(MeshOrder, HoldsASlantedSheetTogether) {
  for (const int rise_y : {-1, 0, 1})
    for (const int rise_z : {-1, 0, 1}) {
      const LabelVolume volume = sheet(rise_y, rise_z);
      const LabelVolume meshed = reordered(volume, mesh_order(volume));
      std::vector<std::uint32_t> sizes;
      const std::vector<std::uint32_t> component =
          label_components(meshed.size, meshed.labels, sizes, Connectivity::kKuhn);
      // The sheet, and what it parts; no diagonal keeps one tight that slants along both.
      EXPECT_EQ(sizes.size(), rise_y != 0 && rise_z != 0 ? 2U : 3U) << rise_y << ", " << rise_z;
    }
}

TEST(MeshOrder, CopiesNothingThatIsStoredThatWay) {
  LabelVolume volume = sheet(0, 0);
  EXPECT_TRUE(mesh_order(volume).is_identity());
  const auto source = std::make_shared<const LabelVolume>(volume);
  RunContext ctx;
  VolumeParams params;
  params.flat_border = false;  // the image cuts the sheet off
  const PreparedVolume prepared = prepare_volume(source, {}, {}, params, ctx).value();
  EXPECT_EQ(prepared.prepared, source);
  EXPECT_EQ(prepared.selected, source);
  EXPECT_EQ(prepared.anatomy, source);
}

}  // namespace
}  // namespace voxtet
