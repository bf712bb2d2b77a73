// Smooth switches in time, as the benchmark of Arostica et al., CMAME 435 (2025), has them.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/portable_exp.h"

namespace voxtet::active {

/// (1 + tanh(x / width)) / 2; `width` > 0.
inline double switch_on(double x, double width) {
  return 1 / (1 + portable_exp(-2 * x / width));
}

/// The integral of switch_on from minus infinity: max(x, 0) where `width` is 0.
inline double switch_on_integral(double x, double width) {
  const double ramp = std::max(x, 0.0);
  return width > 0 ? ramp + width / 2 * portable_log(1 + portable_exp(-2 * std::abs(x) / width)) : ramp;
}

}  // namespace voxtet::active
