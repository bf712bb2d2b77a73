// Steps in time of equal length, and which of them are frames to show.
#pragma once

#include <algorithm>
#include <cmath>

namespace voxtet::fem {

/// From 0 to `end_ms` in steps of `step_ms`, shortened if needed so that their number is whole. A frame is
/// due at 0, at the first step that reaches each multiple of `frame_ms`, and at the end.
class TimeSteps {
 public:
  TimeSteps() = default;
  TimeSteps(double end_ms, double step_ms, double frame_ms)
      : count_(std::max(1, static_cast<int>(std::ceil(end_ms / step_ms * (1 - kRounding))))),
        step_ms_(end_ms / count_),
        frame_ms_(frame_ms) {}

  bool done() const { return step_ == count_; }
  void next() { ++step_; }
  int step() const { return step_; }
  int count() const { return count_; }
  void go_to(int step) { step_ = step; }
  double fraction() const { return static_cast<double>(step_) / count_; }
  double time_ms() const { return step_ms_ * step_; }
  double step_ms() const { return step_ms_; }
  bool frame_due() const { return step_ == 0 || done() || frames_by(step_) > frames_by(step_ - 1); }

 private:
  /// Room for the rounding of a ratio of two times that should be a whole number.
  static constexpr double kRounding = 1e-9;
  double frames_by(int step) const { return std::floor(step_ms_ * step / frame_ms_ + kRounding); }

  int step_ = 0, count_ = 1;
  double step_ms_ = 0, frame_ms_ = 1;
};

}  // namespace voxtet::fem
