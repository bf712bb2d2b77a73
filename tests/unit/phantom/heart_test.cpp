#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "geometry/grid/distance_transform.h"
#include "heart.h"

namespace voxtet {
namespace {

using Voxels = std::vector<std::size_t>;

template <class Visit>
void for_face_neighbours(const LabelVolume& volume, std::size_t voxel, Visit visit) {
  const int nx = volume.size[0], ny = volume.size[1];
  const int i = static_cast<int>(voxel) % nx, j = static_cast<int>(voxel) / nx % ny;
  const int k = static_cast<int>(voxel) / (nx * ny);
  const int steps[6][3] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
  for (const auto& s : steps)
    if (volume.contains(i + s[0], j + s[1], k + s[2])) visit(volume.offset(i + s[0], j + s[1], k + s[2]));
}

/// The 6-connected components of each label, largest first.
std::map<Label, std::vector<Voxels>> components(const LabelVolume& volume) {
  std::map<Label, std::vector<Voxels>> found;
  std::vector<bool> seen(volume.labels.size(), false);
  for (std::size_t start = 0; start < seen.size(); ++start) {
    if (seen[start]) continue;
    Voxels part{start};
    seen[start] = true;
    for (std::size_t next = 0; next < part.size(); ++next)
      for_face_neighbours(volume, part[next], [&](std::size_t v) {
        if (seen[v] || volume.labels[v] != volume.labels[start]) return;
        seen[v] = true;
        part.push_back(v);
      });
    found[volume.labels[start]].push_back(std::move(part));
  }
  for (auto& [label, parts] : found)
    std::sort(parts.begin(), parts.end(),
              [](const Voxels& a, const Voxels& b) { return a.size() > b.size(); });
  return found;
}

/// Least distance (mm) from a voxel of `from` to one where `is_target(label, z_mm)`.
template <class IsTarget>
float least_distance_mm(const LabelVolume& volume, Label from, IsTarget is_target) {
  std::vector<std::uint8_t> mask(volume.labels.size(), 0);
  const std::size_t slice = static_cast<std::size_t>(volume.size[0]) * volume.size[1];
  for (std::size_t v = 0; v < mask.size(); ++v)
    mask[v] = is_target(volume.labels[v], volume.to_mm({0, 0, static_cast<double>(v / slice)}).z());
  const std::vector<float> distance = distance_to_mask_mm(volume.size, volume.spacing_mm(), mask);
  float least = 1e9F;
  for (std::size_t v = 0; v < mask.size(); ++v)
    if (volume.labels[v] == from) least = std::min(least, distance[v]);
  return least;
}

constexpr double kLowestBaseMm = 29;  // the tilted base plane lies above this height

TEST(Biventricle, EachLabelIsOnePieceAndTheIsthmusCutsTheCoreInTwo) {
  for (const double spacing : {1.5, 2.5})
    for (const double roughness : {0.0, 1.2})
      for (const std::uint32_t seed : {1u, 2u, 3u})
        for (const bool turned : {false, true}) {
          PhantomParams params;
          params.spacing_mm.setConstant(spacing);
          params.roughness_mm = roughness;
          params.seed = seed;
          params.scar = true;
          if (turned) params.rotation_deg = {33, 21, -48};
          const auto parts = components(heart(params));
          ASSERT_EQ(parts.size(), 7u);
          for (const auto& [label, list] : parts) {
            ASSERT_EQ(list.size(), label == 5 ? 2u : 1u) << "label " << label << ", spacing " << spacing
                                                         << ", roughness " << roughness << ", seed " << seed;
            if (label == 5) {
              EXPECT_GT(list[1].size(), 0.4 * list[0].size());
            }
          }
        }
}

TEST(Biventricle, PoolsMeetTheBackgroundOnlyAtTheBase) {
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    PhantomParams params;
    params.seed = seed;
    params.roughness_mm = 1.2;
    const LabelVolume volume = heart(params);
    const std::size_t slice = static_cast<std::size_t>(volume.size[0]) * volume.size[1];
    std::map<Label, int> open;
    for (std::size_t v = 0; v < volume.labels.size(); ++v) {
      if (volume.labels[v] != 3 && volume.labels[v] != 4) continue;
      for_face_neighbours(volume, v, [&](std::size_t neighbour) {
        if (volume.labels[neighbour] != kBackground) return;
        ++open[volume.labels[v]];
        EXPECT_GT(volume.to_mm({0, 0, static_cast<double>(v / slice)}).z(), kLowestBaseMm);
      });
    }
    EXPECT_GT(open[3], 300);
    EXPECT_GT(open[4], 100);
  }
}

TEST(Biventricle, WallsHaveAnatomicalThickness) {
  PhantomParams params;
  params.spacing_mm.setConstant(0.75);
  const LabelVolume volume = heart(params);
  // Between voxel centres of the two sides; the wall itself may be up to a voxel diagonal thinner.
  const float rv =
      least_distance_mm(volume, 4, [](Label l, double z) { return l == 0 && z < kLowestBaseMm; });
  EXPECT_GE(rv, 3.5F);
  EXPECT_LE(rv, 5.0F);
  const float lv =
      least_distance_mm(volume, 3, [](Label l, double z) { return l == 0 && z < kLowestBaseMm; });
  EXPECT_GE(lv, 4.5F);
  EXPECT_LE(lv, 7.0F);
  EXPECT_GE(least_distance_mm(volume, 3, [](Label l, double) { return l == 4; }), 7.0F);
}

TEST(Biventricle, IsthmusIsAtLeastFiveMillimetresWide) {
  for (const std::uint32_t seed : {1u, 2u, 3u, 4u}) {
    PhantomParams params;
    params.spacing_mm.setConstant(0.75);
    params.scar = true;
    params.seed = seed;
    LabelVolume volume = heart(params);
    const auto parts = components(volume);
    ASSERT_EQ(parts.at(5).size(), 2u);
    for (const std::size_t v : parts.at(5)[1]) volume.labels[v] = 7;
    EXPECT_GE(least_distance_mm(volume, 5, [](Label l, double) { return l == 7; }), 5.0F + 0.75F);
  }
}

TEST(Biventricle, ScarTakesFromTheLeftVentricleOnlyAndBorderSurroundsTheCore) {
  PhantomParams params;
  const LabelVolume healthy = heart(params);
  params.scar = true;
  const LabelVolume scarred = heart(params);
  ASSERT_EQ(healthy.size, scarred.size);
  for (std::size_t v = 0; v < healthy.labels.size(); ++v) {
    const Label now = scarred.labels[v];
    if (now != 5 && now != 6)
      EXPECT_EQ(now, healthy.labels[v]);
    else
      EXPECT_EQ(healthy.labels[v], 1);
    if (now == 5)
      for_face_neighbours(scarred, v, [&](std::size_t neighbour) {
        const Label other = scarred.labels[neighbour];
        EXPECT_TRUE(other == 5 || other == 6 || other == 3) << other;
      });
  }
}

/// Of the rays from the left ventricle's axis into the middle of the scar, each cut at 0.25 mm: the labels of
/// the wall on every ray.
std::vector<std::vector<Label>> walls_of_scar(const PhantomParams& params) {
  const auto body = phantom_body(params);
  const Eigen::Vector3d axis(-12, -2, 14);  // the ventricle's axis is off the middle of the heart
  std::vector<std::vector<Label>> rays;
  for (int degrees = -24; degrees <= 24; degrees += 3)
    for (double z = -17; z <= -1; z += 1) {
      const double angle = std::atan2(0.6, -0.8) + degrees * 3.14159265358979 / 180;
      std::vector<Label>& wall = rays.emplace_back();
      for (double r = 18; r < 36; r += 0.25) {
        const Label label = body(axis + Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), z));
        if (label != 3 && label != kBackground) wall.push_back(label);
      }
    }
  return rays;
}

