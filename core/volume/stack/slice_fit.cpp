#include "volume/stack/slice_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "geometry/grid/distance_transform.h"
#include "geometry/topology/label_components.h"

namespace voxtet::slices {
namespace {

constexpr std::size_t kMostLabels = 8;
constexpr std::size_t kLeastPixels = 20;  ///< of a label in a slice
constexpr int kReweightings = 10;
constexpr double kMedianToDeviation = 1.4826;  ///< of a normal distribution
constexpr double kNearOutline = 1.01;          ///< pixels

/// The labels with the most pixels, ascending.
std::vector<Label> largest_labels(const SliceStack& stack) {
  std::vector<std::size_t> pixels(65536, 0);
  for (const Label label : stack.pixels) ++pixels[label];
  std::vector<Label> labels;
  for (std::size_t label = 1; label < pixels.size(); ++label)
    if (pixels[label] > 0) labels.push_back(static_cast<Label>(label));
  std::stable_sort(labels.begin(), labels.end(), [&](Label a, Label b) { return pixels[a] > pixels[b]; });
  if (labels.size() > kMostLabels) labels.resize(kMostLabels);
  std::sort(labels.begin(), labels.end());
  return labels;
}

/// The part of the slices with labels, x0 y0 x1 y1.
std::array<int, 4> box_of_labels(const SliceStack& stack, int first, int count) {
  std::array<int, 4> box{stack.width, stack.height, -1, -1};
  for (int k = first; k < first + count; ++k) {
    const Label* pixel = stack.slice(k);
    for (int y = 0; y < stack.height; ++y)
      for (int x = 0; x < stack.width; ++x)
        if (*pixel++ != kBackground)
          box = {std::min(box[0], x), std::min(box[1], y), std::max(box[2], x), std::max(box[3], y)};
  }
  return box;
}

/// The mask and all that it encloses; its first pixel is outside.
void fill_holes(const std::array<int, 3>& size, std::vector<std::uint8_t>& mask) {
  std::vector<std::uint32_t> sizes;
  const std::vector<std::uint32_t> ids =
      label_components(size, std::vector<Label>(mask.begin(), mask.end()), sizes);
  for (std::size_t p = 0; p < mask.size(); ++p) mask[p] = ids[p] != ids[0];
}

std::vector<float> signed_distances(const std::array<int, 3>& size, const std::array<double, 2>& pixel_mm,
                                    const std::vector<std::uint8_t>& mask) {
  const Eigen::Vector3d spacing(pixel_mm[0], pixel_mm[1], 1);
  std::vector<std::uint8_t> outside(mask.size());
  for (std::size_t p = 0; p < mask.size(); ++p) outside[p] = !mask[p];
  std::vector<float> mm = distance_to_mask_mm(size, spacing, outside);
  const std::vector<float> to_mask = distance_to_mask_mm(size, spacing, mask);
  for (std::size_t p = 0; p < mm.size(); ++p) mm[p] -= to_mask[p];
  return mm;
}

struct Value {
  double mm = 0;
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
};

/// Bilinear, with the gradient of central differences; beyond the box as at its border.
Value sample(const SliceOutlines& outlines, const std::vector<float>& mm, const Eigen::Vector2d& at_mm) {
  const auto at = [&](int x, int y) {
    return static_cast<double>(mm[static_cast<std::size_t>(std::clamp(x, 0, outlines.width - 1)) +
                                  static_cast<std::size_t>(outlines.width) *
                                      static_cast<std::size_t>(std::clamp(y, 0, outlines.height - 1))]);
  };
  const double x = at_mm.x() / outlines.pixel_mm[0], y = at_mm.y() / outlines.pixel_mm[1];
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const double s = x - i, t = y - j;
  Value out;
  for (int corner = 0; corner < 4; ++corner) {
    const int a = i + corner % 2, b = j + corner / 2;
    const double weight = (corner % 2 ? s : 1 - s) * (corner / 2 ? t : 1 - t);
    out.mm += weight * at(a, b);
    out.gradient += weight * Eigen::Vector2d((at(a + 1, b) - at(a - 1, b)) / (2 * outlines.pixel_mm[0]),
                                             (at(a, b + 1) - at(a, b - 1)) / (2 * outlines.pixel_mm[1]));
  }
  return out;
}

/// A pixel at an outline: how far the middle of the neighbours' outlines is away along `gradient`.
struct Residual {
  std::size_t label = 0;
  double mm = 0;
  Eigen::Vector2d gradient;
};

std::vector<Residual> residuals_of(const SliceOutlines& outlines, std::size_t slice,
                                   const std::vector<Eigen::Vector2d>& shifts_mm) {
  const double near = kNearOutline * std::max(outlines.pixel_mm[0], outlines.pixel_mm[1]);
  const Eigen::Vector2d to_before = shifts_mm[slice] - shifts_mm[slice - 1],
                        to_behind = shifts_mm[slice] - shifts_mm[slice + 1];
  std::vector<Residual> out;
  for (std::size_t label = 0; label < outlines.mm.size(); ++label) {
    const std::vector<float>&own = outlines.mm[label][slice], &before = outlines.mm[label][slice - 1],
          &behind = outlines.mm[label][slice + 1];
    if (own.empty() || before.empty() || behind.empty()) continue;
    std::size_t p = 0;
    for (int y = 0; y < outlines.height; ++y)
      for (int x = 0; x < outlines.width; ++x, ++p) {
        if (std::abs(own[p]) > near) continue;
        const Eigen::Vector2d place(x * outlines.pixel_mm[0], y * outlines.pixel_mm[1]);
        const Value a = sample(outlines, before, place + to_before),
                    b = sample(outlines, behind, place + to_behind);
        out.push_back({label, (a.mm + b.mm) / 2 - own[p], (a.gradient + b.gradient) / 2});
      }
  }
  return out;
}

double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The normal equations of one fit. Each label's constant is eliminated.
struct Equations {
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  struct Constant {
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    double mm = 0, weight = 0;
    double at(const Eigen::Vector2d& move) const { return (mm + gradient.dot(move)) / weight; }
  };
  std::vector<Constant> constants;

