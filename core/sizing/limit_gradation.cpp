#include "sizing/limit_gradation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "geometry/distance_transform.h"

namespace voxtet {
namespace {

constexpr float kKeep = 1 - 5e-7F;  // smaller relative decreases are rounding
constexpr int kMaxTraversals = 1000;

/// A copy of the field with one ring of +infinity around it, so that no update asks where the grid ends.
class Sweeper {
 public:
  Sweeper(const std::array<int, 3>& size, const Eigen::Matrix3d& linear, double gradation)
      : nx_(size[0]),
        ny_(size[1]),
        nz_(size[2]),
        stride_(size[0] + 2),
        orthogonal_(has_orthogonal_axes(linear)) {
    for (int dk = -1; dk <= 1; ++dk)
      for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di)
          rise_[dk + 1][dj + 1][di + 1] =
              static_cast<float>(gradation * (linear * Eigen::Vector3d(di, dj, dk)).norm());
    for (int d = 0; d < 3 && orthogonal_; ++d)
      inverse_square_[d] = static_cast<float>(1 / (gradation * gradation * linear.col(d).squaredNorm()));
    all_squares_ = inverse_square_[0] + inverse_square_[1] + inverse_square_[2];
    inverse_of_all_ = 1 / all_squares_;
    h_.assign(static_cast<std::size_t>(stride_) * (ny_ + 2) * (nz_ + 2), kFar);
    dirty_.assign(static_cast<std::size_t>(ny_ + 2) * (nz_ + 2), 1);
    path_.resize(nx_);
    busy_.resize(blocks());
    for (std::vector<float>* side : {&side_y_, &side_z_, &corner_}) side->assign(nx_ + 2, kFar);
  }

  void load(const std::vector<float>& h) {
    for (int k = 0; k < nz_; ++k)
      for (int j = 0; j < ny_; ++j) std::copy_n(h.data() + flat_row(j, k), nx_, row(j, k));
  }
  void store(std::vector<float>& h) {
    for (int k = 0; k < nz_; ++k)
      for (int j = 0; j < ny_; ++j) std::copy_n(row(j, k), nx_, h.data() + flat_row(j, k));
  }

  /// One traversal of the rows in one of the four orders; each row is swept both ways. True if any row
  /// changed.
  bool traverse(bool j_up, bool k_up) {
    bool changed = false;
    for (int kk = 0; kk < nz_; ++kk)
      for (int jj = 0; jj < ny_; ++jj) {
        const int j = j_up ? jj : ny_ - 1 - jj;
        const int k = k_up ? kk : nz_ - 1 - kk;
        std::uint8_t& dirty = dirty_[dirty_index(j, k)];
        if (!dirty) continue;
        dirty = 0;
        if (!update_row(j, k)) continue;
        changed = true;
        for (int dk = -1; dk <= 1; ++dk)
          for (int dj = -1; dj <= 1; ++dj) dirty_[dirty_index(j + dj, k + dk)] = 1;
      }
    return changed;
  }

 private:
  float* row(int j, int k) {
    return h_.data() +
           static_cast<std::size_t>(stride_) * ((j + 1) + static_cast<std::size_t>(ny_ + 2) * (k + 1)) + 1;
  }
  std::size_t flat_row(int j, int k) const {
    return static_cast<std::size_t>(nx_) * (j + static_cast<std::size_t>(ny_) * k);
  }
  std::size_t dirty_index(int j, int k) const {
    return (j + 1) + static_cast<std::size_t>(ny_ + 2) * (k + 1);
  }

