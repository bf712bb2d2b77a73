// A noisy heart is meshed as the clean one is, once its noise is taken away.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "geometry/topology/label_topology.h"
#include "io/volume/read_volume.h"
#include "io/volume/write_volume.h"
#include "phantom/make_phantom.h"
#include "pipeline/session.h"
#include "support/data.h"
#include "support/test_random.h"
#include "volume/clean/clean_volume.h"

namespace voxtet {
namespace {

std::array<int, 3> random_voxel(const LabelVolume& volume, test::TestRandom& random) {
  return {random.below(volume.size[0]), random.below(volume.size[1]), random.below(volume.size[2])};
}

/// Single voxels of label 1 in the background, apart from everything.
void add_specks(LabelVolume& volume, int count, test::TestRandom& random) {
  const auto alone = [&](const std::array<int, 3>& at) {
    for (int d = 0; d < 27; ++d)
      if (volume.at_or_background(at[0] + d % 3 - 1, at[1] + d / 3 % 3 - 1, at[2] + d / 9 - 1) != kBackground)
        return false;
    return true;
  };
  while (count > 0) {
    const std::array<int, 3> at = random_voxel(volume, random);
    if (!alone(at)) continue;
    volume.labels[volume.offset(at[0], at[1], at[2])] = 1;
    --count;
  }
}

/// An arch one voxel thick over five voxels of label 1, upwards along an axis; false where there is no room.
bool add_arch(const LabelVolume& heart, const std::array<int, 3>& start, int axis, int up,
              LabelVolume& noisy) {
  const auto place = [&](int height, int along, int beside = 0) {
    std::array<int, 3> voxel = start;
    voxel[axis] += up * height;
    voxel[(axis + 1) % 3] += along;
    voxel[(axis + 2) % 3] += beside;
    return voxel;
  };
  const auto label = [](const LabelVolume& volume, const std::array<int, 3>& v) {
    return volume.at_or_background(v[0], v[1], v[2]);
  };
  std::array<int, 5> top{};  // the first background voxel above each
  for (int n = 0; n < 5; ++n) {
    while (label(heart, place(top[n], n)) == 1) ++top[n];
    if (top[n] == 0) return false;
  }
  const auto [lowest, highest] = std::minmax_element(top.begin(), top.end());
  const int arch = *highest + 1;
  if (arch - *lowest > 3) return false;
  for (int n = -2; n < 7; ++n)
    for (int beside = -2; beside <= 2; ++beside)
      for (int height = *lowest - 1; height <= arch + 2; ++height) {
        const std::array<int, 3> at = place(height, n, beside);
        const bool above = height >= (n >= 0 && n < 5 ? top[n] : *highest);
        if (label(noisy, at) != label(heart, at) || (above && label(heart, at) != kBackground)) return false;
        for (int a = 0; a < 3; ++a)
          if (at[a] < 0 || at[a] >= heart.size[a]) return false;
      }
  for (int n = 0; n < 5; ++n)
    for (int height = n % 4 == 0 ? top[n] : arch; height <= arch; ++height) {
      const std::array<int, 3> at = place(height, n);
      noisy.labels[noisy.offset(at[0], at[1], at[2])] = 1;
    }
  return true;
}

/// Thin handles on label 1, apart from each other.
void add_handles(LabelVolume& volume, int count, test::TestRandom& random) {
  const LabelVolume heart = volume;
  while (count > 0) {
    // One after the other: the order in which arguments are computed is the compiler's.
    const std::array<int, 3> at = random_voxel(volume, random);
    const int axis = random.below(3);
    const int up = random.below(2) == 0 ? 1 : -1;
    if (add_arch(heart, at, axis, up, volume)) --count;
  }
}

void run(Stage last, const LabelVolume& volume, const CleanLimits& limits, double edge_mm, Session& session) {
  const Result<Bytes> file = write_nifti(volume, false);
  ASSERT_TRUE(file.ok());
  ASSERT_TRUE(session.load_volume({"noisy.nii", *file, {}}).ok());
  Recipe recipe = session.recipe();
  recipe.labels = {1, 2};
  recipe.sizing.edge_mm = edge_mm;
  recipe.volume.speck_voxels = limits.speck_voxels;
  recipe.volume.hole_voxels = limits.hole_voxels;
  recipe.volume.handle_voxels = limits.handle_voxels;
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  RunContext ctx;
  const Status done = session.run(last, ctx);
  ASSERT_TRUE(done.ok()) << done.error().message;
}

bool any_holds(const std::vector<std::string>& texts, const std::string& word) {
  return std::any_of(texts.begin(), texts.end(),
                     [&](const auto& text) { return text.find(word) != std::string::npos; });
}

/// Of the walls. Where an arch is as cheap to fill as to take away, it counts as a tunnel.
std::size_t handles_and_tunnels(LabelVolume walls) {
  for (Label& label : walls.labels)
    if (label > 2) label = kBackground;
  std::size_t count = 0;
  for (const Flaw& flaw : find_flaws(walls))
    if (flaw.kind == FlawKind::kHandles || flaw.kind == FlawKind::kTunnels) count += flaw.count;
  return count;
}

/// Meshes the heart, and the heart with noise, which is cleaned: the same pieces, and no slow method.
void expect_cleaned(const LabelVolume& heart, int specks, int handles, double edge_mm,
                    const std::string& pieces) {
  LabelVolume noisy = heart;
  test::TestRandom random(46);
  add_handles(noisy, handles, random);
  add_specks(noisy, specks, random);

  Session as_it_is;
  ASSERT_NO_FATAL_FAILURE(run(Stage::kVolume, noisy, {}, edge_mm, as_it_is));
  EXPECT_TRUE(any_holds(as_it_is.warnings(), pieces));
  EXPECT_EQ(handles_and_tunnels(noisy) - handles_and_tunnels(heart), static_cast<std::size_t>(handles));
  EXPECT_TRUE(any_holds(as_it_is.warnings(), "thin handle") || any_holds(as_it_is.warnings(), "thin tunnel"));
  EXPECT_TRUE(any_holds(as_it_is.warnings(), "--clean"));

  Session cleaned, clean;
  ASSERT_NO_FATAL_FAILURE(run(Stage::kRemesh, noisy, kUsualCleaning, edge_mm, cleaned));
  ASSERT_NO_FATAL_FAILURE(run(Stage::kRemesh, heart, kUsualCleaning, edge_mm, clean));
  EXPECT_FALSE(any_holds(cleaned.warnings(), "method adapt"));
  EXPECT_EQ(label_topology(*cleaned.remeshed()), label_topology(*clean.remeshed()));
}

TEST(Noise, OfAGeneratedHeartIsNamedAndCleaned) {
  PhantomParams params;
  params.kind = PhantomKind::kBiventricle;
  params.spacing_mm = Eigen::Vector3d::Constant(2);
  const Result<LabelVolume> heart = make_phantom(params);
  ASSERT_TRUE(heart.ok());
  expect_cleaned(*heart, 300, 5, 6, "300 loose pieces of label 1: 300 voxels");
}

TEST(NoiseOverAHeart, IsNamedAndCleaned) {
  const std::string path = test::shared_data("biv_mean_1mm.nii.gz");
  if (path.empty()) GTEST_SKIP() << "the volume is not there: set VOXTET_DATA";
  const Result<LabelVolume> heart = read_volume_file(path);
  ASSERT_TRUE(heart.ok());
  expect_cleaned(*heart, 3000, 30, 4, "3,000 loose pieces of label 1: 3,000 voxels");
}

}  // namespace
}  // namespace voxtet
