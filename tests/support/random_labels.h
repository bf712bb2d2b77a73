// Seeded random label volumes: the same voxels and affine on every platform. White noise of a chosen size,
// and a mixture of kinds, hard on purpose.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "support/label_bodies.h"
#include "support/test_random.h"
#include "types/label_volume.h"
#include "volume/mesh_order.h"

namespace voxtet::test {

/// White noise of labels 0..labels.
inline LabelVolume random_volume(int n, int labels, std::uint64_t seed) {
  TestRandom random(seed);
  return make_volume(n, n, n, [&](int, int, int) { return random.below(labels + 1); });
}

inline constexpr std::array<const char*, 10> kRandomKinds{
    "noise", "blobs", "checkerboard", "sheets", "wires", "holes", "diagonals", "full", "border", "nested"};

struct RandomLabels {
  LabelVolume volume;
  std::string kind;    ///< one of kRandomKinds
  std::string affine;  ///< "axis", "anisotropic", "mirrored" or "oblique" (the latter two also anisotropic)
};

/// Draws voxels 0 (background) to `labels` on a grid.
class LabelPainter {
 public:
  LabelPainter(std::array<int, 3> size, int labels, TestRandom& random) : labels_(labels), random_(random) {
    volume_.size = size;
    volume_.labels.assign(volume_.voxel_count(), kBackground);
  }
  LabelVolume take() { return std::move(volume_); }

  void noise(int percent, int from, int to) {
    for (Label& label : volume_.labels)
      if (random_.below(100) < percent) label = between(from, to);
  }
  /// The largest of smoothed random fields wins, one field a label.
  void blobs(int from) {
    std::vector<int> best(volume_.voxel_count(), -1);
    for (int label = from; label <= labels_; ++label) {
      const std::vector<int> field = smooth_field();
      for (std::size_t i = 0; i < best.size(); ++i)
        if (field[i] > best[i]) best[i] = field[i], volume_.labels[i] = static_cast<Label>(label);
    }
  }
  void checkerboard() {
    const int cell = 1 + random_.below(2), colours = 2 + random_.below(2), first = random_.below(2);
    fill([&](int i, int j, int k, Label) {
      return (first + (i / cell + j / cell + k / cell) % colours) % (labels_ + 1);
    });
  }
  /// One voxel thick, across an axis or diagonal.
  void sheets() {
    for (int n = 1 + random_.below(4); n > 0; --n) {
      const int across = random_.below(4), at = random_.below(volume_.size[across % 3]);
      const Label own = between(1, labels_);
      fill([&](int i, int j, int k, Label old) {
        const std::array<int, 4> place{i, j, k, i + j};
        return place[static_cast<std::size_t>(across)] == at + (across == 3 ? volume_.size[1] / 2 : 0) ? own
                                                                                                       : old;
      });
    }
  }
  /// Walks of one voxel's thickness, in half of the cases with diagonal steps, that touch in an edge or
  /// corner.
  void wires(int from, int to) {
    const bool diagonal = random_.below(2) == 1;
    for (int count = 1 + random_.below(8); count > 0; --count) {
      std::array<int, 3> p = place();
      const Label own = between(from, to);
      for (int step = 0; step < 30; ++step) {
        if (volume_.contains(p[0], p[1], p[2])) volume_.labels[volume_.offset(p[0], p[1], p[2])] = own;
        const int axis = random_.below(3);
        for (int d = 0; d < 3; ++d)
          if (diagonal || d == axis) p[static_cast<std::size_t>(d)] += random_.below(3) - 1;
      }
    }
  }
  /// Bodies of two voxels that touch in an edge or in a corner.
  void diagonals() {
    for (int n = 5 + random_.below(30); n > 0; --n) {
      const std::array<int, 3> p = place();
      const Label own = between(1, labels_), other = between(1, labels_);
      const std::array<int, 3> step{1, random_.below(2) * 2 - 1, random_.below(3) - 1};
      volume_.labels[volume_.offset(p[0], p[1], p[2])] = own;
      if (volume_.contains(p[0] + step[0], p[1] + step[1], p[2] + step[2]))
        volume_.labels[volume_.offset(p[0] + step[0], p[1] + step[1], p[2] + step[2])] = other;
    }
  }
  void solid(int margin) {
    const Label own = between(1, labels_);
    fill([&](int i, int j, int k, Label) {
      return std::min({i, j, k, volume_.size[0] - 1 - i, volume_.size[1] - 1 - j, volume_.size[2] - 1 - k}) >=
                     margin
                 ? own
                 : kBackground;
    });
  }
  /// The faces of the image, some of them labelled to a depth of one to three voxels.
  void border() {
    for (int face = 0; face < 6; ++face) {
      if (random_.below(3) == 0) continue;
      const Label own = between(1, labels_);
      const int depth = 1 + random_.below(3), axis = face / 2;
      fill([&](int i, int j, int k, Label old) {
        const int at = std::array{i, j, k}[static_cast<std::size_t>(axis)];
        return (face % 2 ? volume_.size[axis] - 1 - at : at) < depth ? own : old;
      });
    }
  }
  /// Shells one or two voxels thick around a point, round or square.
  void nested() {
    const std::array<int, 3> c = place();
    const int thickness = 1 + random_.below(2), round = random_.below(2), first = random_.below(labels_ + 1);
    fill([&](int i, int j, int k, Label) {
      const int x = std::abs(i - c[0]), y = std::abs(j - c[1]), z = std::abs(k - c[2]);
      int radius = std::max({x, y, z});
      if (round)
        for (radius = 0; radius * radius < x * x + y * y + z * z;) ++radius;
      return (first + radius / thickness) % (labels_ + 1);
    });
  }
  void at_least_one_voxel() {
    if (std::all_of(volume_.labels.begin(), volume_.labels.end(), [](Label l) { return l == kBackground; }))
      volume_.labels[volume_.labels.size() / 2] = 1;
  }

