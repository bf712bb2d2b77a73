#include "geometry/grid/distance_transform.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace voxtet {
namespace {

/// Distance along x to the nearest mask voxel of the same row, squared.
void squared_distance_in_row(const std::uint8_t* mask, int n, double spacing, float* squared) {
  int last = -1;
  for (int i = 0; i < n; ++i) {
    if (mask[i]) last = i;
    const double d = (i - last) * spacing;
    squared[i] = last < 0 ? kFar : static_cast<float>(d * d);
  }
  last = -1;
  for (int i = n - 1; i >= 0; --i) {
    if (mask[i]) last = i;
    const double d = (last - i) * spacing;
    if (last >= 0) squared[i] = std::min(squared[i], static_cast<float>(d * d));
  }
}

/// Scratch of one lower envelope: the parabolas on it and where each begins to be the lowest.
struct Envelope {
  std::vector<int> apex;
  std::vector<double> begin;
  std::vector<double> height;
  explicit Envelope(int n)
      : apex(static_cast<std::size_t>(n)),
        begin(static_cast<std::size_t>(n)),
        height(static_cast<std::size_t>(n)) {}
};

/// squared[q] = min over p of (spacing*(q - p))^2 + squared[p], in place; positions in units of the spacing.
void lower_envelope(float* squared, int n, double spacing, Envelope& e) {
  const double unit = spacing * spacing;
  int count = 0;
  for (int q = 0; q < n; ++q) {
    if (squared[q] == kFar) continue;
    const double height = squared[q] / unit;
    double start = -1;
    while (count > 0) {
      const int p = e.apex[count - 1];
      start = 0.5 * ((height - e.height[count - 1]) / (q - p) + (q + p));
      if (start > e.begin[count - 1]) break;
      --count;
    }
    e.apex[count] = q;
    e.height[count] = height;
    e.begin[count] = count == 0 ? -1.0 : start;
    ++count;
  }
  if (count == 0) return;
  int at = 0;
  for (int q = 0; q < n; ++q) {
    while (at + 1 < count && e.begin[at + 1] < q) ++at;
    const double d = q - e.apex[at];
    squared[q] = static_cast<float>((d * d + e.height[at]) * unit);
  }
}

/// lower_envelope along every line of an axis. Lines next to each other in memory are gathered `kLines` at a
/// time, so that a strided pass reads whole cache lines.
void envelope_pass(std::vector<float>& squared, std::size_t lines, int n, std::size_t stride,
                   std::size_t first, double spacing, Envelope& e, std::vector<float>& tile) {
  constexpr std::size_t kLines = 16;
  const std::size_t length = static_cast<std::size_t>(n);
  tile.resize(kLines * length);
  for (std::size_t start = 0; start < lines; start += kLines) {
    const std::size_t width = std::min(kLines, lines - start);
    float* corner = squared.data() + first + start;
    for (std::size_t q = 0; q < length; ++q)
      for (std::size_t l = 0; l < width; ++l) tile[l * length + q] = corner[q * stride + l];
    for (std::size_t l = 0; l < width; ++l) lower_envelope(tile.data() + l * length, n, spacing, e);
    for (std::size_t q = 0; q < length; ++q)
      for (std::size_t l = 0; l < width; ++l) corner[q * stride + l] = tile[l * length + q];
  }
}

}  // namespace

std::vector<float> distance_to_mask_mm(const std::array<int, 3>& size, const Eigen::Vector3d& spacing_mm,
                                       std::span<const std::uint8_t> mask) {
  const std::size_t nx = static_cast<std::size_t>(size[0]);
  const std::size_t ny = static_cast<std::size_t>(size[1]);
  const std::size_t nz = static_cast<std::size_t>(size[2]);
  std::vector<float> squared(nx * ny * nz);
  for (std::size_t row = 0; row < ny * nz; ++row)
    squared_distance_in_row(mask.data() + row * nx, size[0], spacing_mm[0], squared.data() + row * nx);

  Envelope envelope(std::max(size[1], size[2]));
  std::vector<float> tile;
  for (std::size_t k = 0; k < nz; ++k)
    envelope_pass(squared, nx, size[1], nx, k * nx * ny, spacing_mm[1], envelope, tile);
  envelope_pass(squared, nx * ny, size[2], nx * ny, 0, spacing_mm[2], envelope, tile);

  for (float& value : squared) value = std::sqrt(value);
  return squared;
}

}  // namespace voxtet
