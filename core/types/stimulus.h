// Where and when tissue is excited from outside.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "types/region.h"

namespace voxtet {

/// A current into the tissue of a region. It is given `count` times, `interval_ms` from start to start (S1),
/// then once `s2_ms` after the last of these, and once `s3_ms` after that.
struct Stimulus : Region {
  std::string name;
  double start_ms = 0;
  double duration_ms = 2;
  double strength_per_ms = 0.5;  ///< of the whole range of the membrane's voltage, each ms
  int count = 1;
  double interval_ms = 600;
  double s2_ms = 0, s3_ms = 0;  ///< 0: none
};

/// The times at which it starts, ascending, ms.
inline std::vector<double> start_times_ms(const Stimulus& stimulus) {
  std::vector<double> times;
  times.reserve(static_cast<std::size_t>(stimulus.count) + 2);
  for (int beat = 0; beat < stimulus.count; ++beat)
    times.push_back(stimulus.start_ms + beat * stimulus.interval_ms);
  for (const double interval : {stimulus.s2_ms, stimulus.s3_ms})
    if (interval > 0) times.push_back(times.back() + interval);
  return times;
}

}  // namespace voxtet
