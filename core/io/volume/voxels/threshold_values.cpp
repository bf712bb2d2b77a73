#include "io/volume/voxels/threshold_values.h"

#include <algorithm>

#include "io/bytes/header_text.h"

namespace voxtet {

void ThresholdCollector::expect(std::uint64_t count) {
  if (frame_) count /= static_cast<std::uint64_t>(layout_.layers * layout_.frames);
  labels_.reserve(std::max(labels_.capacity(), labels_.size() + static_cast<std::size_t>(count)));
}

Status ThresholdCollector::take(std::span<const double> values) {
  for (const double value : values) {
    const std::uint64_t index = seen_++;
    if (frame_ && layout_.frame_of(index) != static_cast<std::uint64_t>(*frame_)) continue;
    smallest_ = std::min(value, smallest_);  // a value that is no number changes neither
    largest_ = std::max(value, largest_);
    const bool within = value >= threshold_.lower && value <= threshold_.upper;
    any_ = any_ || within;
    labels_.push_back(within ? 1 : kBackground);
  }
  return std::monostate{};
}

Result<std::vector<Label>> ThresholdCollector::finish() {
  if (!any_)
    return bad_input(layout_.stage, "no voxel has a value from " + number_text(threshold_.lower) + " to " +
                                        number_text(threshold_.upper) +
                                        " (source.threshold): the values go from " + number_text(smallest_) +
                                        " to " + number_text(largest_));
  return std::move(labels_);
}

}  // namespace voxtet