  Equations(const std::vector<Residual>& residuals, const std::vector<double>& weights, std::size_t labels)
      : constants(labels) {
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      const auto& [label, mm, gradient] = residuals[i];
      matrix += weights[i] * gradient * gradient.transpose();
      right -= weights[i] * mm * gradient;
      constants[label].gradient += weights[i] * gradient;
      constants[label].mm += weights[i] * mm;
      constants[label].weight += weights[i];
    }
    for (const Constant& c : constants) {
      if (c.weight <= 0) continue;
      matrix -= c.gradient * c.gradient.transpose() / c.weight;
      right += c.gradient * c.mm / c.weight;
    }
  }
};

}  // namespace

SliceOutlines slice_outlines(const SliceStack& stack, int first, int count, double margin_mm) {
  const std::array<int, 4> box = box_of_labels(stack, first, count);
  SliceOutlines out;
  out.pixel_mm = stack.pixel_mm;
  const std::array<int, 2> margin{static_cast<int>(margin_mm / stack.pixel_mm[0]) + 2,
                                  static_cast<int>(margin_mm / stack.pixel_mm[1]) + 2};
  out.width = box[2] - box[0] + 1 + 2 * margin[0];
  out.height = box[3] - box[1] + 1 + 2 * margin[1];
  const std::array<int, 3> size{out.width, out.height, 1};
  std::vector<Label> labels = largest_labels(stack);
  labels.push_back(kBackground);  // for all that is not
  for (const Label label : labels) {
    std::vector<std::vector<float>>& slices = out.mm.emplace_back();
    for (int k = first; k < first + count; ++k) {
      std::vector<std::uint8_t> mask(static_cast<std::size_t>(out.width) *
                                     static_cast<std::size_t>(out.height));
      std::size_t pixels = 0;
      for (int y = box[1]; y <= box[3]; ++y)
        for (int x = box[0]; x <= box[2]; ++x) {
          const Label here = stack.slice(k)[x + stack.width * y];
          if (label == kBackground ? here == kBackground : here != label) continue;
          mask[static_cast<std::size_t>(x - box[0] + margin[0]) +
               static_cast<std::size_t>(out.width) * static_cast<std::size_t>(y - box[1] + margin[1])] = 1;
          ++pixels;
        }
      slices.emplace_back();
      if (pixels < kLeastPixels) continue;
      fill_holes(size, mask);
      slices.back() = signed_distances(size, out.pixel_mm, mask);
    }
  }
  return out;
}

SliceFit fit_slice(const SliceOutlines& outlines, int slice, const std::vector<Eigen::Vector2d>& shifts_mm) {
  const std::vector<Residual> residuals = residuals_of(outlines, static_cast<std::size_t>(slice), shifts_mm);
  SliceFit out;
  if (residuals.empty()) return out;
  const double least = std::min(outlines.pixel_mm[0], outlines.pixel_mm[1]);
  std::vector<double> weights(residuals.size(), 1), left(residuals.size()), sizes;
  for (int pass = 0; pass < kReweightings; ++pass) {
    const Equations equations(residuals, weights, outlines.mm.size());
    constexpr double kSlack = 1e-6;
    const Eigen::Matrix2d matrix = equations.matrix + kSlack * Eigen::Matrix2d::Identity();
    out.move_mm = matrix.inverse() * equations.right;
    out.weight = matrix * (2 / matrix.trace());
    for (std::size_t i = 0; i < residuals.size(); ++i)
      left[i] = residuals[i].mm + residuals[i].gradient.dot(out.move_mm) -
                equations.constants[residuals[i].label].at(out.move_mm);
    sizes.clear();
    for (const double mm : left) sizes.push_back(std::abs(mm));
    const double scale = std::max(least, kMedianToDeviation * median_of(sizes));
    for (std::size_t i = 0; i < left.size(); ++i)
      weights[i] = 1 / (1 + (left[i] / scale) * (left[i] / scale));
  }
  sizes.clear();
  for (const Residual& residual : residuals)
    sizes.push_back(std::abs(residual.mm + residual.gradient.dot(out.move_mm)));
  out.misfit_mm = kMedianToDeviation * median_of(sizes);
  return out;
}

}  // namespace voxtet::slices
