// The values of an image -> one label.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "io/volume/voxels/read_values.h"
#include "types/label_volume.h"

namespace voxtet {

/// Gives label 1 to the values within a threshold, and the background to all others and to what is not a
/// number. Errors: kBadInput where no voxel is within, with the values that there are.
class ThresholdCollector : public ValueSink {
 public:
  /// `frame`: the only frame (or layer) that is wanted.
  ThresholdCollector(const VoxelLayout& layout, const Threshold& threshold, std::optional<std::int64_t> frame)
      : layout_(layout), threshold_(threshold), frame_(frame) {}

  void expect(std::uint64_t count) override;
  Status take(std::span<const double> values) override;
  Result<std::vector<Label>> finish();

 private:
  const VoxelLayout& layout_;
  const Threshold& threshold_;
  const std::optional<std::int64_t> frame_;
  std::uint64_t seen_ = 0;
  bool any_ = false;
  double smallest_ = std::numeric_limits<double>::infinity(), largest_ = -smallest_;
  std::vector<Label> labels_;
};

}  // namespace voxtet
