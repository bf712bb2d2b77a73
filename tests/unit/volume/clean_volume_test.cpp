#include "volume/clean/clean_volume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "base/digest.h"
#include "geometry/topology/label_components.h"
#include "support/label_bodies.h"
#include "support/random_labels.h"
#include "support/test_random.h"
#include "volume/clean/mend_handles.h"
#include "volume/prepare_volume.h"
#include "volume/select_labels.h"

namespace voxtet {
namespace {

using test::make_volume;

struct Topology {
  int pieces, cavities, handles;
};

/// Whether all corners v, v + step a, v + step b, ... have the label; steps are bits of the axes.
bool is_simplex(const LabelVolume& volume, Label label, int i, int j, int k, const std::vector<int>& steps) {
  bool all = volume.at_or_background(i, j, k) == label;
  for (const int s : steps)
    all = all && volume.at_or_background(i + (s & 1), j + (s >> 1 & 1), k + (s >> 2)) == label;
  return all;
}

/// By counting the simplices of the Kuhn triangulation whose corners all have the label.
Topology topology_of(const LabelVolume& volume, Label label) {
  LabelVolume padded = make_volume(
      volume.size[0] + 2, volume.size[1] + 2, volume.size[2] + 2,
      [&](int i, int j, int k) { return volume.at_or_background(i - 1, j - 1, k - 1) == label ? 1 : 0; });
  std::vector<std::vector<int>> chains{{}};  // of growing sets of axes, the origin left out
  for (int a = 1; a < 8; ++a) {
    chains.push_back({a});
    for (int b = a + 1; b < 8; ++b) {
      if ((a & b) != a) continue;
      chains.push_back({a, b});
      if (b != 7)
        for (const int c : {7})
          if ((b & c) == b) chains.push_back({a, b, c});
    }
  }
  int euler = 0;
  for (int k = 0; k < padded.size[2]; ++k)
    for (int j = 0; j < padded.size[1]; ++j)
      for (int i = 0; i < padded.size[0]; ++i)
        for (const auto& chain : chains)
          if (is_simplex(padded, 1, i, j, k, chain)) euler += chain.size() % 2 == 0 ? 1 : -1;
  std::vector<std::uint32_t> sizes;
  const auto ids = label_components(padded.size, padded.labels, sizes, Connectivity::kKuhn);
  std::vector<bool> of_label(sizes.size(), false);
  for (std::size_t v = 0; v < ids.size(); ++v) of_label[ids[v]] = padded.labels[v] == 1;
  const int pieces = static_cast<int>(std::count(of_label.begin(), of_label.end(), true));
  const int cavities = static_cast<int>(sizes.size()) - pieces - 1;
  return {pieces, cavities, pieces + cavities - euler};
}

/// A wall (1) between a pool (2) and background, drilled through by one voxel of background, and by one of
/// the pool.
LabelVolume drilled_wall() {
  return make_volume(16, 12, 14, [](int i, int j, int k) {
    if (i == 0 || j == 0 || i == 15 || j == 11 || k == 0 || k == 13) return 0;
    if (i == 4 && j == 5 && k >= 5) return 0;
    if (i == 11 && j == 6 && k >= 5) return k < 9 ? 2 : 0;
    return k < 5 ? 2 : k < 9 ? 1 : 0;
  });
}

/// A block with a staple of one voxel's width on it.
LabelVolume stapled_block() {
  return make_volume(14, 12, 12, [](int i, int j, int k) {
    if (k == 5 && j == 5 && (i == 5 || i == 9)) return 1;
    if (k == 6 && j == 5 && (i == 5 || i == 9)) return 1;
    if (k == 7 && j == 5 && i >= 5 && i <= 9) return 1;
    return k >= 1 && k < 5 && i >= 1 && i < 13 && j >= 1 && j < 11 ? 1 : 0;
  });
}

TEST(MendHandles, ClosesTunnelsThroughAWall) {
  LabelVolume volume = drilled_wall();
  EXPECT_EQ(topology_of(volume, 1).handles, 2);
  const auto mended = mend_handles(volume, 10, Connectivity::kKuhn);
  EXPECT_EQ(topology_of(volume, 1).handles, 0);
  EXPECT_EQ(topology_of(volume, 2).handles, 0);
  for (int k = 5; k < 9; ++k) {
    EXPECT_EQ(volume.at(4, 5, k), 1) << k;
    EXPECT_EQ(volume.at(11, 6, k), 1) << k;
  }
  ASSERT_TRUE(mended.contains(1));
  EXPECT_EQ(mended.at(1).closed, 2U);
  EXPECT_EQ(mended.at(1).closed_voxels, 8U);
}

/// One leak through a closed shell is no handle: the pool is no cavity because of it.
TEST(MendHandles, ClosesTheOnlyLeakOfAPool) {
  const auto shell = [](Label pool) {
    return make_volume(14, 14, 14, [=](int i, int j, int k) {
      const int r = std::max({std::abs(2 * i - 13), std::abs(2 * j - 13), std::abs(2 * k - 13)});
      if (i == 6 && j == 6 && k > 8) return 0;
      return r < 6 ? static_cast<int>(pool) : r < 11 ? 1 : 0;
    });
  };
  LabelVolume volume = shell(2);
  EXPECT_EQ(topology_of(volume, 1).cavities, 0);
  EXPECT_EQ(mend_handles(volume, 27, Connectivity::kKuhn).at(1).closed, 1U);
  EXPECT_EQ(topology_of(volume, 1).cavities, 1);
  // Where the pool is background too, this would make a piece of it.
  LabelVolume empty = shell(kBackground);
  mend_handles(empty, 27, Connectivity::kKuhn);
  EXPECT_EQ(topology_of(empty, 1).cavities, 0);
}

TEST(MendHandles, OpensAThinHandleOrClosesItWhicheverTakesLess) {
  for (const Connectivity connectivity : {Connectivity::kFaces, Connectivity::kKuhn}) {
    LabelVolume volume = stapled_block();
    EXPECT_EQ(topology_of(volume, 1).handles, 1);
    const auto mended = mend_handles(volume, 27, connectivity);
    EXPECT_EQ(topology_of(volume, 1).handles, 0);
    EXPECT_EQ(topology_of(volume, 1).pieces, 1);
    ASSERT_TRUE(mended.contains(1));
    EXPECT_EQ(mended.at(1).opened + mended.at(1).closed, 1U);
  }
}

TEST(MendHandles, LeavesHandlesThatAreThickOrLarge) {
  const LabelVolume ring = make_volume(26, 26, 10, [](int i, int j, int k) {
    return test::in_torus(i - 12.5, j - 12.5, k - 4.5, 8, 2.6) ? 1 : 0;
  });
  for (const Connectivity connectivity : {Connectivity::kFaces, Connectivity::kKuhn}) {
    LabelVolume volume = ring;
    EXPECT_TRUE(mend_handles(volume, 27, connectivity).empty());
    EXPECT_EQ(volume.labels, ring.labels);
  }
  // One voxel less than the limit has to change, and as many as it.
  LabelVolume volume = drilled_wall();
  for (int k = 5; k < 9; ++k) volume.labels[volume.offset(4, 5, k)] = 1;
  LabelVolume same = volume;
  EXPECT_FALSE(mend_handles(same, 5, Connectivity::kKuhn).empty());
  EXPECT_EQ(same.at(11, 6, 5), 1);
}

TEST(MendHandles, FillsPitsThatAreDeep) {
  // One voxel deep, three deep, and three deep but two wide.
  LabelVolume volume = make_volume(18, 8, 10, [](int i, int j, int k) {
    if (i < 1 || i > 16 || j < 1 || j > 6 || k < 1 || k > 7) return 0;
    if (j == 4 && i == 3) return k > 6 ? 0 : 1;
    if (j == 4 && i == 8) return k > 4 ? 0 : 1;
    if (j == 4 && (i == 12 || i == 13)) return k > 4 ? 0 : 1;
    return 1;
  });
  const auto mended = mend_handles(volume, 27, Connectivity::kFaces);
  EXPECT_EQ(volume.at(3, 4, 7), 0);
  EXPECT_EQ(volume.at(8, 4, 5), 1);
  EXPECT_EQ(volume.at(8, 4, 7), 1);
  EXPECT_EQ(volume.at(12, 4, 5), 0);
  ASSERT_TRUE(mended.contains(1));
  EXPECT_EQ(mended.at(1).pits, 1U);
  EXPECT_EQ(mended.at(1).pit_voxels, 3U);
}

/// Seeds 1 to 12, white noise of two to four labels.
TEST(MendHandles, MakesNoHandleOrPieceAndCountsWhatItTakes) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const LabelVolume before = test::random_volume(11, 2 + static_cast<int>(seed % 3), seed);
    LabelVolume after = before;
    int counted = 0, taken = 0;
    for (const auto& [label, of] : mend_handles(after, 9, Connectivity::kKuhn))
      counted += static_cast<int>(of.opened + of.closed);
    for (const auto& [label, voxels] : count_labels(before)) {
      const Topology was = topology_of(before, label), is = topology_of(after, label);
      EXPECT_EQ(is.pieces, was.pieces) << "label " << label;
      EXPECT_GE(is.cavities, was.cavities) << "label " << label;
      EXPECT_LE(is.handles, was.handles) << "label " << label;
      taken += was.handles - is.handles + is.cavities - was.cavities;
    }
    EXPECT_EQ(counted, taken);
    EXPECT_GT(taken, 0);
  }
}

