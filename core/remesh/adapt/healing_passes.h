// Operations that are tried, then repaired if they leave poor angles, and taken back if the repair fails.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "remesh/adapt/adapt_passes.h"

namespace voxtet::remesh {

/// What an operation may do. kNone: it keeps the angles. kAngles: it may leave poorer angles if these can be
/// opened again. kPoints: points may be added for that.
enum class Healing : std::uint8_t { kNone, kAngles, kPoints };
inline constexpr std::array<Healing, 3> kHealings{Healing::kNone, Healing::kAngles, Healing::kPoints};

class HealingPasses : public AdaptPasses {
 public:
  using AdaptPasses::AdaptPasses;

 protected:
  /// Does the operation and checks what is demanded after it; takes it back if this does not hold. Returns
  /// whether it was done. Where points may be added, facets need not stay Delaunay.
  template <class Operation, class Demanded>
  bool attempt(Operation&& operation, Demanded&& demanded, Healing healing);

  static constexpr double kTrialAngleDeg = 14;  ///< below this an angle is not worth opening again
  const double trial_cosine_ = cosine_of_deg(kTrialAngleDeg);

 private:
  template <class Operation, class Demanded>
  bool tried(Operation&& operation, Demanded&& demanded);
  bool heal(double limit_cosine, int most_splits);
  bool split_ahead_of(std::uint32_t t);

  static constexpr int kHealingSplits = 12;
};

template <class Operation, class Demanded>
bool HealingPasses::tried(Operation&& operation, Demanded&& demanded) {
  editor_.begin_trial();
  const bool good = operation() && demanded();
  if (good)
    editor_.keep_trial();
  else
    editor_.undo_trial();
  return good;
}

template <class Operation, class Demanded>
bool HealingPasses::attempt(Operation&& operation, Demanded&& demanded, Healing healing) {
  if (healing == Healing::kNone) return tried(operation, demanded);
  const EditLimits strict = editor_.limits;
  const int most_splits = healing == Healing::kPoints ? kHealingSplits : 0;
  editor_.limits.angle_cosine = std::max(strict.angle_cosine, trial_cosine_);
  if (most_splits > 0) editor_.limits.keeps_delaunay = false;
  const bool good = tried(operation, [&] { return heal(strict.angle_cosine, most_splits) && demanded(); });
  editor_.limits = strict;
  return good;
}

}  // namespace voxtet::remesh
