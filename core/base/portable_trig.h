// Sine, cosine and arc tangent by additions, multiplications, divisions and square roots alone, so that they
// are the same bytes on every platform: the last bits of those of <cmath> differ between math libraries.
#pragma once

#include <array>
#include <cmath>

namespace voxtet {

/// The cosine and the sine of an angle from -pi to pi (radians), to 1e-15: Taylor's series of half the angle,
/// doubled.
inline std::array<double, 2> cos_sin(double angle) {
  const double x = angle / 2, x2 = x * x;
  // 1 - cos rather than cos, of which small angles would lose the digits.
  double versine = 0, sine = 0;
  for (int n = 24; n > 0; n -= 2) {
    versine = x2 / (n * (n - 1)) * (1 - versine);
    sine = x2 / (n * (n + 1)) * (1 - sine);
  }
  sine = x * (1 - sine);
  return {1 - 2 * sine * sine, 2 * sine * (1 - versine)};
}

/// The angle from 0 to pi / 2 (radians) with this tangent >= 0, to 1e-15: Taylor's series of an eighth
/// of the angle.
inline double arc_tangent(double tangent) {
  double x = tangent;
  for (int halving = 0; halving < 3; ++halving) x = x / (1 + std::sqrt(1 + x * x));
  double sum = 0;
  for (int n = 25; n > 0; n -= 2) sum = 1.0 / n - x * x * sum;
  return 8 * x * sum;
}

}  // namespace voxtet
