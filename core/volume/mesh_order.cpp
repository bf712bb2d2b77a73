#include "volume/mesh_order.h"

#include <algorithm>
#include <utility>

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

Joined count_joined(const LabelVolume& volume) {
  Joined joined{};
  const std::array<std::size_t, 3> stride{1, volume.offset(0, 1, 0), volume.offset(0, 0, 1)};
  const auto score = [](Label own, Label opposite, Label a, Label b) -> std::ptrdiff_t {
    if (own != opposite || own == a || own == b) return 0;
    return own == kBackground ? -1 : 1;
  };
  for (std::size_t across = 0; across < 3; ++across) {
    const std::size_t u = (across + 1) % 3, v = (across + 2) % 3;
    std::array<int, 3> end = volume.size;
    --end[u], --end[v];
    for (int k = 0; k < end[2]; ++k)
      for (int j = 0; j < end[1]; ++j) {
        const Label* here = volume.labels.data() + volume.offset(0, j, k);
        for (int i = 0; i < end[0]; ++i, ++here) {
          const Label a = here[0], b = here[stride[u]], c = here[stride[v]], d = here[stride[u] + stride[v]];
          joined[across][0] += score(a, d, b, c);
          joined[across][1] += score(b, c, a, d);
        }
      }
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
