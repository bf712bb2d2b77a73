#include "geometry/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace voxtet {
namespace {

constexpr std::uint32_t kLeafSize = 4;
/// A box is passed over only when clearly farther: rounding must not hide an equally close triangle.
constexpr double kCaution = 1 + 1e-12;

double box_distance2(const Eigen::Vector3d& point, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  double sum = 0;
  for (int d = 0; d < 3; ++d) {
    const double outside = std::max({low[d] - point[d], 0.0, point[d] - high[d]});
    sum += outside * outside;
  }
  return sum;
}

}  // namespace

Eigen::Vector3d closest_on_triangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
                                    const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a, ap = point - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Eigen::Vector3d bp = point - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 > d3) return a + d1 / (d1 - d3) * ab;
  const Eigen::Vector3d cp = point - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0 && d2 > d6) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double scale = 1 / (va + vb + vc);
  return a + vb * scale * ab + vc * scale * ac;
}

ClosestPointTree::ClosestPointTree(const std::vector<Eigen::Vector3d>& points,
                                   const std::vector<Triangle>& triangles) {
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles)
    boxes.push_back(Eigen::AlignedBox3d(points[a]).extend(points[b]).extend(points[c]));
  order_.resize(triangles.size());
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.reserve(triangles.size());
  build(0, static_cast<std::uint32_t>(order_.size()), boxes);
  slot_.resize(triangles.size());
  corners_.reserve(triangles.size());
  for (std::uint32_t slot = 0; slot < order_.size(); ++slot) {
    const auto& [a, b, c] = triangles[order_[slot]];
    corners_.push_back({points[a], points[b], points[c]});
    slot_[order_[slot]] = slot;
  }
}

std::uint32_t ClosestPointTree::build(std::uint32_t first, std::uint32_t count,
                                      const std::vector<Eigen::AlignedBox3d>& boxes) {
  const auto id = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Eigen::AlignedBox3d box, centres;
  for (std::uint32_t i = first; i < first + count; ++i) {
    box.extend(boxes[order_[i]]);
    centres.extend(boxes[order_[i]].center());
  }
  nodes_[id].low = box.min();
  nodes_[id].high = box.max();
  if (count <= kLeafSize) {
    nodes_[id].first = first;
    nodes_[id].count = count;
    return id;
  }
  Eigen::Index axis = 0;
  centres.sizes().maxCoeff(&axis);
  const std::uint32_t half = count / 2;
  // Ties by index: the halves are then the same whichever way the standard library partitions.
  std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double x = boxes[a].min()[axis] + boxes[a].max()[axis];
                     const double y = boxes[b].min()[axis] + boxes[b].max()[axis];
                     return x != y ? x < y : a < b;
                   });
  build(first, half, boxes);
  const std::uint32_t right = build(first + half, count - half, boxes);
  nodes_[id].first = right;
  return id;
}

ClosestPointTree::Hit ClosestPointTree::closest(const Eigen::Vector3d& point, std::uint32_t hint) const {
  Hit best;
  double best2 = std::numeric_limits<double>::max();
  const auto try_slot = [&](std::uint32_t slot) {
    const auto& [a, b, c] = corners_[slot];
    const Eigen::Vector3d on = closest_on_triangle(point, a, b, c);
    const double distance2 = (on - point).squaredNorm();
    if (distance2 < best2 || (distance2 == best2 && order_[slot] < best.triangle)) {
      best2 = distance2;
      best = {on, order_[slot], 0};
    }
  };
  try_slot(slot_[hint < slot_.size() ? hint : 0]);
  // Nearer child first; the farther one waits on the stack with its distance. Depth is at most 32.
  std::array<std::pair<std::uint32_t, double>, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = {0, box_distance2(point, nodes_[0].low, nodes_[0].high)};
  while (depth > 0) {
    const auto [id, bound] = stack[--depth];
    if (bound > best2 * kCaution) continue;
    const Node& node = nodes_[id];
    if (node.count > 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) try_slot(i);
      continue;
    }
    const double left = box_distance2(point, nodes_[id + 1].low, nodes_[id + 1].high);
    const double right = box_distance2(point, nodes_[node.first].low, nodes_[node.first].high);
    if (left <= right) {
      stack[depth++] = {node.first, right};
      stack[depth++] = {id + 1, left};
    } else {
      stack[depth++] = {id + 1, left};
      stack[depth++] = {node.first, right};
    }
  }
  best.distance_mm = std::sqrt(best2);
  return best;
}

}  // namespace voxtet
