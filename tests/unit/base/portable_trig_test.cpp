#include "base/portable_trig.h"

#include <gtest/gtest.h>

#include <cmath>

namespace voxtet {
namespace {

TEST(PortableTrig, CosineAndSineAreThoseOfTheMathLibrary) {
  for (int i = -1000; i <= 1000; ++i) {
    const double angle = i * std::acos(-1) / 1000;
    const auto [cosine, sine] = cos_sin(angle);
    EXPECT_NEAR(cosine, std::cos(angle), 1e-15) << angle;
    EXPECT_NEAR(sine, std::sin(angle), 1e-15) << angle;
  }
  EXPECT_DOUBLE_EQ(cos_sin(1e-9)[1], 1e-9);
}

TEST(PortableTrig, ArcTangentIsThatOfTheMathLibrary) {
  for (const double tangent : {0.0, 1e-12, 0.1, 0.3, 0.577, 1.0, 2.0, 5.0, 1e6})
    EXPECT_NEAR(arc_tangent(tangent), std::atan(tangent), 1e-15) << tangent;
}

}  // namespace
}  // namespace voxtet