/// A shell around a pool with seeded specks, tunnels and staples.
LabelVolume noisy_shell() {
  LabelVolume volume = make_volume(40, 40, 40, [](int i, int j, int k) {
    const double r = std::sqrt((i - 19.5) * (i - 19.5) + (j - 19.5) * (j - 19.5) + (k - 19.5) * (k - 19.5));
    return r < 12 ? 2 : r < 16 ? 1 : 0;
  });
  test::TestRandom random(7);
  const auto below = [&](int n) { return random.below(n); };
  for (int n = 0; n < 60; ++n) {
    const int i = 2 + below(36), j = 2 + below(36), k = 2 + below(36);
    volume.labels[volume.offset(i, j, k)] = static_cast<Label>(below(3));
  }
  for (int n = 0; n < 6; ++n)  // through the wall, below and above
    for (int k = 0; k < 11; ++k) {
      const std::size_t at = volume.offset(13 + 2 * n, 19, n % 2 ? k : 39 - k);
      if (volume.labels[at] == 1) volume.labels[at] = static_cast<Label>(n % 3 == 0 ? 2 : 0);
    }
  return volume;
}

TEST(CleanVolume, FindsWhatItTakesAwayAndThenNothing) {
  LabelVolume volume = noisy_shell();
  const Flaws found = find_flaws(volume);
  std::map<std::string, std::size_t> counts;
  for (const Flaw& flaw : found) counts[name_of(flaw.kind)] = flaw.count;
  EXPECT_GT(counts["pieces"], 10U);
  EXPECT_GT(counts["holes"], 3U);
  EXPECT_EQ(counts["tunnels"], 6U);
  const Flaws mended = clean_volume(volume, kUsualCleaning);
  ASSERT_EQ(mended.size(), found.size());
  EXPECT_TRUE(find_flaws(volume).empty());
  EXPECT_EQ(topology_of(volume, 1).handles, 0);
  EXPECT_EQ(topology_of(volume, 1).pieces, 1);
  EXPECT_EQ(topology_of(volume, 1).cavities, 1);
  EXPECT_EQ(topology_of(volume, 2).pieces, 1);
}

