#include "io/volume/voxels/merge_frames.h"

#include <algorithm>
#include <string>

#include "io/volume/voxels/collect_labels.h"
#include "io/volume/voxels/threshold_values.h"

namespace voxtet {
namespace {

constexpr float kRounding = 0.02F;  ///< what a sum may be off by, with maps in half precision
constexpr std::int64_t kMostMaps = 65535;

/// Finds the largest value of each voxel over all frames.
class FrameMerger : public ValueSink {
 public:
  explicit FrameMerger(const VoxelLayout& layout) : layout_(layout), used_(count(), false) {}

  void expect(std::uint64_t) override {
    if (!best_.empty()) return;
    const auto voxels = static_cast<std::size_t>(layout_.voxel_count());
    best_.assign(voxels, 0);
    sum_.assign(voxels, 0);
    which_.assign(voxels, kBackground);
  }

  Status take(std::span<const double> values) override {
    for (const double value : values) {
      add(static_cast<float>(value));
      if (layout_.layers > 1 ? ++frame_ == count() : ++voxel_ == best_.size()) {
        layout_.layers > 1 ? (frame_ = 0, ++voxel_) : (voxel_ = 0, ++frame_);
      }
    }
    return std::monostate{};
  }

  /// Whether the values were those of maps.
  bool are_maps() const {
    const float largest_sum = *std::max_element(sum_.begin(), sum_.end());
    return maps_ && whole_value() > 0 && largest_sum <= (1 + kRounding) * whole_value() &&
           std::count(used_.begin(), used_.end(), true) > 1;
  }

  std::vector<Label> labels(Reading& reading) {
    const float whole = whole_value();
    const bool complete =
        std::all_of(sum_.begin(), sum_.end(), [&](float sum) { return sum >= (1 - kRounding) * whole; });
    for (std::size_t v = 0; v < which_.size(); ++v) {
      if (complete)
        which_[v] = static_cast<Label>(which_[v] - 1);
      else if (!(best_[v] > whole - sum_[v]))
        which_[v] = kBackground;
    }
    reading.note(layout_.frames_said +
                 ": one-hot or probability maps, of which each voxel takes the largest; " +
                 (complete ? "frame 0 is the background, frame n the label n"
                           : "frame n is the label n + 1, counted from 0"));
    return std::move(which_);
  }

 private:
  std::size_t count() const { return static_cast<std::size_t>(layout_.layers * layout_.frames); }

  void add(float value) {
    if (!(value >= 0)) maps_ = false;  // NaN too
    if (!maps_ || value == 0) return;
    used_[frame_] = true;
    sum_[voxel_] += value;
    largest_ = std::max(largest_, value);
    if (value <= best_[voxel_]) return;
    best_[voxel_] = value;
    which_[voxel_] = static_cast<Label>(frame_ + 1);
  }

  /// What certainty is stored as: 1, or in bytes 255 or 100 percent; 0 where the values are no such shares.
  float whole_value() const {
    if (largest_ <= 1 + kRounding) return 1;
    return largest_ == 255 || largest_ == 100 ? largest_ : 0;
  }

  const VoxelLayout& layout_;
  std::vector<bool> used_;  ///< by frame: whether any voxel has a value
  std::vector<float> best_, sum_;
  std::vector<Label> which_;  ///< the frame of the best value, from 1; 0: none
  std::size_t voxel_ = 0, frame_ = 0;
  bool maps_ = true;
  float largest_ = 0;
};

Error choose_frame(const VoxelLayout& layout, std::int64_t count) {
  return bad_input(layout.stage, layout.frames_said + "; expected one label a voxel: choose a frame with " +
                                     "--frame 0 to " + std::to_string(count - 1) + " (source.frame)");
}

}  // namespace

Result<std::vector<Label>> read_labels(const VoxelLayout& layout, Reading& reading,
                                       const std::function<Status(ValueSink&)>& feed) {
  const std::int64_t count = layout.layers * layout.frames, frame = reading.options.frame;
  if (frame >= count)
    return bad_input(layout.stage,
                     "source.frame is " + std::to_string(frame) + ", but the file has " +
                         (count == 1 ? "one frame" : std::to_string(count) + " frames, counted from 0"));
  if (count == 1 || frame >= 0) {
    const std::optional<std::int64_t> only = count == 1 ? std::nullopt : std::optional<std::int64_t>(frame);
    if (reading.options.threshold) {
      ThresholdCollector within(layout, *reading.options.threshold, only);
      if (Status fed = feed(within); !fed) return fed.error();
      return within.finish();
    }
    LabelCollector labels(layout, reading, only);
    if (Status fed = feed(labels); !fed) return fed.error();
    return labels.finish();
  }
  if (count > kMostMaps || reading.options.threshold) return choose_frame(layout, count);
  FrameMerger merger(layout);
  if (Status fed = feed(merger); !fed) return fed.error();
  if (!merger.are_maps()) return choose_frame(layout, count);
  return merger.labels(reading);
}

}  // namespace voxtet
