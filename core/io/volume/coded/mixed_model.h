// Predictions of several contexts, mixed to one. Logistic mixing, as in Mahoney, "Adaptive weighing of
// context models for lossless data compression" (2005). Only additions, multiplications, divisions and powers
// of two are used: the same predictions on every platform.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxtet {

/// ln(p / (1 - p)), and its inverse.
double stretch(double probability);
double squash(double stretched);

/// How probable a decision is in one context, by what was seen there.
struct ContextCounter {
  float probability = 0.5F;
  std::uint16_t seen = 0;

  /// `most_seen`: beyond so many the past is forgotten.
  void update(bool decision, std::uint16_t most_seen);
};

/// Mixes the predictions of contexts. Weights are learned apart for two kinds of situations, and for how much
/// is known; a last table corrects what mixing gets wrong.
class MixedModel {
 public:
  static constexpr std::size_t kContexts = 8;
  static constexpr std::array<std::size_t, 2> kSituations{64, 128};
  static constexpr std::size_t kTries = 8;
  static constexpr std::size_t kCorrections = 512;

  MixedModel();

  /// The probability that the decision is true. `contexts` are hashes; `situations`, `correction` and
  /// `attempt`, how many decisions there were for this voxel, are below the numbers above.
  double predict(const std::array<std::uint32_t, kContexts>& contexts,
                 const std::array<std::size_t, 2>& situations, std::size_t attempt, std::size_t correction);
  /// Learns from the decision that predict() was asked for.
  void update(bool decision);

 private:
  static constexpr std::size_t kInputs = 2 * kContexts + 1;
  static constexpr std::size_t kSlots = std::size_t{1} << 18U;
  static constexpr std::size_t kCurve = 33;  ///< of the correction: points from -8 to 8
  using Weights = std::array<double, kInputs>;

  std::vector<ContextCounter> counters_;
  std::array<std::vector<Weights>, 3> weights_;
  std::vector<double> curves_;
  std::array<ContextCounter*, kContexts> asked_{};
  std::array<double, kInputs> inputs_{};
  std::array<Weights*, 3> mixers_{};
  std::array<double, 3> mixed_{};
  std::size_t curve_at_ = 0;
  double curve_part_ = 0;
  double updates_ = 0;
};

}  // namespace voxtet