TEST(Biventricle, TransmuralScarReachesFromEndocardiumToEpicardium) {
  PhantomParams params;
  params.scar = true;
  params.isthmus_mm = 0;
  for (const double depth : {0.7, 1.0}) {
    params.scar_depth = depth;
    for (const auto& wall : walls_of_scar(params)) {
      ASSERT_GT(wall.size(), 20u);
      const auto core = std::count(wall.begin(), wall.end(), 5);
      if (depth == 1)
        EXPECT_EQ(core, wall.size());
      else
        EXPECT_NEAR(static_cast<double>(core) / wall.size(), 0.7, 0.06);
    }
  }
}

TEST(Biventricle, IsthmusIsTheOnlyWayThroughTransmuralScar) {
  PhantomParams params;
  params.scar = true;
  params.scar_depth = 1;
  const LabelVolume open = heart(params);
  EXPECT_EQ(components(open).at(5).size(), 2u);
  // The channel's sides go straight through the wall, so that nothing leads over or under the core.
  std::size_t core = 0, channel = 0;
  const auto walls = walls_of_scar(params);
  for (const auto& wall : walls) {
    core += std::count(wall.begin(), wall.end(), 5) == wall.size();
    channel += std::count(wall.begin(), wall.end(), 6) == wall.size();
  }
  EXPECT_EQ(core + channel, walls.size());
  EXPECT_GT(core, 100u);
  EXPECT_GT(channel, 80u);
  params.isthmus_mm = 0;
  const LabelVolume closed = heart(params);
  EXPECT_EQ(components(closed).at(5).size(), 1u);
  // Closing turns border zone into core and nothing else.
  ASSERT_EQ(open.size, closed.size);
  for (std::size_t v = 0; v < open.labels.size(); ++v)
    if (open.labels[v] != closed.labels[v]) {
      EXPECT_EQ(open.labels[v], 6);
      EXPECT_EQ(closed.labels[v], 5);
    }
}

