#include "volume/stack/align_slices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/digest.h"
#include "io/volume/read_volume.h"
#include "phantom/make_phantom.h"
#include "support/data.h"
#include "support/label_bodies.h"
#include "support/shifted_slices.h"
#include "volume/stack/estimate_shifts.h"

namespace voxtet {
namespace {

using test::Moves;

/// A generated heart, cut into slices of 8 mm with pixels of 1.25 mm.
std::shared_ptr<const LabelVolume> generated_stack(std::uint32_t seed = 1) {
  PhantomParams params;
  params.spacing_mm = {1.25, 1.25, 8};
  params.seed = seed;
  return std::make_shared<const LabelVolume>(make_phantom(params).value());
}

/// Slices of the heart of 8 mm.
std::shared_ptr<const LabelVolume> stack_of(const std::string& file, int first = 0) {
  return std::make_shared<const LabelVolume>(test::keep_every(read_volume_file(file).value(), 2, 8, first));
}

AlignParams asked() {
  AlignParams params;
  params.align_slices = true;
  return params;
}

AlignedVolume aligned(const std::shared_ptr<const LabelVolume>& volume, const AlignParams& params,
                      const RunContext& ctx = {}) {
  Result<AlignedVolume> out = align_slices(volume, params, 2, ctx);
  EXPECT_TRUE(out.ok());
  return std::move(out).value();
}

/// Mean length of what is left of the shifts, less a motion of the whole and a shear.
double mean_error(const LabelVolume& original, const Moves& shifts, const SliceAlignment& found) {
  Moves left;
  for (std::size_t k = 0; k < shifts.size(); ++k)
    if (test::has_labels(original, static_cast<int>(k)))
      left.push_back(shifts[k] +
                     Eigen::Vector2d(found.slices[k].move.first_mm, found.slices[k].move.second_mm));
  test::remove_lean(left);
  double sum = 0;
  for (const Eigen::Vector2d& move : left) sum += move.norm();
  return sum / static_cast<double>(left.size());
}

double error_of_alignment(const LabelVolume& stack, std::uint64_t seed) {
  const Moves shifts = test::random_moves(stack, seed, 3);
  const auto shifted = std::make_shared<const LabelVolume>(test::shifted(stack, shifts));
  return mean_error(stack, shifts, aligned(shifted, asked()).alignment);
}

TEST(AlignSlices, FindsTheShiftsOfAGeneratedHeart) {
  PhantomParams params;
  params.spacing_mm = {1, 1, 1};
  const LabelVolume heart = test::keep_every(make_phantom(params).value(), 2, 8, 0);
  for (std::uint64_t seed = 1; seed <= 4; ++seed) EXPECT_LE(error_of_alignment(heart, seed), 1.2) << seed;
}

TEST(AlignSlices, FindsTheShiftsOfARealHeart) {
  const std::string file = test::shared_data("biv_mean_1mm.nii.gz");
  if (file.empty()) GTEST_SKIP() << "biv_mean_1mm.nii.gz is absent";
  const auto stack = stack_of(file);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const double error = error_of_alignment(*stack, seed);
    std::printf("seed %d: mean error %.2f mm\n", static_cast<int>(seed), error);
    EXPECT_LE(error, 1.2) << seed;
  }
}

TEST(AlignSlices, LeavesAStackThatIsNotShifted) {
  const auto heart = generated_stack();
  EXPECT_EQ(aligned(heart, asked()).volume, heart);
  for (const char* name : {"biv_mean_1mm.nii.gz", "biv_ed_scar_1mm.nii.gz"})
    for (const int first : {0, 3, 5}) {
      const std::string file = test::shared_data(name);
      if (file.empty()) GTEST_SKIP() << name << " is absent";
      const auto stack = stack_of(file, first);
      EXPECT_TRUE(aligned(stack, asked()).volume == stack) << name << " from slice " << first;
    }
}

TEST(AlignSlices, LeavesAStackThatLeans) {
  const auto heart = generated_stack();
  Moves lean;
  for (int k = 0; k < heart->size[2]; ++k) lean.emplace_back(1.25 * k, -2.5 * k);
  const auto leaning = std::make_shared<const LabelVolume>(test::shifted(*heart, lean));
  EXPECT_EQ(aligned(leaning, asked()).volume, leaning);
}

TEST(AlignSlices, SuggestsItselfWhereSlicesAreShifted) {
  std::vector<std::string> warnings;
  RunContext ctx;
  ctx.on_warning = [&](const std::string&, const std::string& text) { warnings.push_back(text); };
  const auto heart = generated_stack();
  aligned(heart, {}, ctx);
  EXPECT_TRUE(warnings.empty());
  const auto moved =
      std::make_shared<const LabelVolume>(test::shifted(*heart, test::random_moves(*heart, 7, 3)));
  EXPECT_EQ(aligned(moved, {}, ctx).volume, moved);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("--align-slices"), std::string::npos) << warnings[0];
}