 private:
  Label between(int from, int to) { return static_cast<Label>(from + random_.below(to - from + 1)); }
  std::array<int, 3> place() {
    std::array<int, 3> p{};
    for (std::size_t d = 0; d < 3; ++d) p[d] = random_.below(volume_.size[d]);
    return p;
  }
  template <class NewLabel>
  void fill(NewLabel&& label) {
    for (int k = 0; k < volume_.size[2]; ++k)
      for (int j = 0; j < volume_.size[1]; ++j)
        for (int i = 0; i < volume_.size[0]; ++i) {
          Label& voxel = volume_.labels[volume_.offset(i, j, k)];
          voxel = static_cast<Label>(label(i, j, k, voxel));
        }
  }
  /// White noise averaged twice along each axis.
  std::vector<int> smooth_field() {
    std::vector<int> field(volume_.voxel_count());
    for (int& value : field) value = random_.below(4096);
    for (int pass = 0; pass < 6; ++pass) {
      const int axis = pass % 3;
      std::vector<int> next(field.size());
      for (int k = 0; k < volume_.size[2]; ++k)
        for (int j = 0; j < volume_.size[1]; ++j)
          for (int i = 0; i < volume_.size[0]; ++i) {
            int sum = 0;
            for (int step = -1; step <= 1; ++step) {
              std::array<int, 3> p{i, j, k};
              int& c = p[static_cast<std::size_t>(axis)];
              c = std::clamp(c + step, 0, volume_.size[axis] - 1);
              sum += field[volume_.offset(p[0], p[1], p[2])];
            }
            next[volume_.offset(i, j, k)] = sum / 3;
          }
      field = std::move(next);
    }
    return field;
  }