TEST(CleanVolume, SaysFlawsInWords) {
  EXPECT_EQ(in_words({FlawKind::kPieces, 3012, 3400, 5, {{1, 1010}, {2, 2002}}}),
            "3,012 loose pieces of labels 1 (1,010), 2 (2,002): 3,400 voxels, the largest of 5");
  EXPECT_EQ(in_words({FlawKind::kTunnels, 1, 4, 0, {{2, 1}}}),
            "1 thin tunnel through label 2: 4 voxels to fill");
  EXPECT_EQ(in_words({FlawKind::kHoles, 1, 1, 1, {}}), "1 enclosed hole: 1 voxel");
}

TEST(CleanVolume, GivesTheSameVoxelsOnEveryPlatform) {
  LabelVolume volume = noisy_shell();
  clean_volume(volume, kUsualCleaning);
  EXPECT_EQ(digest_of(volume), "a7ea3533979900ab1b82a4d1e901a7a00cda1b5be19c3195bfffd2e97dd90ee3");
}

TEST(PrepareVolume, WarnsOfFlawsWithTheRemedyAndNotesWhatItCleaned) {
  std::vector<std::string> notes, warnings;
  RunContext ctx;
  ctx.on_note = [&](const std::string&, const std::string& text) { notes.push_back(text); };
  ctx.on_warning = [&](const std::string&, const std::string& text) { warnings.push_back(text); };
  const auto noisy = std::make_shared<LabelVolume>(noisy_shell());
  const Result<PreparedVolume> as_it_is = prepare_volume(noisy, {}, {}, {}, ctx);
  ASSERT_TRUE(as_it_is.ok());
  EXPECT_EQ(as_it_is->flaws.size(), warnings.size());
  ASSERT_FALSE(warnings.empty());
  EXPECT_NE(warnings[0].find("loose pieces"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[0].find("--clean"), std::string::npos) << warnings[0];
  EXPECT_TRUE(notes.empty());
  warnings.clear();
  VolumeParams clean;
  clean.speck_voxels = clean.hole_voxels = clean.handle_voxels = 27;
  const Result<PreparedVolume> cleaned = prepare_volume(noisy, {}, {}, clean, ctx);
  ASSERT_TRUE(cleaned.ok());
  EXPECT_TRUE(warnings.empty());
  EXPECT_TRUE(cleaned->flaws.empty());
  EXPECT_EQ(notes.size(), as_it_is->flaws.size());
  EXPECT_EQ(notes[0].find("cleaned: "), 0U);
}

}  // namespace
}  // namespace voxtet