TEST(AlignSlices, MakesTheMovesThatAreGiven) {
  const auto heart = generated_stack();
  AlignParams params;
  params.slice_shifts = {{4, 2.5, -1.25}};
  const AlignedVolume out = aligned(heart, params);
  ASSERT_EQ(out.volume->size, heart->size);
  EXPECT_TRUE(out.alignment.slices[4].given);
  std::size_t different = 0;
  heart->visit([&](int i, int j, int k, std::size_t voxel) {
    const Label expected = k == 4 ? heart->at_or_background(i - 2, j + 1, k) : heart->labels[voxel];
    different += out.volume->labels[voxel] != expected;
  });
  EXPECT_EQ(different, 0U);
}

TEST(AlignSlices, GrowTheGridForWhatWouldLeaveIt) {
  const auto heart = generated_stack();
  AlignParams params;
  params.slice_shifts = {{5, 37.5, -37.5}};
  const AlignedVolume out = aligned(heart, params);
  EXPECT_EQ(test::label_counts(*out.volume)[1], test::label_counts(*heart)[1]);
  EXPECT_GT(out.volume->size[0], heart->size[0]);
  EXPECT_GT(out.volume->size[1], heart->size[1]);
  const int room = out.volume->size[1] - heart->size[1];
  EXPECT_TRUE(out.volume->to_mm(0, room, 3).isApprox(heart->to_mm(0, 0, 3)));
}

/// By a third of a pixel: every label's area stays, and its centre moves by so much.
TEST(AlignSlices, MovesByPartsOfAPixel) {
  const auto disc = std::make_shared<const LabelVolume>([] {
    LabelVolume volume = test::make_volume(60, 60, 6, [](int i, int j, int) {
      const double r = std::hypot(i - 30, j - 29);
      return r < 12 ? 2 : (r < 20 ? 1 : 0);
    });
    volume.index_to_mm.diagonal() = Eigen::Vector4d(1.5, 1.5, 8, 1);
    return volume;
  }());
  AlignParams params;
  params.slice_shifts = {{2, 0.5, -0.5}};
  const AlignedVolume out = aligned(disc, params);
  EXPECT_DOUBLE_EQ(out.alignment.slices[2].move.first_mm, 0.5);
  for (const Label label : {1, 2}) {
    Eigen::Vector3d before = Eigen::Vector3d::Zero(), after = before;
    double voxels = 0, left = 0;
    disc->visit([&](int i, int j, int k, std::size_t voxel) {
      if (k != 2) return;
      voxels += disc->labels[voxel] == label;
      left += out.volume->labels[voxel] == label;
      if (disc->labels[voxel] == label) before += disc->to_mm(i, j, k);
      if (out.volume->labels[voxel] == label) after += out.volume->to_mm(i, j, k);
    });
    EXPECT_NEAR(left / voxels, 1, 0.02);
    const Eigen::Vector3d moved = after / left - before / voxels;
    constexpr double kEighthOfPixel = 1.5 / 8;
    EXPECT_NEAR(moved.x(), 0.5, kEighthOfPixel);
    EXPECT_NEAR(moved.y(), -0.5, kEighthOfPixel);
  }
}

/// A line one pixel wide would be lost between pixels.
TEST(AlignSlices, MovesThinLabelsByWholePixels) {
  const auto line = std::make_shared<const LabelVolume>([] {
    LabelVolume volume = test::make_volume(30, 30, 6, [](int i, int j, int) { return i == 15 && j > 4; });
    volume.index_to_mm.diagonal() = Eigen::Vector4d(1, 1, 8, 1);
    return volume;
  }());
  AlignParams params;
  params.slice_shifts = {{2, 2.5, 0}};
  const AlignedVolume out = aligned(line, params);
  EXPECT_DOUBLE_EQ(out.alignment.slices[2].move.first_mm, 3);
  EXPECT_EQ(out.volume->at(18, 20, 2), 1);
}

TEST(AlignSlices, RefusesMovesThatCannotBeMade) {
  const auto refused = [](const std::shared_ptr<const LabelVolume>& volume, const AlignParams& params) {
    const Result<AlignedVolume> out = align_slices(volume, params, 2, {});
    EXPECT_FALSE(out.ok());
    return out.ok() ? std::string() : out.error().message;
  };
  AlignParams params;
  params.slice_shifts = {{90, 1, 1}};
  EXPECT_NE(refused(generated_stack(), params).find("slice_shifts[0].slice: found 90, expected at most"),
            std::string::npos);
  params.slice_shifts = {{2, 1, 1}, {2, 1, 1}};
  EXPECT_NE(refused(generated_stack(), params).find("found 2 twice"), std::string::npos);
  const auto ball = std::make_shared<const LabelVolume>(test::ball_volume(9, 4, 3));
  EXPECT_NE(refused(ball, params).find("no stack of thick slices"), std::string::npos);
}

TEST(AlignSlices, GivesTheSameVoxelsOnEveryPlatform) {
  const auto heart = generated_stack();
  const LabelVolume moved = test::shifted(*heart, test::random_moves(*heart, 3, 3));
  EXPECT_EQ(digest_of(*aligned(std::make_shared<const LabelVolume>(moved), asked()).volume),
            "60bf5f68bcf18bee07a4dde4358dcb17d14d389980e9046a9fc72febbff4105e");
}

}  // namespace
}  // namespace voxtet
