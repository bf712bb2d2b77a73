// What is measured while a heart beats.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "physics/beat/beat_params.h"
#include "physics/beat/heart_steps.h"
#include "physics/circulation/elastance_heart.h"
#include "types/field.h"

namespace voxtet::beat {

/// Volumes and pressures at each step, and what is read off each beat.
class BeatRecord {
 public:
  /// `start`: the first state. `states`: names of the circulation's.
  BeatRecord(const BeatParams& params, const std::vector<std::string_view>& states, const HeartMotion& start);

  /// The state after a step.
  void add(const HeartMotion& motion);

  /// Of each complete beat, each ventricle.
  const std::vector<std::vector<VentricleBeat>>& beats() const { return beats_; }
  /// The largest change of a volume from the end of the beat before to that of the last one, %; none before
  /// there are two.
  std::optional<double> change_percent() const { return change_percent_; }
  bool has_cycle() const { return change_percent_ && *change_percent_ <= cycle_percent_; }
  /// Whether no more beats are wanted.
  bool is_over() const { return has_cycle() || static_cast<int>(beats_.size()) == most_beats_; }

  const std::vector<double>& times_ms() const { return times_ms_; }
  /// Volumes (ml) and pressures (kPa) of the ventricles, and the circulation's states, at those times.
  const std::vector<Trace>& traces() const { return traces_; }

 private:
  void trace(const HeartMotion& motion);

  double period_ms_, cycle_percent_;
  int most_beats_;
  std::vector<std::vector<VentricleBeat>> beats_;
  std::vector<VentricleBeat> beat_;  ///< under way
  HeartMotion last_;
  Eigen::VectorXd ml_at_beat_;  ///< volumes at the end of the last beat; empty before
  std::optional<double> change_percent_;
  std::vector<double> times_ms_;
  std::vector<Trace> traces_;
};

}  // namespace voxtet::beat