  LabelVolume volume_;
  int labels_;
  TestRandom& random_;
};

/// A rotation by a quaternion of small whole numbers: exact up to one rounding an entry.
inline Eigen::Matrix3d random_rotation(TestRandom& random) {
  std::array<double, 4> q{};
  while (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] == 0)
    for (double& c : q) c = random.below(9) - 4;
  const auto [w, x, y, z] = q;
  Eigen::Matrix3d r;
  r << w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),  //
      2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x),   //
      2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z;
  return r / (w * w + x * x + y * y + z * z);
}

/// Axes in any order and direction: one of the 48 symmetries of the cube.
inline constexpr int kAxisOrders = 48;
inline AxisOrder axis_order(int n) {
  constexpr std::array<std::array<int, 3>, 6> kOrders{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  return {kOrders[static_cast<std::size_t>(n / 8)], {(n & 1) != 0, (n & 2) != 0, (n & 4) != 0}};
}
inline Eigen::Matrix3d matrix_of(const AxisOrder& order) {
  Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
  for (std::size_t d = 0; d < 3; ++d) m(order.axis[d], static_cast<int>(d)) = order.reversed[d] ? -1 : 1;
  return m;
}

inline std::string set_random_affine(LabelVolume& volume, TestRandom& random) {
  constexpr std::array<double, 6> kRatios{1, 1.25, 1.5, 2, 3, 4};
  const int kind = random.below(4);
  Eigen::Vector3d spacing = Eigen::Vector3d::Constant(0.5 + 0.25 * random.below(7));
  if (kind > 0)
    for (int d = 0; d < 3; ++d)
      if (random.below(2)) spacing[d] *= kRatios[static_cast<std::size_t>(random.below(6))];
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  if (kind >= 2) axes = matrix_of(axis_order(random.below(kAxisOrders)));
  if (kind == 3) axes = random_rotation(random) * axes;
  volume.index_to_mm.topLeftCorner<3, 3>() = axes * spacing.asDiagonal();
  for (int d = 0; d < 3; ++d) volume.index_to_mm(d, 3) = 0.5 * random.below(400) - 100;
  return std::array{"axis", "anisotropic", "mirrored", "oblique"}[static_cast<std::size_t>(kind)];
}

/// Volume number `seed`: 6 to 16 voxels along each axis, 1 to 5 labels, at least one labelled voxel. In one
/// of four volumes the labels are 3, 8, 40, 300 and 65535 instead of 1 to 5.
inline RandomLabels random_labels(std::uint64_t seed) {
  TestRandom random(seed);
  std::array<int, 3> size{};
  for (int& n : size) n = 6 + random.below(11);
  const int labels = 1 + random.below(5), kind = random.below(static_cast<int>(kRandomKinds.size()));
  LabelPainter paint(size, labels, random);
  switch (kind) {
    case 0:
      paint.noise(std::array{3, 10, 25, 50, 75, 95}[static_cast<std::size_t>(random.below(6))], 1, labels);
      break;
    case 1: paint.blobs(0); break;
    case 2: paint.checkerboard(); break;
    case 3: paint.sheets(); break;
    case 4: paint.wires(1, labels); break;
    case 5:
      paint.solid(random.below(3));
      paint.wires(0, random.below(2) ? 0 : labels);
      break;
    case 6: paint.diagonals(); break;
    case 7:
      if (random.below(2))
        paint.blobs(1);
      else
        paint.noise(100, 1, labels);
      break;
    case 8:
      paint.border();
      if (random.below(2)) paint.noise(10, 0, labels);
      break;
    default: paint.nested();
  }
  paint.at_least_one_voxel();
  RandomLabels out{paint.take(), kRandomKinds[static_cast<std::size_t>(kind)], {}};
  if (random.below(4) == 0)
    for (Label& label : out.volume.labels) label = std::array<Label, 6>{0, 3, 8, 40, 300, 65535}[label];
  out.affine = set_random_affine(out.volume, random);
  return out;
}

}  // namespace voxtet::test
