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

  /// A time for each point, NaN where there is none.
  struct Beat {
    std::vector<float> activated_ms;
    std::vector<float> repolarised_ms;  ///< the first time after the activation
  };
  /// The first, second, ... activation of each of `points` points: as many beats as a point has at most, but
  /// at least one and no more than `most`.
  std::vector<Beat> beats(std::size_t points, std::size_t most) const;
  std::vector<float> last_activation(std::size_t points) const;
  std::vector<float> activation_counts(std::size_t points) const;

 private:
  std::vector<Crossing> activations_, repolarisations_;
};

}  // namespace voxtet
