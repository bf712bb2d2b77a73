// Frames of values at points -> an .igb file, as openCARP writes and meshalyzer shows it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/bytes/bytes.h"

namespace voxtet {

/// Collects frames as they come: floats, little-endian, at equal intervals (igb_header.h).
class IgbWriter {
 public:
  /// `elsewhere` is written for points without a value (NaN), for which the format has no sign.
  IgbWriter(std::size_t points, std::string unit, double first_ms, double interval_ms, float elsewhere);

  /// The time of the frame that add() takes next.
  double next_ms() const { return first_ms_ + static_cast<double>(frames_) * interval_ms_; }
  std::size_t frames() const { return frames_; }
  void add(const std::vector<float>& values);  ///< one for each point
  /// The whole file. Needs a frame.
  Bytes take();

 private:
  std::size_t points_, frames_ = 0;
  std::string unit_;
  double first_ms_, interval_ms_;
  float elsewhere_;
  Bytes bytes_;
};

}  // namespace voxtet
