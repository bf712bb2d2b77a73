#include "io/volume/coded/mixed_model.h"

#include <algorithm>
#include <cmath>

namespace voxtet {
namespace {

constexpr double kLn2 = 0.69314718055994530942;
constexpr double kFirstWeight = 0.2, kFirstRate = 0.04, kLastRate = 0.004, kRateDecay = 0.0005;
constexpr double kMostStretched = 12, kCorrectionRate = 0.02;
constexpr std::uint16_t kMostSeen = 60;
constexpr float kSurest = 0.9999F;
/// A context that has shown one decision once is nearly sure of it: labels are smooth.
constexpr float kDoubt = 0.1F;

double natural_log(double x) {
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);
  if (mantissa < 0.70710678) {
    mantissa *= 2;
    --exponent;
  }
  const double t = (mantissa - 1) / (mantissa + 1), t2 = t * t;
  const double series =
      1 + t2 * (1 / 3.0 + t2 * (1 / 5.0 + t2 * (1 / 7.0 + t2 * (1 / 9.0 + t2 * (1 / 11.0)))));
  return 2 * t * series + exponent * kLn2;
}

double exponential(double x) {
  const double power = std::floor(x / kLn2 + 0.5);
  const double r = x - power * kLn2;
  double sum = 1;
  for (int n = 7; n > 0; --n) sum = 1 + r * sum / n;
  return std::ldexp(sum, static_cast<int>(power));
}

}  // namespace

double stretch(double probability) {
  return natural_log(probability / (1 - probability));
}

double squash(double stretched) {
  return 1 / (1 + exponential(-std::clamp(stretched, -40.0, 40.0)));
}

void ContextCounter::update(bool decision, std::uint16_t most_seen) {
  const float rate = 1 / (static_cast<float>(seen) + 1 + kDoubt);
  probability = std::clamp(probability + ((decision ? 1.F : 0.F) - probability) * rate, 1 - kSurest, kSurest);
  if (seen < most_seen) ++seen;
}

MixedModel::MixedModel() : counters_(kContexts * kSlots), curves_(kCorrections * kCurve) {
  Weights first{};
  std::fill(first.begin(), first.begin() + kContexts, kFirstWeight);
  weights_ = {std::vector<Weights>(kSituations[0], first), std::vector<Weights>(kSituations[1], first),
              std::vector<Weights>((kContexts + 1) * kTries, first)};
  for (std::size_t i = 0; i < curves_.size(); ++i)
    curves_[i] = squash((static_cast<double>(i % kCurve) - 16) / 2);
}

double MixedModel::predict(const std::array<std::uint32_t, kContexts>& contexts,
                           const std::array<std::size_t, 2>& situations, std::size_t attempt,
                           std::size_t correction) {
  std::size_t known = 0;
  for (std::size_t c = 0; c < kContexts; ++c) {
    const ContextCounter& counter = *(asked_[c] = &counters_[c * kSlots + contexts[c] % kSlots]);
    known += counter.seen > 2 ? 1 : 0;
    // What was never seen says nothing; what was seen often says more than its probability alone.
    const double p = counter.probability;
    inputs_[c] = counter.seen > 0 ? stretch(p) : 0;
    inputs_[kContexts + c] = counter.seen > 0 ? (p - 0.5) * std::min(3.0, 0.5 + 0.25 * counter.seen) : 0;
  }
  inputs_[kInputs - 1] = 0.4;
  const std::array<std::size_t, 3> sets{situations[0], situations[1], known * kTries + attempt};
  double sum = 0;
  for (std::size_t kind = 0; kind < mixers_.size(); ++kind) {
    const Weights& weights = *(mixers_[kind] = &weights_[kind][sets[kind]]);
    double dot = 0;
    for (std::size_t i = 0; i < kInputs; ++i) dot += weights[i] * inputs_[i];
    dot = std::clamp(dot, -kMostStretched, kMostStretched);
    mixed_[kind] = squash(dot);
    sum += dot;
  }
  const double stretched = sum / 3;
  const double place = 2 * (std::clamp(stretched, -7.999, 7.999) + 8);
  curve_at_ = correction * kCurve + static_cast<std::size_t>(place);
  curve_part_ = place - std::floor(place);
  const double corrected = curves_[curve_at_] * (1 - curve_part_) + curves_[curve_at_ + 1] * curve_part_;
  return (squash(stretched) + corrected) / 2;
}

void MixedModel::update(bool decision) {
  const double truth = decision ? 1 : 0;
  const double rate = kLastRate + kFirstRate / (1 + kRateDecay * updates_++);
  for (std::size_t kind = 0; kind < mixers_.size(); ++kind) {
    const double step = rate * (truth - mixed_[kind]);
    for (std::size_t i = 0; i < kInputs; ++i) (*mixers_[kind])[i] += step * inputs_[i];
  }
  curves_[curve_at_] += (truth - curves_[curve_at_]) * kCorrectionRate * (1 - curve_part_);
  curves_[curve_at_ + 1] += (truth - curves_[curve_at_ + 1]) * kCorrectionRate * curve_part_;
  for (ContextCounter* counter : asked_) counter->update(decision, kMostSeen);
}

}  // namespace voxtet
