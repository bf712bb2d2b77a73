#include "geometry/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxtet {
namespace {

constexpr std::uint32_t kLeafSize = 4;

double box_distance2(const Eigen::Vector3d& point, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  double sum = 0;
  for (int d = 0; d < 3; ++d) {
    const double outside = std::max({low[d] - point[d], 0.0, point[d] - high[d]});
    sum += outside * outside;
  }
  return sum;
}

}  // namespace

Eigen::Vector3d closest_on_triangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                    const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a, ap = point - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Eigen::Vector3d bp = point - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const Eigen::Vector3d cp = point - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double scale = 1 / (va + vb + vc);
  return a + vb * scale * ab + vc * scale * ac;
}

ClosestPointTree::ClosestPointTree(const std::vector<Eigen::Vector3d>& points,
                                   const std::vector<Triangle>& triangles) {
  corners_.reserve(triangles.size());
  std::vector<Eigen::Vector3d> centres;
  centres.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    corners_.push_back({points[t[0]], points[t[1]], points[t[2]]});
    centres.push_back((points[t[0]] + points[t[1]] + points[t[2]]) / 3);
  }
  order_.resize(triangles.size());
  for (std::uint32_t i = 0; i < order_.size(); ++i) order_[i] = i;
  nodes_.reserve(triangles.size());
  build(0, static_cast<std::uint32_t>(order_.size()), centres);
}

std::uint32_t ClosestPointTree::build(std::uint32_t first, std::uint32_t count,
                                      const std::vector<Eigen::Vector3d>& centres) {
  const auto id = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::max()), high = -low;
  Eigen::Vector3d centre_low = low, centre_high = high;
  for (std::uint32_t i = first; i < first + count; ++i) {
    for (const Eigen::Vector3d& corner : corners_[order_[i]]) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    centre_low = centre_low.cwiseMin(centres[order_[i]]);
    centre_high = centre_high.cwiseMax(centres[order_[i]]);
  }
  nodes_[id].low = low;
  nodes_[id].high = high;
  if (count <= kLeafSize) {
    nodes_[id].first = first;
    nodes_[id].count = count;
    return id;
  }
  Eigen::Index axis = 0;
  (centre_high - centre_low).maxCoeff(&axis);
  const std::uint32_t half = count / 2;
  std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count,
                   [&](std::uint32_t a, std::uint32_t b) {
                     return centres[a][axis] != centres[b][axis] ? centres[a][axis] < centres[b][axis] : a < b;
                   });
  build(first, half, centres);
  const std::uint32_t right = build(first + half, count - half, centres);
  nodes_[id].first = right;
  return id;
}

ClosestPointTree::Hit ClosestPointTree::closest(const Eigen::Vector3d& point, std::uint32_t hint) const {
  Hit best;
  double best2 = std::numeric_limits<double>::max();
  const auto try_triangle = [&](std::uint32_t triangle) {
    const auto& [a, b, c] = corners_[triangle];
    const Eigen::Vector3d on = closest_on_triangle(point, a, b, c);
    const double distance2 = (on - point).squaredNorm();
    if (distance2 < best2) {
      best2 = distance2;
      best = {on, triangle, 0};
    }
  };
  try_triangle(hint < corners_.size() ? hint : 0);
  // Nearer child first; the farther one waits on the stack with its distance. Depth is at most 32.
  std::array<std::pair<std::uint32_t, double>, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = {0, box_distance2(point, nodes_[0].low, nodes_[0].high)};
  while (depth > 0) {
    const auto [id, bound] = stack[--depth];
    if (bound >= best2) continue;
    const Node& node = nodes_[id];
    if (node.count > 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) try_triangle(order_[i]);
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