  /// What the eight rows around offer by straight paths, and the lower neighbours across y and z.
  void gather(int j, int k) {
    const float *y0 = row(j - 1, k), *y1 = row(j + 1, k), *z0 = row(j, k - 1), *z1 = row(j, k + 1);
    const float *c0 = row(j - 1, k - 1), *c1 = row(j + 1, k - 1), *c2 = row(j - 1, k + 1),
                *c3 = row(j + 1, k + 1);
    float *y = side_y_.data() + 1, *z = side_z_.data() + 1, *c = corner_.data() + 1, *path = path_.data();
    for (int i = -1; i <= nx_; ++i) {
      y[i] = std::min(y0[i], y1[i]);
      z[i] = std::min(z0[i], z1[i]);
      c[i] = std::min(std::min(c0[i], c1[i]), std::min(c2[i], c3[i]));
    }
    const float ry = rise_[1][2][1], rz = rise_[2][1][1], ryz = rise_[2][2][1];
    const float rxy = rise_[1][2][2], rxz = rise_[2][1][2], rxyz = rise_[2][2][2];
    for (int i = 0; i < nx_; ++i) {
      const float across = std::min(std::min(y[i] + ry, z[i] + rz), c[i] + ryz);
      const float y_ends = std::min(y[i - 1], y[i + 1]) + rxy;
      const float z_ends = std::min(z[i - 1], z[i + 1]) + rxz;
      const float c_ends = std::min(c[i - 1], c[i + 1]) + rxyz;
      path[i] = std::min(std::min(across, y_ends), std::min(z_ends, c_ends));
    }
  }

  /// The straight paths where opposite steps have different lengths.
  void gather_sheared(int j, int k) {
    std::fill(path_.begin(), path_.end(), kFar);
    for (int dk = -1; dk <= 1; ++dk)
      for (int dj = -1; dj <= 1; ++dj) {
        if (dj == 0 && dk == 0) continue;
        const float* other = row(j + dj, k + dk);
        const auto& rise = rise_[dk + 1][dj + 1];
        for (int i = 0; i < nx_; ++i)
          for (int di = -1; di <= 1; ++di) path_[i] = std::min(path_[i], other[i - di] + rise[1 - di]);
      }
  }

  bool update_row(int j, int k) {
    float* h = row(j, k);
    if (orthogonal_)
      gather(j, k);
    else
      gather_sheared(j, k);
    if (!find_blocks(h)) return false;
    // A block in which nothing is to be lowered is passed over, unless a point beside it was lowered.
    bool changed = false;
    for (int b = 0; b < blocks(); ++b) {
      if (!busy_[b]) continue;
      const float first = h[b * kBlock], last = h[block_end(b) - 1];
      for (int i = b * kBlock; i < block_end(b); ++i) changed |= update(h, i);
      if (b > 0 && h[b * kBlock] < first) busy_[b - 1] = 1;
      if (b + 1 < blocks() && h[block_end(b) - 1] < last) busy_[b + 1] = 1;
    }
    for (int b = blocks() - 1; b >= 0; --b) {
      if (!busy_[b]) continue;
      const float first = h[b * kBlock];
      for (int i = block_end(b) - 1; i >= b * kBlock; --i) changed |= update(h, i);
      if (b > 0 && h[b * kBlock] < first) busy_[b - 1] = 1;
    }
    return changed;
  }

  /// Marks the blocks of a row in which update() would lower a point as it stands; true if there is one.
  bool find_blocks(const float* h) {
    bool any = false;
    for (int b = 0; b < blocks(); ++b) {
      busy_[b] = needs_update(h, b * kBlock, block_end(b));
      any = any || busy_[b];
    }
    return any;
  }

  /// Free of branches, so that it vectorises.
  bool needs_update(const float* h, int begin, int end) const {
    const float *y = side_y_.data() + 1, *z = side_z_.data() + 1, *path = path_.data();
    const float rx = rise_[1][1][0];
    int count = 0;
    for (int i = begin; i < end; ++i) {
      const float kept = h[i] * kKeep;
      const float x = std::min(h[i - 1], h[i + 1]);
      count += static_cast<int>(std::min(path[i], x + rx) < kept) |
               static_cast<int>(slope_squared(kept, x, y[i], z[i]) > 1);
    }
    return count > 0;
  }

  bool update(float* h, int i) {
    const float x = std::min(h[i - 1], h[i + 1]), y = side_y_[i + 1], z = side_z_[i + 1];
    const float kept = h[i] * kKeep;
    float value = std::min(path_[i], x + rise_[1][1][0]);
    if (slope_squared(std::min(kept, value), x, y, z) > 1) value = std::min(value, godunov(x, y, z));
    if (!(value < kept)) return false;
    h[i] = value;
    return true;
  }

