// When each point was activated, and when it was repolarised.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "physics/fem/fixed_order.h"

namespace voxtet {

/// Crossings of v = kActivated upwards and of v = kRepolarised downwards, at times interpolated linearly
/// within a step. Point numbers are those of the vectors given to record().
class ActivationLog {
 public:
  static constexpr double kActivated = 0.5, kRepolarised = 0.1;

  struct Crossing {
    std::uint32_t point;
    float time_ms;
  };

  ActivationLog() = default;
  /// With what was recorded before, in the order of its steps.
  ActivationLog(std::vector<Crossing> activations, std::vector<Crossing> repolarisations)
      : activations_(std::move(activations)), repolarisations_(std::move(repolarisations)) {}

  /// The step from `begin_ms`, over which v went from `before` to `after`, in these rows and nowhere else.
  /// Call in the order of time.
  void record(double begin_ms, double step_ms, const Eigen::VectorXd& before, const Eigen::VectorXd& after,
              const fem::RowRanges& rows);

  const std::vector<Crossing>& activations() const { return activations_; }  ///< in the order of their steps
  const std::vector<Crossing>& repolarisations() const { return repolarisations_; }

  /// The k-th activation of each of `points` points, from 0; NaN where there are fewer.
  std::vector<float> activation(std::size_t points, int k) const;
  std::vector<float> last_activation(std::size_t points) const;
  std::vector<float> activation_counts(std::size_t points) const;
  /// The first repolarisation after the k-th activation.
  std::vector<float> repolarisation(std::size_t points, int k) const;

 private:
  std::vector<Crossing> activations_, repolarisations_;
};

}  // namespace voxtet
