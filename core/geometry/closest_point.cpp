#include "geometry/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxtet {
namespace {

constexpr std::uint32_t kLeafSize = 4;
/// A box is passed over only when clearly farther: rounding must not hide an equally close triangle.
constexpr double kCaution = 1 + 1e-12;

float at_most(double value) {
  const auto nearest = static_cast<float>(value);
  return nearest <= value ? nearest : std::nextafter(nearest, std::numeric_limits<float>::lowest());
}

float at_least(double value) {
  return -at_most(-value);
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
                                   std::span<const Triangle> triangles) {
  std::vector<Item> items;
  items.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) {
    Item item{{}, {}, static_cast<std::uint32_t>(items.size())};
    for (std::size_t d = 0; d < 3; ++d) {
      const auto i = static_cast<Eigen::Index>(d);
      item.low[d] = at_most(std::min({points[a][i], points[b][i], points[c][i]}));
      item.high[d] = at_least(std::max({points[a][i], points[b][i], points[c][i]}));
    }
    items.push_back(item);
  }
  nodes_.reserve(triangles.size() / 2);
  Item whole;
  root_ = build(items, 0, whole);

  constexpr std::uint32_t kNone = 0xffffffffU;
  std::vector<std::uint32_t> place(points.size(), kNone);
  slot_.resize(triangles.size());
  order_.reserve(triangles.size());
  triangles_.reserve(triangles.size());
  for (const Item& item : items) {
    slot_[item.triangle] = static_cast<std::uint32_t>(order_.size());
    order_.push_back(item.triangle);
    triangles_.push_back(triangles[item.triangle]);
    for (std::uint32_t& v : triangles_.back()) {
      if (place[v] == kNone) {
        place[v] = static_cast<std::uint32_t>(points_.size());
        points_.push_back(points[v]);
      }
      v = place[v];
    }
  }
}

ClosestPointTree::Child ClosestPointTree::build(std::span<Item> items, std::uint32_t first, Item& whole) {
  const auto extend = [](Item& bounds, const Item& item) {
    for (std::size_t d = 0; d < 3; ++d) {
      bounds.low[d] = std::min(bounds.low[d], item.low[d]);
      bounds.high[d] = std::max(bounds.high[d], item.high[d]);
    }
  };
  const auto count = static_cast<std::uint32_t>(items.size());
  whole = items.front();
  if (count <= kLeafSize) {
    std::sort(items.begin(), items.end(),
              [](const Item& a, const Item& b) { return a.triangle < b.triangle; });
    for (const Item& item : items) extend(whole, item);
    return {first, count};
  }
  const auto centre = [](const Item& item, std::size_t d) { return item.low[d] + item.high[d]; };
  std::array<float, 3> low{}, high{}, spread{};
  for (std::size_t d = 0; d < 3; ++d) low[d] = high[d] = centre(whole, d);
  for (const Item& item : items)
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], centre(item, d));
      high[d] = std::max(high[d], centre(item, d));
    }
  for (std::size_t d = 0; d < 3; ++d) spread[d] = high[d] - low[d];
  const auto axis = static_cast<std::size_t>(std::max_element(spread.begin(), spread.end()) - spread.begin());
  const std::uint32_t half = count / 2;
  // Ties by index: the halves are then the same whichever way the standard library partitions.
  std::nth_element(items.begin(), items.begin() + half, items.end(), [&](const Item& a, const Item& b) {
    const float x = centre(a, axis), y = centre(b, axis);
    return x != y ? x < y : a.triangle < b.triangle;
  });
  const auto id = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  std::array<Item, 2> bounds;
  const Child left = build(items.first(half), first, bounds[0]);
  const Child right = build(items.subspan(half), first + half, bounds[1]);
  nodes_[id] = {{box_of(bounds[0]), box_of(bounds[1])}, {left, right}};
  whole = bounds[0];
  extend(whole, bounds[1]);
  return {id, 0};
}

ClosestPointTree::Box ClosestPointTree::box_of(const Item& bounds) {
  Box box{};
  for (std::size_t d = 0; d < 3; ++d) {
    const double centre = box.centre[d] = 0.5F * (bounds.low[d] + bounds.high[d]);
    box.half[d] = at_least(std::max(bounds.high[d] - centre, centre - bounds.low[d]));
  }
  return box;
}

ClosestPointTree::Hit ClosestPointTree::closest(const Eigen::Vector3d& point, std::uint32_t hint) const {
  Hit best;
  double best2 = std::numeric_limits<double>::max();
  const auto try_slot = [&](std::uint32_t slot) {
    const Eigen::Vector3d on = closest_in_slot(slot, point);
    const double distance2 = (on - point).squaredNorm();
    if (distance2 < best2 || (distance2 == best2 && order_[slot] < best.triangle)) {
      best2 = distance2;
      best = {on, order_[slot], 0};
    }
  };
  const auto distance2_to = [&](const Box& box) {
    double sum = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const double outside =
          std::max(std::abs(point[static_cast<Eigen::Index>(d)] - box.centre[d]) - box.half[d], 0.0);
      sum += outside * outside;
    }
    return sum;
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
    const double left = distance2_to(node.boxes[0]), right = distance2_to(node.boxes[1]);
    const std::size_t near = left <= right ? 0 : 1;
    if (const double farther = std::max(left, right); farther <= best2 * kCaution)
      stack[depth++] = {node.children[1 - near], farther};
    stack[depth++] = {node.children[near], std::min(left, right)};
  }
  best.distance_mm = std::sqrt(best2);
  return best;
}

}  // namespace voxtet
