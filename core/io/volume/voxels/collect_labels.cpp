#include "io/volume/voxels/collect_labels.h"

#include <algorithm>
#include <cmath>

#include "io/bytes/header_text.h"

namespace voxtet {
namespace {

constexpr std::int64_t kLargestLabel = 65535;
constexpr std::size_t kMostValues = std::size_t{1} << 16;
constexpr double kLargestWhole = 9007199254740992.0;  // 2^53
constexpr std::size_t kMostListed = 50;

/// How far a value may be from a whole number.
double tolerance_of(const VoxelLayout& layout) {
  if (!layout.whole()) return 1e-3;
  return layout.scaled() ? std::min(std::abs(layout.slope) / 2, 0.05) : 0;
}

}  // namespace

LabelCollector::LabelCollector(const VoxelLayout& layout, Reading& reading,
                               std::optional<std::int64_t> picked)
    : layout_(layout),
      reading_(reading),
      picked_(picked),
      tolerance_(tolerance_of(layout)),
      code_of_small_(kMostValues, -1) {}

void LabelCollector::expect(std::uint64_t count) {
  if (picked_) count /= static_cast<std::uint64_t>(layout_.layers * layout_.frames);
  const std::size_t needed = codes_.size() + static_cast<std::size_t>(count);
  if (needed > codes_.capacity()) codes_.reserve(std::max(needed, 2 * codes_.capacity()));
}

bool LabelCollector::whole_number(double value, std::int64_t& whole) {
  if (!(value >= -kLargestWhole && value <= kLargestWhole)) return false;  // NaN too
  whole = static_cast<std::int64_t>(value);
  if (static_cast<double>(whole) == value) return true;
  const double nearest = std::floor(value + 0.5);
  const double distance = std::abs(value - nearest);
  whole = static_cast<std::int64_t>(nearest);
  // A slope is stored in single precision: what that changes is no rounding.
  if (layout_.scaled() && distance <= 1e-6 * (1 + std::abs(value))) return true;
  if (distance > tolerance_) return false;
  if (distance > farthest_) {
    farthest_ = distance;
    rounded_ = value;
  }
  return true;
}

Result<Label> LabelCollector::code_of(double number, std::uint64_t index) {
  std::int64_t value = 0;
  if (!whole_number(number, value)) return no_label(index, number);
  const bool small = value >= 0 && value <= kLargestLabel;
  if (small) {
    const std::int32_t known = code_of_small_[static_cast<std::size_t>(value)];
    if (known >= 0) return static_cast<Label>(known);
  } else if (const auto known = code_of_large_.find(value); known != code_of_large_.end()) {
    return known->second;
  }
  if (found_.size() == kMostValues)
    return bad_input(layout_.stage,
                     "the voxels have more than 65536 different values: an image, not labels? expected "
                     "labels, whole numbers from 0 to 65535");
  const auto code = static_cast<Label>(found_.size());
  found_.push_back({value, index});
  if (small)
    code_of_small_[static_cast<std::size_t>(value)] = code;
  else
    code_of_large_[value] = code;
  return code;
}

Status LabelCollector::take(std::span<const double> values) {
  for (const double value : values) {
    const std::uint64_t index = seen_++;
    if (picked_ && layout_.frame_of(index) != static_cast<std::uint64_t>(*picked_)) continue;
    // Most voxels are like the one before.
    if (value != last_value_ || found_.empty()) {
      const Result<Label> code = code_of(value, index);
      if (!code) return code.error();
      last_value_ = value;
      last_code_ = *code;
    }
    codes_.push_back(last_code_);
  }
  return std::monostate{};
}

Error LabelCollector::no_label(std::uint64_t index, double value) const {
  std::string remedy;
  if (value != std::floor(value))
    remedy = layout_.scaled()
                 ? ": if they are labels, round them and save them without scl_slope"
                 : ": an image, not labels? if they are labels, round them and save them as whole numbers; "
                   "--threshold LOWER,UPPER (source.threshold) takes values as one label";
  return bad_input(layout_.stage, voxel_name(layout_, index) + " has the value " + number_text(value) +
                                      "; expected labels, whole numbers from 0 to 65535" + remedy);
}

Status LabelCollector::check_negatives() const {
  const Found* first = nullptr;
  std::size_t count = 0;
  for (const Found& found : found_) {
    if (found.value >= 0 || found.value == reading_.options.background) continue;
    if (first == nullptr) first = &found;
    ++count;
  }
  if (first == nullptr) return std::monostate{};
  const std::string value = std::to_string(first->value);
  return bad_input(
      layout_.stage,
      voxel_name(layout_, first->first) + " has the value " + value +
          "; expected labels, whole numbers from 0 to 65535" +
          (count == 1 ? ": if " + value + " is the background, say it with --background " + value +
                            " (source.background)"
                      : ": there are " + std::to_string(count) + " values below 0: an image, not labels?"));
}

Result<std::vector<Label>> LabelCollector::labels_of_codes() {
  const std::int64_t background = reading_.options.background;
  std::vector<Label> label_of(found_.size(), kBackground);
  std::vector<std::size_t> moved;  // codes of the values that cannot stay
  std::vector<bool> taken(kMostValues, false);
  std::int64_t largest = 0;
  for (std::size_t code = 0; code < found_.size(); ++code) {
    const std::int64_t value = found_[code].value;
    if (value == background) continue;
    if (value < 1 || value > kLargestLabel) {
      moved.push_back(code);
      continue;
    }
    label_of[code] = static_cast<Label>(value);
    taken[static_cast<std::size_t>(value)] = true;
    largest = std::max(largest, value);
  }
  std::sort(moved.begin(), moved.end(),
            [&](std::size_t a, std::size_t b) { return found_[a].value < found_[b].value; });
  std::string list;
  std::int64_t next = largest;
  for (std::size_t n = 0; n < moved.size(); ++n) {
    if (found_.size() > static_cast<std::size_t>(kLargestLabel))
      return bad_input(layout_.stage, "the voxels have 65536 different values: an image, not labels?");
    do next = next % kLargestLabel + 1;
    while (taken[static_cast<std::size_t>(next)]);
    taken[static_cast<std::size_t>(next)] = true;
    label_of[moved[n]] = static_cast<Label>(next);
    if (n < kMostListed)
      list += (n == 0 ? "" : ", ") + std::to_string(found_[moved[n]].value) + " -> " + std::to_string(next);
  }
  if (!moved.empty())
    reading_.warn(
        "values that are no labels from 1 to 65535 take free numbers, in ascending order: " + list +
        (moved.size() > kMostListed ? " and " + std::to_string(moved.size() - kMostListed) + " more" : ""));
  for (Label& code : codes_) code = label_of[code];
  return std::move(codes_);
}

void LabelCollector::say_rounded() {
  if (farthest_ == 0) return;
  reading_.warn((layout_.scaled() ? "scl_slope " + number_text(layout_.slope) + " stores labels as "
                                  : std::string("labels are stored as ")) +
                number_text(rounded_) + " and the like: rounded to whole numbers");
}

Result<std::vector<Label>> LabelCollector::finish() {
  if (Status good = check_negatives(); !good) return good.error();
  const std::int64_t background = reading_.options.background;
  if (background != 0 && std::none_of(found_.begin(), found_.end(),
                                      [&](const Found& found) { return found.value == background; }))
    reading_.warn("source.background is " + std::to_string(background) + ", a value that no voxel has");
  say_rounded();
  return labels_of_codes();
}

}  // namespace voxtet
