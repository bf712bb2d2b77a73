#include "volume/stack/move_slices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "geometry/topology/label_components.h"
#include "volume/stack/slice_gap.h"

namespace voxtet::slices {
namespace {

constexpr double kLeastFraction = 0.05;  ///< pixels
constexpr double kAreaChange = 0.05;
constexpr double kAreaPixels = 2;

SliceStack one_slice(const SliceStack& stack, int slice) {
  SliceStack out = stack;
  out.count = 1;
  out.pixels.assign(stack.slice(slice), stack.slice(slice) + stack.area());
  return out;
}

SliceStack moved_by_pixels(const SliceStack& slice, const std::array<int, 2>& pixels) {
  SliceStack out = slice;
  for (int y = 0; y < slice.height; ++y)
    for (int x = 0; x < slice.width; ++x) {
      const int i = x - pixels[0], j = y - pixels[1];
      const bool inside = i >= 0 && j >= 0 && i < slice.width && j < slice.height;
      out.pixels[static_cast<std::size_t>(x + slice.width * y)] =
          inside ? slice.pixels[static_cast<std::size_t>(i + slice.width * j)] : kBackground;
    }
  return out;
}

/// `fraction`: in pixels, at most a half along each axis. Every pixel gets the label that is deepest there.
SliceStack moved_by_fraction(const SliceStack& slice, const Eigen::Vector2d& fraction) {
  const double far_mm = 3 * std::max(slice.pixel_mm[0], slice.pixel_mm[1]);
  const SliceDistances distances = slice_distances(slice, 0, far_mm);
  SliceStack out = slice;
  const int sx = fraction.x() > 0 ? -1 : 1, sy = fraction.y() > 0 ? -1 : 1;
  const double u = std::abs(fraction.x()), v = std::abs(fraction.y());
  for (int y = 0; y < slice.height; ++y)
    for (int x = 0; x < slice.width; ++x) {
      const int i = std::clamp(x + sx, 0, slice.width - 1), j = std::clamp(y + sy, 0, slice.height - 1);
      double deepest = -2 * far_mm;
      for (const LabelDistance& label : distances) {
        const double mm = (1 - v) * ((1 - u) * label.at(x, y) + u * label.at(i, y)) +
                          v * ((1 - u) * label.at(x, j) + u * label.at(i, j));
        if (mm <= deepest) continue;
        deepest = mm;
        out.pixels[static_cast<std::size_t>(x + slice.width * y)] = label.label;
      }
    }
  return out;
}

/// Whether all labels are in as many pieces, about as large, and touch no others than before.
bool keeps_labels(const SliceStack& before, const SliceStack& after) {
  const std::array<int, 3> size{before.width, before.height, 1};
  std::vector<std::uint32_t> parts, parts_after;
  label_components(size, before.pixels, parts);
  label_components(size, after.pixels, parts_after);
  if (parts.size() != parts_after.size() ||
      count_components(size, before.pixels) != count_components(size, after.pixels))
    return false;
  std::vector<double> pixels(65536, 0), change(65536, 0);
  for (std::size_t p = 0; p < before.pixels.size(); ++p) {
    ++pixels[before.pixels[p]];
    --change[before.pixels[p]];
    ++change[after.pixels[p]];
  }
  std::vector<Label> labels;
  for (std::size_t label = 0; label < pixels.size(); ++label) {
    if (std::abs(change[label]) > std::max(kAreaPixels, kAreaChange * pixels[label])) return false;
    if (pixels[label] > 0) labels.push_back(static_cast<Label>(label));
  }
  const Contacts touched(before, 0), touch(after, 0);
  for (const Label a : labels)
    for (const Label b : labels)
      if (a < b && touch.touch(a, b) != touched.touch(a, b)) return false;
  return true;
}

}  // namespace

SliceStack move_slices(const SliceStack& stack, std::vector<Eigen::Vector2d>& moves_mm) {
  SliceStack out = stack;
  for (int k = 0; k < stack.count; ++k) {
    Eigen::Vector2d& move = moves_mm[static_cast<std::size_t>(k)];
    const Eigen::Vector2d pixel(stack.pixel_mm[0], stack.pixel_mm[1]), pixels = move.cwiseQuotient(pixel);
    const std::array<int, 2> whole{static_cast<int>(std::lround(pixels.x())),
                                   static_cast<int>(std::lround(pixels.y()))};
    const Eigen::Vector2d done(whole[0], whole[1]), fraction = pixels - done;
    SliceStack slice = moved_by_pixels(one_slice(stack, k), whole);
    bool finely = fraction.cwiseAbs().maxCoeff() > kLeastFraction;
    if (finely) {
      SliceStack fine = moved_by_fraction(slice, fraction);
      finely = keeps_labels(slice, fine);
      if (finely) slice = std::move(fine);
    }
    if (!finely) move = done.cwiseProduct(pixel);
    std::copy(slice.pixels.begin(), slice.pixels.end(), out.slice(k));
  }
  return out;
}

double overlap(const SliceStack& stack, int lower) {
  const Label *a = stack.slice(lower), *b = stack.slice(lower + 1);
  double same = 0, all = 0;
  for (std::size_t p = 0; p < stack.area(); ++p) {
    all += (a[p] != kBackground) + (b[p] != kBackground);
    same += a[p] != kBackground && a[p] == b[p];
  }
  return all > 0 ? 2 * same / all : 1;
}

}  // namespace voxtet::slices
