// Exponential and logarithm by additions, multiplications and divisions alone, so that they are the same
// bytes on every platform: the last bits of those of <cmath> differ between math libraries.
#pragma once

#include <algorithm>
#include <cmath>

namespace voxtet {

inline constexpr double kLn2 = 0.693147180559945309417232121458;

/// e^x to some 2e-16 of its value: Taylor's series of what is left of x beside a multiple of ln 2. Infinity
/// above 709.8, 0 below -745.2, NaN of NaN.
inline double portable_exp(double x) {
  if (std::isnan(x)) return x;
  // ln 2 in two parts, of which the first has few bits: its multiples are exact.
  constexpr double kHigh = 6.93147180369123816490e-01, kLow = 1.90821492927058770002e-10;
  constexpr double kLeast = -760, kMost = 720;
  x = std::clamp(x, kLeast, kMost);
  const double multiple = std::floor(x / kLn2 + 0.5);
  const double rest = (x - multiple * kHigh) - multiple * kLow;
  double sum = 1;
  for (int n = 14; n > 0; --n) sum = 1 + rest / n * sum;
  return std::ldexp(sum, static_cast<int>(multiple));
}

/// The natural logarithm of a number > 0, to some 2e-16 of itself, or of ln 2 for one far from 1: the series
/// of the inverse hyperbolic tangent.
inline double portable_log(double x) {
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);
  if (mantissa < 0.70710678118654752) {
    mantissa *= 2;
    --exponent;
  }
  const double t = (mantissa - 1) / (mantissa + 1), t2 = t * t;
  double sum = 0;
  for (int n = 25; n > 0; n -= 2) sum = 1.0 / n + t2 * sum;
  return exponent * kLn2 + 2 * t * sum;
}

}  // namespace voxtet
