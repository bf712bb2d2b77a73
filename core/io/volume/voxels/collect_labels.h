// The values of a file -> labels.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/volume/voxels/read_values.h"

namespace voxtet {

/// Collects the values that are picked, and turns them into labels when all are there. Values must be whole.
/// Others are rounded, with a warning, where a whole number is near: within half a step of what a slope can
/// store (|slope| / 2, at most 0.05), or 1e-3 for real numbers without one. The background's value
/// (ReadOptions::background) becomes 0. Labels 1 to 65535 stay; those beyond, and 0 where it is not the
/// background, take free numbers in ascending order, and a warning gives them. Errors: kBadInput naming the
/// first voxel with a value that is no label, and what may be done.
class LabelCollector : public ValueSink {
 public:
  /// `picked`: the only layer or frame that is wanted.
  LabelCollector(const VoxelLayout& layout, Reading& reading, std::optional<std::int64_t> picked = {});

  void expect(std::uint64_t count) override;
  Status take(std::span<const double> values) override;
  Result<std::vector<Label>> finish();

 private:
  /// A value with the place of the first voxel that has it.
  struct Found {
    std::int64_t value;
    std::uint64_t first;
  };

  /// The whole number that a value stands for; false: it stands for none.
  bool whole_number(double value, std::int64_t& whole);
  /// The code of a value, its place in `found_`.
  Result<Label> code_of(double number, std::uint64_t index);
  Error no_label(std::uint64_t index, double value) const;
  Status check_negatives() const;
  Result<std::vector<Label>> labels_of_codes();
  void say_rounded();

  const VoxelLayout& layout_;
  Reading& reading_;
  std::optional<std::int64_t> picked_;
  double tolerance_;
  std::uint64_t seen_ = 0;
  std::vector<Label> codes_;
  std::vector<Found> found_;                 ///< in the order of the first voxels
  std::vector<std::int32_t> code_of_small_;  ///< of 0 to 65535; -1: none
  std::map<std::int64_t, Label> code_of_large_;
  double last_value_ = 0;
  Label last_code_ = 0;
  double rounded_ = 0, farthest_ = 0;  ///< the value that was rounded most, and how far
};

}  // namespace voxtet
