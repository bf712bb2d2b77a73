#include "geometry/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxtet {
namespace {

constexpr std::uint32_t kLeafSize = 4;
/// A box is passed over only when clearly farther: rounding must not hide an equally close triangle.
constexpr double kCaution = 1 + 1e-12;

using Box = std::array<float, 6>;
constexpr Box kNothing{std::numeric_limits<float>::max(),    std::numeric_limits<float>::max(),
                       std::numeric_limits<float>::max(),    std::numeric_limits<float>::lowest(),
                       std::numeric_limits<float>::lowest(), std::numeric_limits<float>::lowest()};

float at_most(double value) {
  const auto nearest = static_cast<float>(value);
  return nearest <= value ? nearest : std::nextafter(nearest, std::numeric_limits<float>::lowest());
}

Box box_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  Box box{};
  for (std::size_t d = 0; d < 3; ++d) {
    const auto i = static_cast<Eigen::Index>(d);
    box[d] = at_most(std::min({a[i], b[i], c[i]}));
    box[d + 3] = -at_most(-std::max({a[i], b[i], c[i]}));
  }
  return box;
}

void extend(Box& box, const Box& other) {
  for (std::size_t d = 0; d < 3; ++d) {
    box[d] = std::min(box[d], other[d]);
    box[d + 3] = std::max(box[d + 3], other[d + 3]);
  }
}

double box_distance2(const Eigen::Vector3d& point, const Box& box) {
  const double x = std::max({box[0] - point.x(), 0.0, point.x() - box[3]});
  const double y = std::max({box[1] - point.y(), 0.0, point.y() - box[4]});
  const double z = std::max({box[2] - point.z(), 0.0, point.z() - box[5]});
  return x * x + y * y + z * z;
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
  std::vector<Box> boxes;
  std::vector<Item> items;
  boxes.reserve(triangles.size());
  items.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) {
    const Box box = box_of(points[a], points[b], points[c]);
    items.push_back(
        {{box[0] + box[3], box[1] + box[4], box[2] + box[5]}, static_cast<std::uint32_t>(boxes.size())});
    boxes.push_back(box);
  }
  nodes_.reserve(triangles.size() / 2);
  Box all = kNothing;
  root_ = build(items, 0, boxes, all);
  slot_.resize(triangles.size());
  order_.reserve(triangles.size());
  corners_.reserve(triangles.size());
  for (const Item& item : items) {
    const auto& [a, b, c] = triangles[item.triangle];
    slot_[item.triangle] = static_cast<std::uint32_t>(order_.size());
    order_.push_back(item.triangle);
    corners_.push_back({points[a], points[b], points[c]});
  }
}

ClosestPointTree::Child ClosestPointTree::build(std::span<Item> items, std::uint32_t first,
                                                const std::vector<Box>& boxes, Box& bounds) {
  const auto count = static_cast<std::uint32_t>(items.size());
  if (count <= kLeafSize) {
    std::sort(items.begin(), items.end(),
              [](const Item& a, const Item& b) { return a.triangle < b.triangle; });
    for (const Item& item : items) extend(bounds, boxes[item.triangle]);
    return {first, count};
  }
  std::array<float, 3> low = items.front().centre, high = low;
  for (const Item& item : items)
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], item.centre[d]);
      high[d] = std::max(high[d], item.centre[d]);
    }
  std::size_t axis = 0;
  for (const std::size_t d : {1U, 2U})
    if (high[d] - low[d] > high[axis] - low[axis]) axis = d;
  const std::uint32_t half = count / 2;
  // Ties by index: the halves are then the same whichever way the standard library partitions.
  std::nth_element(items.begin(), items.begin() + half, items.end(), [axis](const Item& a, const Item& b) {
    return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis] : a.triangle < b.triangle;
  });
  const auto id = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Node node{{kNothing, kNothing}, {}};
  node.children[0] = build(items.first(half), first, boxes, node.boxes[0]);
  node.children[1] = build(items.subspan(half), first + half, boxes, node.boxes[1]);
  for (const Box& box : node.boxes) extend(bounds, box);
  nodes_[id] = node;
  return {id, 0};
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
  std::array<std::pair<Child, double>, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = {root_, 0.0};
  while (depth > 0) {
    const auto [child, bound] = stack[--depth];
    if (bound > best2 * kCaution) continue;
    if (child.count > 0) {
      for (std::uint32_t i = child.first; i < child.first + child.count; ++i) try_slot(i);
      continue;
    }
    const Node& node = nodes_[child.first];
    const double left = box_distance2(point, node.boxes[0]), right = box_distance2(point, node.boxes[1]);
    const std::size_t near = left <= right ? 0 : 1;
    const double farther = std::max(left, right);
    if (farther <= best2 * kCaution) stack[depth++] = {node.children[1 - near], farther};
    stack[depth++] = {node.children[near], std::min(left, right)};
  }
  best.distance_mm = std::sqrt(best2);
  return best;
}

}  // namespace voxtet
