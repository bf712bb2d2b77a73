#include "volume/mesh_order.h"

#include <algorithm>
#include <cmath>

namespace voxtet {
namespace {

/// The axes nearest to right, anterior, superior.
AxisOrder patient_order(const LabelVolume& volume) {
  const Eigen::Matrix3d directions = volume.linear().colwise().normalized();
  AxisOrder best;
  double most = -1;
  std::array<int, 3> axis{0, 1, 2};
  do {
    double along = 0;
    for (int d = 0; d < 3; ++d) along += std::abs(directions(d, axis[static_cast<std::size_t>(d)]));
    if (along > most) most = along, best.axis = axis;
  } while (std::next_permutation(axis.begin(), axis.end()));
  for (int d = 0; d < 3; ++d)
    best.reversed[static_cast<std::size_t>(d)] = directions(d, best.axis[static_cast<std::size_t>(d)]) < 0;
  return best;
}

/// By plane, named by the axis across it: how many labels more than background would be joined across an edge
/// by a diagonal along which both indices rise, and by one along which one rises and the other falls.
using Joined = std::array<std::array<std::ptrdiff_t, 2>, 3>;

/// Adds one plane's squares of four voxels, the lowest ones of which lie in the row at `here`; along the row
/// where `u` is 1.
void count_row(const Label* here, int count, std::size_t u, std::size_t v,
               std::array<std::ptrdiff_t, 2>& out) {
  const auto score = [](Label joined) -> std::ptrdiff_t { return joined == kBackground ? -1 : 1; };
  for (const Label* const end = here + count; here != end; ++here) {
    const Label a = here[0], b = here[u], c = here[v], d = here[u + v];
    if (a == b || a == c || d == b || d == c) continue;
    if (a == d) out[0] += score(a);
    if (b == c) out[1] += score(b);
  }
}

Joined count_joined(const LabelVolume& volume) {
  Joined joined{};
  const auto [nx, ny, nz] = volume.size;
  const auto [to_x, to_y, to_z] = volume.strides();
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j) {
      const Label* here = volume.labels.data() + volume.offset(0, j, k);
      // Most rows are as the one beside them, and have nothing that counts.
      const bool other_y = j + 1 < ny && !std::equal(here, here + nx, here + to_y);
      const bool other_z = k + 1 < nz && !std::equal(here, here + nx, here + to_z);
      if (other_y && other_z) count_row(here, nx, to_y, to_z, joined[0]);
      if (other_z) count_row(here, nx - 1, to_x, to_z, joined[1]);
      if (other_y) count_row(here, nx - 1, to_x, to_y, joined[2]);
    }
  return joined;
}

}  // namespace

AxisOrder mesh_order(const LabelVolume& labels) {
  const AxisOrder patient = patient_order(labels);
  const Joined joined = count_joined(labels);
  AxisOrder best = patient;
  std::ptrdiff_t most = 0;
  for (const int backwards : {-1, 0, 1, 2}) {
    AxisOrder order = patient;
    if (backwards >= 0) order.reversed[static_cast<std::size_t>(backwards)] ^= true;
    std::ptrdiff_t found = 0;
    for (std::size_t d = 0; d < 3; ++d)
      found += joined[static_cast<std::size_t>(order.axis[d])]
                     [order.reversed[(d + 1) % 3] != order.reversed[(d + 2) % 3] ? 1 : 0];
    if (backwards < 0 || found > most) most = found, best = order;
  }
  return best;
}

LabelVolume reordered(const LabelVolume& volume, const AxisOrder& order) {
  LabelVolume out;
  out.infos = volume.infos;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();  // the old index of the new first voxel
  std::array<std::ptrdiff_t, 3> step{};             // in the old volume, along each new axis
  const std::array<std::ptrdiff_t, 3> stride{1, volume.size[0],
                                             static_cast<std::ptrdiff_t>(volume.offset(0, 0, 1))};
  for (std::size_t d = 0; d < 3; ++d) {
    const auto old = static_cast<std::size_t>(order.axis[d]);
    const int sign = order.reversed[d] ? -1 : 1;
    out.size[d] = volume.size[old];
    if (order.reversed[d]) first[static_cast<int>(old)] = volume.size[old] - 1;
    step[d] = sign * stride[old];
    // Plus zero, so that there is no negative one.
    out.index_to_mm.col(static_cast<int>(d)) =
        sign * volume.index_to_mm.col(static_cast<int>(old)) + Eigen::Vector4d::Zero();
  }
  out.index_to_mm.topRightCorner<3, 1>() = volume.to_mm(first);
  const std::size_t start =
      volume.offset(static_cast<int>(first[0]), static_cast<int>(first[1]), static_cast<int>(first[2]));
  out.labels.resize(volume.labels.size());
  std::size_t at = 0;
  for (int k = 0; k < out.size[2]; ++k)
    for (int j = 0; j < out.size[1]; ++j) {
      auto from = static_cast<std::ptrdiff_t>(start) + k * step[2] + j * step[1];
      for (int i = 0; i < out.size[0]; ++i, from += step[0])
        out.labels[at++] = volume.labels[static_cast<std::size_t>(from)];
    }
  return out;
}

}  // namespace voxtet
