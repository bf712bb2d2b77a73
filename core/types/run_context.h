// What a stage may ask of its caller while it runs: progress, cancellation, warnings, notes. No stage prints.
#pragma once

#include <algorithm>
#include <functional>
#include <string>

#include "types/field.h"
#include "types/result.h"

namespace voxtet {

/// Whether this thread was started by a stage (base/parallel.h). Such threads never call back.
inline thread_local bool is_helper_thread = false;

/// Passed by reference into every stage. All callbacks are optional and are called on the stage's own thread.
struct RunContext {
  std::function<void(const std::string& stage, double fraction)> on_progress;  ///< fraction in [0, 1]
  std::function<bool()> on_cancelled;                                          ///< true: stop soon
  std::function<void(const std::string& stage, const std::string& message)> on_warning;
  /// What a reader of the report should know although nothing is wrong: which method or fallback was used,
  /// what was removed because the recipe asks for it.
  std::function<void(const std::string& stage, const std::string& message)> on_note;
  std::function<void(const Snapshot&)> on_snapshot;  ///< a frame of a result that changes with time
  int threads = 1;  ///< how many a stage may use (base/parallel.h); the number never changes its result

  void progress(const std::string& stage, double fraction) const {
    if (on_progress && !is_helper_thread) on_progress(stage, fraction);
  }
  bool cancelled() const { return on_cancelled && !is_helper_thread && on_cancelled(); }
  void warn(const std::string& stage, const std::string& message) const {
    if (on_warning) on_warning(stage, message);
  }
  void snapshot(const Snapshot& frame) const {
    if (on_snapshot) on_snapshot(frame);
  }
  void note(const std::string& stage, const std::string& message) const {
    if (on_note) on_note(stage, message);
  }

  /// A context for one part of the stage, with the same callbacks. Fractions from 0 to 1 that are told to it
  /// arrive at the caller as `from` to `to`, and never decrease.
  RunContext part(double from, double to) const {
    RunContext out = *this;
    if (on_progress)
      out.on_progress = [tell = on_progress, from, to, highest = 0.0](const std::string& stage,
                                                                      double fraction) mutable {
        highest = std::max(highest, fraction);
        tell(stage, from + highest * (to - from));
      };
    return out;
  }
};

/// The error every stage returns when `ctx.cancelled()` turned true.
inline Error cancelled_error(const std::string& stage) {
  return {ErrorCode::kCancelled, stage, "cancelled", {}};
}

}  // namespace voxtet
