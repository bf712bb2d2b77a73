#include "surface/smooth/voxel_regions.h"

#include <gtest/gtest.h>

#include <map>

#include "support/label_bodies.h"
#include "support/random_labels.h"

namespace voxtet {
namespace {

/// Representative voxel of each region by flooding; -1 for the background around the volume.
std::vector<int> flood(const LabelVolume& volume) {
  std::vector<int> region(volume.voxel_count(), -2);
  const int nx = volume.size[0], ny = volume.size[1], nz = volume.size[2];
  const auto spread = [&](std::size_t from, int name) {
    std::vector<std::size_t> open{from};
    region[from] = name;
    while (!open.empty()) {
      const auto at = static_cast<int>(open.back());
      open.pop_back();
      const int x = at % nx, y = at / nx % ny, z = at / nx / ny;
      for (int k = z - 1; k <= z + 1; ++k)
        for (int j = y - 1; j <= y + 1; ++j)
          for (int i = x - 1; i <= x + 1; ++i) {
            if (!volume.contains(i, j, k)) continue;
            const std::size_t next = volume.offset(i, j, k);
            if (region[next] != -2 || volume.labels[next] != volume.labels[static_cast<std::size_t>(at)])
              continue;
            region[next] = name;
            open.push_back(next);
          }
    }
  };
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const bool border = i == 0 || j == 0 || k == 0 || i == nx - 1 || j == ny - 1 || k == nz - 1;
        const std::size_t at = volume.offset(i, j, k);
        if (border && volume.labels[at] == kBackground && region[at] == -2) spread(at, -1);
      }
  for (std::size_t at = 0; at < region.size(); ++at)
    if (region[at] == -2) spread(at, static_cast<int>(at));
  return region;
}

TEST(VoxelRegions, AreThoseOfFloodingOverFacesEdgesAndCorners) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const LabelVolume volume = test::random_labels(seed).volume;
    const VoxelRegions regions(volume, kBackground);
    const std::vector<int> expected = flood(volume);
    std::map<int, std::uint32_t> names{{-1, VoxelRegions::kOutside}};
    std::vector<double> volumes(regions.count(), 0);
    for (int k = 0; k < volume.size[2]; ++k)
      for (int j = 0; j < volume.size[1]; ++j)
        for (int i = 0; i < volume.size[0]; ++i) {
          const std::uint32_t region = regions.at(i, j, k);
          const int flooded = expected[volume.offset(i, j, k)];
          ASSERT_EQ(names.try_emplace(flooded, region).first->second, region) << seed;
          ASSERT_EQ(regions.label(region), volume.at(i, j, k));
          if (flooded >= 0) volumes[region] += 1;
        }
    ASSERT_EQ(names.size(), regions.count());
    ASSERT_EQ(regions.volumes(), volumes);
  }
}

TEST(VoxelRegions, CountMergedLabelsAsOne) {
  const LabelVolume volume = test::make_volume(6, 3, 3, [](int i, int, int) { return i == 3 ? 0 : 1 + i; });
  const VoxelRegions regions(volume, 2);
  EXPECT_EQ(regions.count(), 3U);
  EXPECT_EQ(regions.label(1), 2);
  EXPECT_EQ(regions.volumes(), (std::vector<double>{0, 27, 18}));
}

TEST(VoxelRegions, SeeTheSixNeighbours) {
  const LabelVolume volume =
      test::make_volume(5, 5, 5, [](int i, int j, int k) { return k == 2 || (i == 2 && j == 2) ? 1 : 0; });
  const VoxelRegions regions(volume, kBackground);
  const auto around = [&](int i, int j, int k) {
    const auto found = regions.around(i, j, k);
    return std::array{found.others, found.thin_axes};
  };
  EXPECT_EQ(around(2, 2, 2), (std::array{0, 0}));
  EXPECT_EQ(around(1, 1, 2), (std::array{2, 1}));
  EXPECT_EQ(around(2, 2, 4), (std::array{5, 2}));
  EXPECT_EQ(around(9, 9, 9), (std::array{0, 0}));
}

}  // namespace
}  // namespace voxtet