  /// Godunov's |grad h|^2 / gradation^2 where the point has value h: above 1 means that godunov() is lower
  /// than h. Zero on sheared grids, where it does not hold.
  float slope_squared(float h, float x, float y, float z) const {
    const float dx = std::max(0.0F, h - x), dy = std::max(0.0F, h - y), dz = std::max(0.0F, h - z);
    return dx * dx * inverse_square_[0] + dy * dy * inverse_square_[1] + dz * dz * inverse_square_[2];
  }

  /// The solution u of sum_d (max(u - side_d, 0) / (g spacing_d))^2 = 1, relative to the lowest side so that
  /// no digits are lost. A side counts where the sum at it, of those below, is less than 1. Where the lowest
  /// alone counts, the straight paths have the solution.
  float godunov(float x, float y, float z) const {
    float s0 = x, s1 = y, s2 = z, w0 = inverse_square_[0], w1 = inverse_square_[1], w2 = inverse_square_[2];
    const auto order = [](float& low, float& high, float& low_weight, float& high_weight) {
      const bool swap = high < low;
      const float s = swap ? high : low, w = swap ? high_weight : low_weight;
      high = swap ? low : high;
      high_weight = swap ? low_weight : high_weight;
      low = s;
      low_weight = w;
    };
    order(s0, s1, w0, w1);
    order(s1, s2, w1, w2);
    order(s0, s1, w0, w1);
    const float d1 = s1 - s0, d2 = s2 - s0, d21 = s2 - s1;
    if (w0 * d1 * d1 >= 1) return kFar;
    const float b = w1 * d1, c = b * d1 - 1;
    if (w0 * d2 * d2 + w1 * d21 * d21 >= 1) {
      const float a = w0 + w1;
      return s0 + (b + std::sqrt(std::max(b * b - a * c, 0.0F))) / a;
    }
    const float all_b = b + w2 * d2, all_c = c + w2 * d2 * d2;
    return s0 + (all_b + std::sqrt(std::max(all_b * all_b - all_squares_ * all_c, 0.0F))) * inverse_of_all_;
  }

  static constexpr int kBlock = 16;
  int blocks() const { return (nx_ + kBlock - 1) / kBlock; }
  int block_end(int block) const { return std::min(nx_, (block + 1) * kBlock); }

  int nx_, ny_, nz_, stride_;
  bool orthogonal_;
  std::array<std::array<std::array<float, 3>, 3>, 3> rise_{};  ///< [dk+1][dj+1][di+1]: gradation * length
  std::array<float, 3> inverse_square_{};                      ///< 1 / (gradation * spacing)^2
  float all_squares_ = 0, inverse_of_all_ = 0;                 ///< of the sum of inverse_square_
  std::vector<float> h_, path_, side_y_, side_z_, corner_;
  std::vector<std::uint8_t> dirty_;
  std::vector<std::uint8_t> busy_;  ///< the blocks of the row at hand
};

}  // namespace

bool has_orthogonal_axes(const Eigen::Matrix3d& linear) {
  constexpr double kCosine = 1e-4;
  for (int d = 0; d < 3; ++d) {
    const auto a = linear.col(d), b = linear.col((d + 1) % 3);
    if (std::abs(a.dot(b)) > kCosine * a.norm() * b.norm()) return false;
  }
  return true;
}

bool limit_gradation(const std::array<int, 3>& size, const Eigen::Matrix3d& linear, double gradation,
                     std::vector<float>& h_mm, const RunContext& ctx) {
  Sweeper sweeper(size, linear, gradation);
  sweeper.load(h_mm);
  bool changed = true;
  for (int round = 0; changed && round < kMaxTraversals; ++round) {
    if (ctx.cancelled()) return false;
    const bool opposite = round & 1, crossed = round & 2;
    changed = sweeper.traverse(!opposite, opposite == crossed);
  }
  sweeper.store(h_mm);
  return true;
}

}  // namespace voxtet
