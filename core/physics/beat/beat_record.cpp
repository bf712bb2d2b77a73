#include "physics/beat/beat_record.h"

#include <algorithm>
#include <cmath>
#include <string>

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

BeatRecord::BeatRecord(const BeatParams& params, const std::vector<std::string_view>& states,
                       const HeartMotion& start)
    : period_ms_(params.period_ms),
      cycle_percent_(params.cycle_percent),
      most_beats_(params.beats),
      last_(start) {
  const char* const names[] = {"lv", "rv"};
  const char* const titles[] = {"Left ventricle", "Right ventricle"};
  for (Eigen::Index c = 0; c < start.cavity_ml.size(); ++c)
    traces_.push_back({std::string(names[c]) + "_volume", std::string(titles[c]) + ", volume", "ml", {}});
  for (Eigen::Index c = 0; c < start.cavity_kpa.size(); ++c)
    traces_.push_back(
        {std::string(names[c]) + "_pressure", std::string(titles[c]) + ", pressure", "kPa", {}});
  for (const std::string_view state : states)
    traces_.push_back({std::string(state), title_of(state), unit_of(state), {}});
  trace(start);
}

void BeatRecord::trace(const HeartMotion& motion) {
  times_ms_.push_back(1000 * motion.time_s);
  std::size_t next = 0;
  for (const Eigen::VectorXd* values : {&motion.cavity_ml, &motion.cavity_kpa, &motion.circulation})
    for (const double value : *values) traces_[next++].values.push_back(static_cast<float>(value));
}

void BeatRecord::add(const HeartMotion& motion) {
  trace(motion);
  if (motion.time_s > 0) {
    if (beat_.empty())
      for (Eigen::Index c = 0; c < motion.cavity_ml.size(); ++c)
        beat_.push_back({last_.cavity_ml[c], last_.cavity_ml[c], last_.cavity_kpa[c], 0});
    for (std::size_t c = 0; c < beat_.size(); ++c) {
      const auto i = static_cast<Eigen::Index>(c);
      VentricleBeat& beat = beat_[c];
      beat.most_ml = std::max(beat.most_ml, motion.cavity_ml[i]);
      beat.least_ml = std::min(beat.least_ml, motion.cavity_ml[i]);
      beat.most_kpa = std::max(beat.most_kpa, motion.cavity_kpa[i]);
      // kPa ml = mJ.
      beat.stroke_work_j += (motion.cavity_kpa[i] + last_.cavity_kpa[i]) / 2 *
                            (last_.cavity_ml[i] - motion.cavity_ml[i]) / 1000;
    }
    if (1000 * motion.time_s >= period_ms_ * static_cast<double>(beats_.size() + 1) - kRounding) {
      beats_.push_back(std::move(beat_));
      beat_.clear();
      if (ml_at_beat_.size() > 0)
        change_percent_ =
            100 * ((motion.cavity_ml - ml_at_beat_).array() / ml_at_beat_.array()).abs().maxCoeff();
      ml_at_beat_ = motion.cavity_ml;
    }
  }
  last_ = motion;
}

}  // namespace voxtet::beat
