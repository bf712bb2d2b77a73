#include "geometry/grid/fast_sweeping.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "geometry/grid/distance_transform.h"

namespace voxtet {
namespace {

constexpr float kOutside = 1e18F;   // larger than any size; finite, so that differences of two are numbers
constexpr float kKeep = 1 - 5e-7F;  // smaller relative decreases are rounding
constexpr int kMaxTraversals = 1000;

/// A copy of the field with rings of kOutside around it, so that no update asks where the grid ends and rows
/// are whole blocks.
class Sweeper {
 public:
  Sweeper(const std::array<int, 3>& size, const Eigen::Matrix3d& linear, double gradation)
      : nx_(size[0]),
        ny_(size[1]),
        nz_(size[2]),
        blocks_((size[0] + kBlock - 1) / kBlock),
        stride_(blocks_ * kBlock + 4),
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
    h_.assign(static_cast<std::size_t>(stride_) * (ny_ + 2) * (nz_ + 2), kOutside);
    dirty_.assign(static_cast<std::size_t>(blocks_ + 2) * (ny_ + 2) * (nz_ + 2), 1);
    path_.resize(stride_);
    for (std::vector<std::uint8_t>* flags : {&gathered_, &busy_, &changed_}) flags->resize(blocks_);
    for (std::vector<float>* side : {&side_y_, &side_z_}) side->resize(stride_);
  }

  void load(const std::vector<float>& h) {
    for (int k = 0; k < nz_; ++k)
      for (int j = 0; j < ny_; ++j) {
        const float* from = h.data() + flat_row(j, k);
        std::transform(from, from + nx_, row(j, k), [](float size) { return std::min(size, kOutside); });
      }
    const auto [low, high] = std::minmax_element(h.begin(), h.end());
    find_middle(std::min(*low, kOutside) / 2 + std::min(*high, kOutside) / 2);
  }

  /// What no size has reached stays as it is.
  void store(std::vector<float>& h) {
    for (int k = 0; k < nz_; ++k)
      for (int j = 0; j < ny_; ++j) {
        float* to = h.data() + flat_row(j, k);
        std::transform(to, to + nx_, row(j, k), to,
                       [](float old, float size) { return size < kOutside ? size : old; });
      }
  }

