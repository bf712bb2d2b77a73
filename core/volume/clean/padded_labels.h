// Labels with two layers of background around them, so that every voxel has its neighbours.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "types/label_volume.h"

namespace voxtet {

struct PaddedLabels {
  static constexpr int kMargin = 2;

  std::array<int, 3> size;  ///< with the margin
  std::vector<Label> labels;

  explicit PaddedLabels(const LabelVolume& volume);
  /// Gives the labels back to the volume that they were made of.
  void write_to(LabelVolume& volume) const;

  std::ptrdiff_t step(const std::array<int, 3>& by) const {
    return by[0] + size[0] * (by[1] + static_cast<std::ptrdiff_t>(size[1]) * by[2]);
  }
  /// Calls visit(offset) for each voxel inside the margin, x fastest.
  template <class Visit>
  void for_inner(const Visit& visit) const {
    for (int k = kMargin; k < size[2] - kMargin; ++k)
      for (int j = kMargin; j < size[1] - kMargin; ++j) {
        std::size_t voxel = static_cast<std::size_t>(step({kMargin, j, k}));
        for (int i = kMargin; i < size[0] - kMargin; ++i) visit(voxel++);
      }
  }
};

}  // namespace voxtet
