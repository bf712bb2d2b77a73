// Voxels at which the topology of an adapted surface may differ from that of the label surface.
#include "remesh/delaunay/suspect_voxels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "support/label_bodies.h"
#include "support/label_surface.h"

namespace voxtet::remesh {
namespace {

constexpr int kBlockGrid = 18, kMiddle = 9, kFirst = 3, kLast = 14;

bool in_block(int i, int j, int k) {
  return std::min({i, j, k}) >= kFirst && std::max({i, j, k}) <= kLast;
}

/// A block of label 1, with what `made_of` puts in its place; what is around it is background.
template <class MadeOf>
LabelVolume block(MadeOf&& made_of) {
  return test::make_volume(kBlockGrid, kBlockGrid, kBlockGrid,
                           [&](int i, int j, int k) { return in_block(i, j, k) ? made_of(i, j, k) : 0; });
}

LabelVolume solid() {
  return block([](int, int, int) { return 1; });
}
LabelVolume with_tunnel(int content) {
  return block([&](int i, int j, int) { return i == kMiddle && j == kMiddle ? content : 1; });
}

/// Suspects of the surface of one volume, with the other as the labels. Little smoothed: a block keeps the
/// voxels at its corners.
std::vector<bool> suspects(const LabelVolume& found, const LabelVolume& wanted,
                           const std::vector<Label>& labels,
                           const std::vector<Eigen::Vector3d>& touching = {}) {
  SmoothParams params;
  params.iterations = 10;
  const SurfaceMesh reference = test::label_surface(wanted, params);
  const LabelField field(wanted, reference);
  return SuspectVoxels(reference, field).of(test::label_surface(found, params), labels, touching);
}

int count_of(const std::vector<bool>& marked) {
  return static_cast<int>(std::count(marked.begin(), marked.end(), true));
}

TEST(SuspectVoxels, AreNoneOfTheReference) {
  EXPECT_TRUE(suspects(with_tunnel(0), with_tunnel(0), {1}).empty());
  EXPECT_TRUE(suspects(with_tunnel(2), with_tunnel(2), {1, 2}).empty());
}

TEST(SuspectVoxels, AreAlongATunnelThatTheSurfaceHasClosed) {
  for (const int content : {0, 2}) {
    const std::vector<bool> marked = suspects(solid(), with_tunnel(content), {1});
    ASSERT_FALSE(marked.empty()) << content;
    constexpr int kPadded = kBlockGrid + 2 * LabelField::kPad;
    int on_axis = 0;
    for (int k = 0; k < kPadded; ++k)
      for (int j = 0; j < kPadded; ++j)
        for (int i = 0; i < kPadded; ++i) {
          if (!marked[static_cast<std::size_t>((k * kPadded + j) * kPadded + i)]) continue;
          const int x = i - LabelField::kPad - kMiddle, y = j - LabelField::kPad - kMiddle;
          EXPECT_LE(std::max(std::abs(x), std::abs(y)), 2) << content;
          if (x == 0 && y == 0) ++on_axis;
        }
    EXPECT_GE(on_axis, 2) << content;
  }
}

TEST(SuspectVoxels, AreAllAlongATunnelThatTheSurfaceHasClosed) {
  const std::vector<bool> marked = suspects(solid(), with_tunnel(0), {1});
  constexpr int kPadded = kBlockGrid + 2 * LabelField::kPad, kAxis = kMiddle + LabelField::kPad;
  for (int k = kFirst + LabelField::kPad; k <= kLast + LabelField::kPad; ++k)
    EXPECT_TRUE(marked[static_cast<std::size_t>((k * kPadded + kAxis) * kPadded + kAxis)]) << k;
}

TEST(SuspectVoxels, AreWhereBackgroundAlongADiagonalIsClosed) {
  // Two bores end at the same edge, so that only a diagonal joins them; of one label alone it does.
  for (const int turn : {1, -1}) {
    const auto bores = [&](bool joined) {
      return block([&](int i, int j, int k) {
        if (j != kMiddle) return 1;
        const bool lower = i == kMiddle && k <= kMiddle;
        const bool upper = i == kMiddle + (joined ? 1 : 2) * turn && k > kMiddle;
        return lower || upper ? 0 : 1;
      });
    };
    EXPECT_GT(count_of(suspects(bores(false), bores(true), {1})), 0) << turn;
  }
}

TEST(SuspectVoxels, AreNoneAtADentWhichChangesNoTopology) {
  const LabelVolume dented =
      block([](int i, int j, int k) { return i == kLast && j == kMiddle && k == kMiddle ? 0 : 1; });
  EXPECT_TRUE(suspects(solid(), dented, {1}).empty());
  EXPECT_TRUE(suspects(dented, solid(), {1}).empty());
}

TEST(SuspectVoxels, AreWhereAThinSheetHasAHole) {
  const auto sheet = [](bool whole) {
    return test::make_volume(kBlockGrid, kBlockGrid, kBlockGrid, [&](int i, int j, int k) {
      if (!in_block(i, j, k) || k != kMiddle) return 0;
      return !whole && std::abs(i - kMiddle) <= 1 && std::abs(j - kMiddle) <= 1 ? 0 : 1;
    });
  };
  EXPECT_GT(count_of(suspects(sheet(false), sheet(true), {1})), 0);
}

TEST(SuspectVoxels, AreAroundPlacesWhereTheSurfaceTouchesItself) {
  const LabelVolume volume = with_tunnel(0);
  EXPECT_EQ(count_of(suspects(volume, volume, {1}, {volume.to_mm({kMiddle, kMiddle, 1})})), 27);
}

TEST(SuspectVoxels, AreNoneOfLabelsThatWereNotAskedFor) {
  EXPECT_TRUE(suspects(solid(), with_tunnel(0), {3}).empty());
}

}  // namespace
}  // namespace voxtet::remesh