  /// One traversal of the rows in one of the four orders: along y and z away from the middle or towards it.
  /// Each row is swept both ways, first as along y. True if any row changed.
  bool traverse(bool y_away, bool z_away) {
    bool changed = false;
    for (int kk = 0; kk < nz_; ++kk)
      for (int jj = 0; jj < ny_; ++jj) {
        const int j = from_middle(1, ny_, y_away ? jj : ny_ - 1 - jj);
        const int k = from_middle(2, nz_, z_away ? kk : nz_ - 1 - kk);
        changed |= update_row(j, k, y_away);
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

  /// The middle of the points that are no larger than halfway between the smallest and the largest size:
  /// small sizes spread from there, and what is visited in the order in which they spread is lowered once.
  void find_middle(float halfway) {
    std::array<double, 3> sum{};
    std::size_t count = 0;
    for (int k = 0; k < nz_; ++k)
      for (int j = 0; j < ny_; ++j) {
        const float* values = row(j, k);
        for (int i = 0; i < nx_; ++i) {
          if (values[i] > halfway) continue;
          sum[0] += i;
          sum[1] += j;
          sum[2] += k;
          ++count;
        }
      }
    for (std::size_t d = 0; d < 3; ++d) middle_[d] = static_cast<int>(sum[d] / static_cast<double>(count));
  }

  /// What comes at a place of the order 'from the middle up, then from the middle down'.
  int from_middle(std::size_t axis, int size, int place) const {
    return place < size - middle_[axis] ? middle_[axis] + place : size - 1 - place;
  }

  /// What tells of each block of a row whether anything around it has changed since it was looked at.
  std::uint8_t* dirty_row(int j, int k) {
    return dirty_.data() +
           static_cast<std::size_t>(blocks_ + 2) * ((j + 1) + static_cast<std::size_t>(ny_ + 2) * (k + 1)) +
           1;
  }

  /// What the eight rows around offer a block by straight paths, and the lower neighbours across y and z.
  void gather(int j, int k, int block) {
    if (gathered_[block]) return;
    gathered_[block] = 1;
    const int begin = block * kBlock, end = block_end(block);
    if (orthogonal_)
      gather_orthogonal(j, k, begin);
    else
      gather_sheared(j, k, begin, end);
  }

  /// Always a whole block and as much beside it as makes the number of points a multiple of four.
  void gather_orthogonal(int j, int k, int begin) {
    std::array<float, kBlock + 4> corner;
    const auto from = [&](int dj, int dk) { return row(j + dj, k + dk) + begin; };
    const float *y0 = from(-1, 0), *y1 = from(1, 0), *z0 = from(0, -1), *z1 = from(0, 1);
    const float *c0 = from(-1, -1), *c1 = from(1, -1), *c2 = from(-1, 1), *c3 = from(1, 1);
    float *y = side_y_.data() + begin + 1, *z = side_z_.data() + begin + 1, *c = corner.data() + 1;
    float* path = path_.data() + begin;
    for (int i = -1; i < kBlock + 3; ++i) {
      y[i] = std::min(y0[i], y1[i]);
      z[i] = std::min(z0[i], z1[i]);
      c[i] = std::min(std::min(c0[i], c1[i]), std::min(c2[i], c3[i]));
    }
    const float ry = rise_[1][2][1], rz = rise_[2][1][1], ryz = rise_[2][2][1];
    const float rxy = rise_[1][2][2], rxz = rise_[2][1][2], rxyz = rise_[2][2][2];
    for (int i = 0; i < kBlock; ++i) {
      const float across = std::min(std::min(y[i] + ry, z[i] + rz), c[i] + ryz);
      const float y_ends = std::min(y[i - 1], y[i + 1]) + rxy;
      const float z_ends = std::min(z[i - 1], z[i + 1]) + rxz;
      const float c_ends = std::min(c[i - 1], c[i + 1]) + rxyz;
      path[i] = std::min(std::min(across, y_ends), std::min(z_ends, c_ends));
    }
  }

  /// The straight paths where opposite steps have different lengths.
  void gather_sheared(int j, int k, int begin, int end) {
    std::fill(path_.begin() + begin, path_.begin() + end, kFar);
    for (int dk = -1; dk <= 1; ++dk)
      for (int dj = -1; dj <= 1; ++dj) {
        if (dj == 0 && dk == 0) continue;
        const float* other = row(j + dj, k + dk);
        const auto& rise = rise_[dk + 1][dj + 1];
        for (int i = begin; i < end; ++i)
          for (int di = -1; di <= 1; ++di) path_[i] = std::min(path_[i], other[i - di] + rise[1 - di]);
      }
  }

  bool update_row(int j, int k, bool away_first) {
    std::uint8_t* dirty = dirty_row(j, k);
    if (std::find(dirty, dirty + blocks_, 1) == dirty + blocks_) return false;
    std::fill(gathered_.begin(), gathered_.end(), 0);
    std::fill(changed_.begin(), changed_.end(), 0);
    std::copy_n(dirty, blocks_, busy_.begin());
    std::fill_n(dirty, blocks_, 0);
    sweep(j, k, away_first);
    // What was lowered asks for a second look from the other side.
    for (int b = 0; b < blocks_; ++b) busy_[b] |= gathered_[b];
    sweep(j, k, !away_first);
    bool any = false;
    for (int b = 0; b < blocks_; ++b) {
      if (!changed_[b]) continue;
      any = true;
      for (int dk = -1; dk <= 1; ++dk)
        for (int dj = -1; dj <= 1; ++dj) std::fill_n(dirty_row(j + dj, k + dk) + b - 1, 3, 1);
    }
    return any;
  }

  /// Looks at the busy blocks of a row, away from the middle or towards it.
  void sweep(int j, int k, bool away) {
    const int middle = middle_[0] / kBlock;
    for (int b = away ? middle : 0; b < (away ? blocks_ : middle); ++b) look_at(j, k, b, true);
    for (int b = (away ? middle : blocks_) - 1; b >= (away ? 0 : middle); --b) look_at(j, k, b, false);
  }

  /// Updates a busy block, up or down, if anything is to be lowered in it. The block beside a point that is
  /// lowered becomes busy.
  void look_at(int j, int k, int block, bool up) {
    if (!busy_[block]) return;
    busy_[block] = 0;
    gather(j, k, block);
    float* h = row(j, k);
    const int begin = block * kBlock, end = block_end(block);
    if (!needs_update(h, begin, end)) return;
    const float first = h[begin], last = h[end - 1];
    bool changed = false, beside = false;  // whether the point before was lowered
    const auto look = [&](int i) {
      beside = (beside || needs_[i - begin] != 0) && update(h, i);
      changed |= beside;
    };
    if (up)
      for (int i = begin; i < end; ++i) look(i);
    else
      for (int i = end - 1; i >= begin; --i) look(i);
    if (changed) changed_[block] = 1;
    if (block > 0 && h[begin] < first) busy_[block - 1] = 1;
    if (block + 1 < blocks_ && h[end - 1] < last) busy_[block + 1] = 1;
  }

  /// Finds the points that are to be lowered; whether there are any. Free of branches, so that it vectorises.
  bool needs_update(const float* h, int begin, int end) {
    const float *y = side_y_.data() + 1, *z = side_z_.data() + 1, *path = path_.data();
    const float rx = rise_[1][1][0];
    int count = 0;
    for (int i = begin; i < end; ++i) {
      const float kept = h[i] * kKeep;
      const float x = std::min(h[i - 1], h[i + 1]);
      needs_[i - begin] = static_cast<int>(std::min(path[i], x + rx) < kept) |
                          static_cast<int>(slope_squared(kept, x, y[i], z[i]) > 1);
      count += needs_[i - begin];
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
    const auto positive = [](float d) { return 0.5F * (d + std::abs(d)); };  // without a branch
    const float dx = positive(h - x), dy = positive(h - y), dz = positive(h - z);
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
  int block_end(int block) const { return std::min(nx_, (block + 1) * kBlock); }

  int nx_, ny_, nz_, blocks_, stride_;
  bool orthogonal_;
  std::array<int, 3> middle_{};
  std::array<std::array<std::array<float, 3>, 3>, 3> rise_{};  ///< [dk+1][dj+1][di+1]: gradation * length
  std::array<float, 3> inverse_square_{};                      ///< 1 / (gradation * spacing)^2
  float all_squares_ = 0, inverse_of_all_ = 0;                 ///< of the sum of inverse_square_
  std::array<int, kBlock> needs_{};  ///< by point of the block at hand, whether it is to be lowered
  std::vector<float> h_, path_, side_y_, side_z_;
  std::vector<std::uint8_t> dirty_;                      ///< by block, with a ring around
  std::vector<std::uint8_t> gathered_, busy_, changed_;  ///< the blocks of the row at hand
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
