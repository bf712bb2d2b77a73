// Stacks of slices: thinned out of whole volumes, and shifted in their plane.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/test_random.h"
#include "types/label_volume.h"

namespace voxtet::test {

using Moves = std::vector<Eigen::Vector2d>;

/// Every `step`-th slice across an axis, from slice `first` on.
inline LabelVolume keep_every(const LabelVolume& full, int axis, int step, int first) {
  LabelVolume out;
  out.size = full.size;
  const std::size_t a = static_cast<std::size_t>(axis);
  out.size[a] = (full.size[a] - first + step - 1) / step;
  out.index_to_mm = full.index_to_mm;
  out.index_to_mm.block<3, 1>(0, axis) *= step;
  out.index_to_mm.block<3, 1>(0, 3) += first * full.linear().col(axis);
  out.labels.resize(out.voxel_count());
  out.visit([&](int i, int j, int k, std::size_t voxel) {
    std::array<int, 3> at{i, j, k};
    at[a] = first + step * at[a];
    out.labels[voxel] = full.at(at[0], at[1], at[2]);
  });
  return out;
}

inline bool has_labels(const LabelVolume& volume, int slice) {
  for (std::size_t v = volume.offset(0, 0, slice); v < volume.offset(0, 0, slice + 1); ++v)
    if (volume.labels[v] != kBackground) return true;
  return false;
}

/// Less their mean and their slope along the stack, which no stack shows.
inline void remove_lean(Moves& moves) {
  const double count = static_cast<double>(moves.size()), middle = (count - 1) / 2;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero(), slope = Eigen::Vector2d::Zero();
  double squares = 0;
  for (std::size_t k = 0; k < moves.size(); ++k) {
    const double place = static_cast<double>(k) - middle;
    mean += moves[k] / count;
    slope += place * moves[k];
    squares += place * place;
  }
  for (std::size_t k = 0; k < moves.size(); ++k)
    moves[k] -= mean + (static_cast<double>(k) - middle) / squares * slope;
}

/// Normal moves along both axes of the slices across z, by whole pixels.
inline Moves random_moves(const LabelVolume& volume, std::uint64_t seed, double deviation_mm) {
  TestRandom random(seed);
  const auto normal = [&] {  // nearly: the sum of twelve even numbers
    double sum = -6;
    for (int n = 0; n < 12; ++n) sum += random.below(1 << 20) / static_cast<double>(1 << 20);
    return sum;
  };
  const Eigen::Vector3d pixel = volume.spacing_mm();
  Moves out;
  for (int k = 0; k < volume.size[2]; ++k) {
    Eigen::Vector2d& move = out.emplace_back();
    for (int d = 0; d < 2; ++d) move[d] = pixel[d] * std::round(deviation_mm * normal() / pixel[d]);
  }
  return out;
}

/// The slices across z moved by whole pixels; the grid grows by as much on all four sides.
inline LabelVolume shifted(const LabelVolume& volume, const Moves& moves) {
  const Eigen::Vector3d pixel = volume.spacing_mm();
  const auto pixels = [&](std::size_t k, int d) {
    return static_cast<int>(std::lround(moves[k][d] / pixel[d]));
  };
  int room = 0;
  for (std::size_t k = 0; k < moves.size(); ++k)
    for (int d = 0; d < 2; ++d) room = std::max(room, std::abs(pixels(k, d)));
  LabelVolume out;
  out.infos = volume.infos;
  out.size = {volume.size[0] + 2 * room, volume.size[1] + 2 * room, volume.size[2]};
  out.index_to_mm = volume.index_to_mm;
  out.index_to_mm.block<3, 1>(0, 3) -= room * (volume.linear().col(0) + volume.linear().col(1));
  out.labels.assign(out.voxel_count(), kBackground);
  volume.visit([&](int i, int j, int k, std::size_t voxel) {
    const std::size_t slice = static_cast<std::size_t>(k);
    out.labels[out.offset(i + room + pixels(slice, 0), j + room + pixels(slice, 1), k)] =
        volume.labels[voxel];
  });
  return out;
}

}  // namespace voxtet::test
