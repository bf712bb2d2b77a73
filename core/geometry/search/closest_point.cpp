#include "geometry/search/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxtet {
namespace {

constexpr std::uint32_t kLeafTriangles = 4;
/// A box is passed over only when clearly farther: the rounding of single precision, in which boxes are
/// compared, must not hide an equally close triangle.
constexpr float kCaution = 1.00001F, kRounding = 1e-6F;

float at_most(double value) {
  const auto nearest = static_cast<float>(value);
  return nearest <= value ? nearest : std::nextafter(nearest, std::numeric_limits<float>::lowest());
}

}  // namespace

ClosestPointTree::ClosestPointTree(const std::vector<Eigen::Vector3d>& points,
                                   std::span<const Triangle> triangles) {
  std::vector<Item> items;
  items.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) {
    Item item{{}, {}, static_cast<std::uint32_t>(items.size())};
    for (std::size_t d = 0; d < 3; ++d) {
      const auto i = static_cast<Eigen::Index>(d);
      item.low[d] = at_most(std::min({points[a][i], points[b][i], points[c][i]}));
      item.high[d] = -at_most(-std::max({points[a][i], points[b][i], points[c][i]}));
      margin_ = std::max({margin_, -item.low[d] * kRounding, item.high[d] * kRounding});
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
        given_points_.push_back(v);
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
  if (count <= kLeafTriangles) {
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
  Node node{{}, {}, {left, right}};
  for (std::size_t i = 0; i < 6; ++i) {
    const float from = bounds[i / 3].low[i % 3], to = bounds[i / 3].high[i % 3];
    node.centre[i] = 0.5F * (from + to);
    node.half[i] = std::max(to - node.centre[i], node.centre[i] - from) + margin_;
  }
  nodes_[id] = node;
  whole = bounds[0];
  extend(whole, bounds[1]);
  return {id, 0};
}

ClosestPointTree::Hit ClosestPointTree::closest(const Eigen::Vector3d& point, std::uint32_t hint,
                                                double content_mm) const {
  const double content2 = content_mm * content_mm;
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
  try_slot(slot_[hint < slot_.size() ? hint : 0]);
  std::array<float, 6> twice, outside;
  for (std::size_t i = 0; i < 6; ++i) twice[i] = static_cast<float>(point[static_cast<Eigen::Index>(i % 3)]);
  // Nearer child first; the farther one waits on the stack with its distance. Depth is at most 32.
  struct Waiting {
    Child child;
    float bound2;
  };
  std::array<Waiting, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = {root_, 0};
  while (depth > 0 && best2 >= content2) {
    const auto [child, bound2] = stack[--depth];
    const float enough = static_cast<float>(best2) * kCaution;
    if (bound2 > enough) continue;
    if (child.count > 0) {
      for (std::uint32_t i = child.first; i < child.first + child.count; ++i) try_slot(i);
      continue;
    }
    const Node& node = nodes_[child.first];
    for (std::size_t i = 0; i < 6; ++i) {
      const float d = std::abs(twice[i] - node.centre[i]) - node.half[i];
      outside[i] = d > 0 ? d * d : 0;
    }
    const float left = outside[0] + outside[1] + outside[2], right = outside[3] + outside[4] + outside[5];
    const std::size_t near = left <= right ? 0 : 1;
    if (const float farther = std::max(left, right); farther <= enough)
      stack[depth++] = {node.children[1 - near], farther};
    stack[depth++] = {node.children[near], std::min(left, right)};
  }
  best.distance_mm = std::sqrt(best2);
  return best;
}

}  // namespace voxtet
