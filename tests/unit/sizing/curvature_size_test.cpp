#include "sizing/curvature_size.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/label_bodies.h"
#include "support/label_surface.h"

namespace voxtet {
namespace {

constexpr double kRadius = 12, kMiddle = 17.5;

/// A ball of label 1 and, beside it, a smaller one of label 2.
LabelVolume two_balls() {
  return test::make_volume(36, 36, 64, [](int i, int j, int k) {
    const auto in_ball = [&](double z, double radius) {
      return std::hypot(i - kMiddle, j - kMiddle, k - z) <= radius;
    };
    return in_ball(kMiddle, kRadius) ? 1 : in_ball(48, 6) ? 2 : 0;
  });
}

Result<SizingField> build_with_curvature(const LabelVolume& volume, const SizingParams& params) {
  const SurfaceMesh surface = test::label_surface(volume);
  RunContext ctx;
  return build_sizing_field(volume, params, ctx, {{}, {}, {}, &surface});
}

/// Sizes at the points of a label's surface.
std::vector<double> at_surface(const LabelVolume& volume, const SizingField& field, Label label) {
  const SurfaceMesh surface = test::label_surface(volume);
  std::vector<double> sizes;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (surface.sides[t][0] == label) sizes.push_back(field.at(surface.points[surface.triangles[t][0]]));
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

TEST(CurvatureSize, GivesABallSoManyEdgesATurn) {
  SizingParams params;
  params.edge_mm = 10;
  params.curvature = {{{}, 24, 0.1}};
  const LabelVolume volume = two_balls();
  const Result<SizingField> field = build_with_curvature(volume, params);
  ASSERT_TRUE(field.ok()) << field.error().message;
  for (const auto& [label, radius] : {std::pair<Label, double>{1, kRadius}, {2, 6}}) {
    const std::vector<double> sizes = at_surface(volume, *field, label);
    const double target = 2 * EIGEN_PI * radius / 24;
    EXPECT_NEAR(sizes[sizes.size() / 2], target, 0.06 * target);
    EXPECT_GT(sizes[sizes.size() / 20], 0.85 * target);
    EXPECT_LT(sizes[sizes.size() * 19 / 20], 1.15 * target);
  }
  // Beyond the surface sizes rise as the gradation lets them, from the smallest around.
  const double at_middle = 2 * EIGEN_PI * kRadius / 24 + params.gradation * kRadius;
  EXPECT_GT(field->at({kMiddle, kMiddle, kMiddle}), 0.8 * at_middle);
  EXPECT_LT(field->at({kMiddle, kMiddle, kMiddle}), at_middle);
}

TEST(CurvatureSize, CountsTheLabelsNamedAlone) {
  SizingParams params;
  params.edge_mm = 6;
  params.curvature = {{{2}, 24, 0.1}};
  const LabelVolume volume = two_balls();
  const Result<SizingField> field = build_with_curvature(volume, params);
  ASSERT_TRUE(field.ok()) << field.error().message;
  EXPECT_GE(field->at({kMiddle, kMiddle, kMiddle - kRadius}), 6);
  EXPECT_LT(field->at({kMiddle, kMiddle, 48 - 6}), 2);
}

TEST(CurvatureSize, AsksForNothingBelowItsOwnMinimumNorAboveOtherRules) {
  SizingParams params;
  params.edge_mm = 2;
  params.curvature = {{{}, 1000, 1.25}};
  const LabelVolume volume = two_balls();
  const Result<SizingField> field = build_with_curvature(volume, params);
  ASSERT_TRUE(field.ok()) << field.error().message;
  EXPECT_EQ(*std::min_element(field->h_mm.begin(), field->h_mm.end()), 1.25F);
  EXPECT_LE(field->at({kMiddle, kMiddle, kMiddle}), 2);
}

TEST(CurvatureSize, NamesTheFieldThatIsWrong) {
  const LabelVolume volume = two_balls();
  const auto message_of = [&](const CurvatureSize& rule) {
    SizingParams params;
    params.curvature = {{}, rule};
    const Result<SizingField> field = build_with_curvature(volume, params);
    return field ? std::string() : field.error().message;
  };
  EXPECT_EQ(message_of({{3}, 20, 1}),
            "sizing.curvature[1].labels[0]: found 3, but the labels of the volume are 1, 2");
  EXPECT_EQ(message_of({{}, 2, 1}),
            "sizing.curvature[1].edges_per_turn: found 2, expected a number of at least 3");
  EXPECT_EQ(message_of({{}, 20, -1}),
            "sizing.curvature[1].edge_min_mm: found -1, expected a finite length > 0 mm");
}

}  // namespace
}  // namespace voxtet
