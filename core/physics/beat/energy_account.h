// Where the work of a beating heart goes.
#pragma once

#include "physics/beat/heart_steps.h"
#include "types/result.h"

namespace voxtet::beat {

/// Work and energy since the first state, mJ. Work in a step is the mean of the forces at its ends times the
/// way between them.
struct EnergyBalance {
  double active = 0;  ///< done by the active stress
  double blood = 0;   ///< done by the blood on the wall: less than 0 over a beat
  double stored = 0;  ///< in muscle and springs
  double kinetic = 0;
  double viscous = 0;  ///< lost in the muscle
  double dampers = 0;  ///< lost in the dampers

  /// What is not accounted for: what Newmark's method damps, and what is lost by finite steps.
  double missing() const { return active + blood - stored - kinetic - viscous - dampers; }
};

/// Follows a heart from step to step.
class EnergyAccount {
 public:
  static Result<EnergyAccount> start(const Heart& heart, const HeartMotion& first);

  /// A step from the last state to this one. Returns the errors of Body::add_forces().
  Status add(const HeartMotion& motion);
  const EnergyBalance& balance() const { return balance_; }

 private:
  explicit EnergyAccount(const Heart& heart) : heart_(&heart) {}
  double kinetic(const HeartMotion& motion) const;
  Result<double> stored(const HeartMotion& motion) const;
  /// Force of the active stress on the nodes, mN.
  Result<Eigen::VectorXd> active(const HeartMotion& motion) const;

  const Heart* heart_;
  HeartMotion last_;
  Eigen::VectorXd last_active_;
  double first_stored_ = 0, first_kinetic_ = 0;
  EnergyBalance balance_;
};

}  // namespace voxtet::beat
