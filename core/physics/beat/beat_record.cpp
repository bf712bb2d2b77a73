#include "physics/beat/beat_record.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace voxtet::beat {
namespace {

constexpr double kRounding = 1e-6;  ///< ms

std::string title_of(std::string_view name) {
  std::string title(name);
  std::replace(title.begin(), title.end(), '_', ' ');
  if (!title.empty() && title[0] >= 'a' && title[0] <= 'z')
    title[0] = static_cast<char>(title[0] - 'a' + 'A');
  return title;
}

std::string unit_of(std::string_view state) {
  if (state.ends_with("flow")) return "ml/s";
  return state.ends_with("atrium") ? "ml" : "kPa";
}

}  // namespace

std::optional<double> BeatMeasures::change_percent() const {
  if (ml_before.empty()) return std::nullopt;
  double most = 0;
  for (std::size_t c = 0; c < ml_before.size(); ++c)
    most = std::max(most, 100 * std::abs(ml_at_end[c] / ml_before[c] - 1));
  return most;
}

BeatRecord::BeatRecord(const BeatParams& params, const std::vector<std::string_view>& states,
                       const HeartMotion& start)
    : period_ms_(params.period_ms), cycle_percent_(params.cycle_percent), most_beats_(params.beats) {
  const char* const names[] = {"lv", "rv"};
  const char* const titles[] = {"Left ventricle", "Right ventricle"};
  std::vector<Trace>& traces = measures_.traces;
  for (Eigen::Index c = 0; c < start.cavity_ml.size(); ++c)
    traces.push_back({std::string(names[c]) + "_volume", std::string(titles[c]) + ", volume", "ml", {}});
  for (Eigen::Index c = 0; c < start.cavity_kpa.size(); ++c)
    traces.push_back({std::string(names[c]) + "_pressure", std::string(titles[c]) + ", pressure", "kPa", {}});
  for (const std::string_view state : states)
    traces.push_back({std::string(state), title_of(state), unit_of(state), {}});
  trace(start);
}

void BeatRecord::trace(const HeartMotion& motion) {
  measures_.times_ms.push_back(1000 * motion.time_s);
  std::size_t next = 0;
  for (const Eigen::VectorXd* values : {&motion.cavity_ml, &motion.cavity_kpa, &motion.circulation})
    for (const double value : *values) measures_.traces[next++].values.push_back(static_cast<float>(value));
}

void BeatRecord::restore(BeatMeasures measures, std::vector<VentricleBeat> under_way) {
  measures_ = std::move(measures);
  beat_ = std::move(under_way);
}

bool BeatRecord::has_cycle() const {
  const std::optional<double> change = measures_.change_percent();
  return cycle_percent_ > 0 && change && *change <= cycle_percent_;
}

void BeatRecord::add(const HeartMotion& before, const HeartMotion& motion) {
  trace(motion);
  if (motion.time_s <= 0) return;
  if (beat_.empty())
    for (Eigen::Index c = 0; c < motion.cavity_ml.size(); ++c)
      beat_.push_back(VentricleBeat::from(before.cavity_ml[c], before.cavity_kpa[c]));
  for (std::size_t c = 0; c < beat_.size(); ++c) {
    const auto i = static_cast<Eigen::Index>(c);
    beat_[c].add(before.cavity_ml[i], before.cavity_kpa[i], motion.cavity_ml[i], motion.cavity_kpa[i]);
  }
  const double end_ms = period_ms_ * static_cast<double>(measures_.beats.size() + 1);
  if (1000 * motion.time_s < end_ms - kRounding) return;
  measures_.beats.push_back(std::move(beat_));
  beat_.clear();
  measures_.ml_before = std::move(measures_.ml_at_end);
  measures_.ml_at_end.assign(motion.cavity_ml.begin(), motion.cavity_ml.end());
}

}  // namespace voxtet::beat
