// What is measured while a heart beats.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "physics/beat/beat_params.h"
#include "physics/beat/heart_steps.h"
#include "physics/circulation/ventricle_beat.h"
#include "types/field.h"

namespace voxtet::beat {

/// Volumes and pressures at each step, and what is read off each beat.
struct BeatMeasures {
  std::vector<double> times_ms;
  /// Volumes (ml) and pressures (kPa) of the ventricles, and the circulation's states, at those times.
  std::vector<Trace> traces;
  std::vector<std::vector<VentricleBeat>> beats;  ///< of each complete beat, each ventricle
  /// Volumes at the end of the last beat, ml, and of the one before; empty before there are any.
  std::vector<double> ml_at_end, ml_before;

  /// The largest change of a volume from the end of a beat to that of the next, %; none before there are two.
  std::optional<double> change_percent() const;
};

/// Takes them while a heart beats.
class BeatRecord {
 public:
  /// `start`: the first state. `states`: names of the circulation's.
  BeatRecord(const BeatParams& params, const std::vector<std::string_view>& states, const HeartMotion& start);

  /// After a step from one state to another.
  void add(const HeartMotion& before, const HeartMotion& motion);

  const BeatMeasures& measures() const { return measures_; }
  /// Of a run that goes on from another one.
  void restore(BeatMeasures measures, std::vector<VentricleBeat> under_way);
  const std::vector<VentricleBeat>& under_way() const { return beat_; }

  bool has_cycle() const;
  /// Whether no more beats are wanted.
  bool is_over() const { return has_cycle() || static_cast<int>(measures_.beats.size()) == most_beats_; }

 private:
  void trace(const HeartMotion& motion);

  double period_ms_, cycle_percent_;
  int most_beats_;
  BeatMeasures measures_;
  std::vector<VentricleBeat> beat_;  ///< under way
};

}  // namespace voxtet::beat