TEST(Biventricle, IsthmusIsAsWideAsAsked) {
  for (const double width : {3.0, 6.0, 12.0}) {
    PhantomParams params;
    params.scar = true;
    params.scar_depth = 1;
    params.isthmus_mm = width;
    params.roughness_mm = 0;
    params.spacing_mm.setConstant(0.75);
    LabelVolume volume = heart(params);
    const auto parts = components(volume);
    ASSERT_EQ(parts.at(5).size(), 2u);
    for (const std::size_t v : parts.at(5)[1]) volume.labels[v] = 7;
    // A millimetre of arc is 24 / 28 of one at the endocardium, and the channel bends.
    const float least = least_distance_mm(volume, 5, [](Label l, double) { return l == 7; });
    EXPECT_LE(least, width * 24 / 28 + 0.75) << width;
    EXPECT_GE(least, width * 3 / 4 - 0.75) << width;
  }
}

TEST(Biventricle, WithoutBorderZoneOnlyTheIsthmusIsLeftOfIt) {
  PhantomParams params;
  params.scar = true;
  params.scar_depth = 1;
  const auto wide = phantom_body(params);
  params.border_mm = 0;
  const auto narrow = phantom_body(params);
  const LabelVolume bare = heart(params);
  bare.visit([&](int i, int j, int k, std::size_t) {
    const Eigen::Vector3d p = bare.to_mm(i, j, k);
    EXPECT_EQ(narrow(p) == 5, wide(p) == 5);
    if (narrow(p) != wide(p)) EXPECT_TRUE(narrow(p) == 1 && wide(p) == 6);
  });
  const auto parts = components(bare);
  EXPECT_EQ(parts.at(5).size(), 2u);
  EXPECT_EQ(parts.at(6).size(), 1u);
  params.isthmus_mm = 0;
  EXPECT_EQ(components(heart(params)).count(6), 0u);
}

TEST(Biventricle, ScaleMultipliesLengths) {
  PhantomParams params;
  const LabelVolume adult = heart(params);
  params.scale = 0.5;
  params.spacing_mm *= 0.5;
  params.roughness_mm *= 0.5;
  const LabelVolume child = heart(params);
  EXPECT_EQ(adult.size, child.size);
  EXPECT_EQ(adult.labels, child.labels);
}

TEST(Biventricle, SeedMovesTheRoughnessOnly) {
  PhantomParams params;
  const LabelVolume one = heart(params);
  params.seed = 2;
  EXPECT_NE(heart(params).labels, one.labels);
  params.roughness_mm = 0;
  const LabelVolume smooth = heart(params);
  params.seed = 1;
  EXPECT_EQ(heart(params).labels, smooth.labels);
}

}  // namespace
}  // namespace voxtet
