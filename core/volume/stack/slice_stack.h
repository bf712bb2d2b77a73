// A label volume seen as a stack of slices across one index axis, and the labels' distances in a slice.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "types/label_volume.h"

namespace voxtet::slices {

/// Slices of width x height pixels, x fastest, one after the other.
struct SliceStack {
  int width = 0, height = 0, count = 0;
  std::array<double, 2> pixel_mm{};  ///< between pixel centres
  double step_mm = 0;                ///< between slices
  std::vector<Label> pixels;

  std::size_t area() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  const Label* slice(int k) const { return pixels.data() + static_cast<std::size_t>(k) * area(); }
  Label* slice(int k) { return pixels.data() + static_cast<std::size_t>(k) * area(); }
  double smallest_pixel_mm() const { return pixel_mm[0] < pixel_mm[1] ? pixel_mm[0] : pixel_mm[1]; }
};

SliceStack take_slices(const LabelVolume& volume, int axis);

/// A volume like `source` whose slices across `axis` are those of `stack`: `planes` (odd) of them for each
/// slice of the source, the middle one at the place of that slice.
LabelVolume put_slices(const SliceStack& stack, const LabelVolume& source, int axis, int planes);

/// Signed distances (mm) within a slice from pixel centres to the outline of one label: positive inside,
/// never beyond +-`far_mm`. The outline runs about half a pixel from the centres on both sides of it. Only a
/// box is stored; outside of it the distance is -far_mm.
struct LabelDistance {
  Label label = kBackground;
  std::array<int, 2> low{}, size{};
  float far_mm = 0;
  std::vector<float> mm;

  float at(int x, int y) const {
    x -= low[0];
    y -= low[1];
    if (x < 0 || y < 0 || x >= size[0] || y >= size[1]) return -far_mm;
    return mm[static_cast<std::size_t>(x) + static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(y)];
  }
};

/// One for each label of a slice (background like any other), ascending. Time is linear in the area of the
/// boxes.
using SliceDistances = std::vector<LabelDistance>;
SliceDistances slice_distances(const SliceStack& stack, int slice, double far_mm);

}  // namespace voxtet::slices
