#include "geometry/intersect/self_intersections.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "geometry/intersect/triangle_intersection.h"
#include "geometry/search/morton_curve.h"

namespace voxtet {
namespace {

constexpr std::size_t kLeafSize = 8;
constexpr std::size_t kFanOut = 4;

/// Along a curve through space; none of no triangles.
std::vector<std::uint32_t> order_of_triangles(const SurfaceMesh& surface) {
  if (surface.triangles.empty()) return {};
  return MortonCurve(surface.points).order(surface.triangles.size(), [&](std::size_t t) {
    const auto& [a, b, c] = surface.triangles[t];
    return Eigen::Vector3d((surface.points[a] + surface.points[b] + surface.points[c]) / 3);
  });
}

template <class Box>
void grow(Box& box, const Box& other) {
  for (std::size_t d = 0; d < 3; ++d) {
    box.low[d] = std::min(box.low[d], other.low[d]);
    box.high[d] = std::max(box.high[d], other.high[d]);
  }
}

template <class Box>
bool overlap(const Box& a, const Box& b) {
  // One branch instead of six that nobody can predict.
  const auto reaches = [](auto low, auto high) { return static_cast<int>(low <= high); };
  return (reaches(a.low[0], b.high[0]) & reaches(b.low[0], a.high[0]) & reaches(a.low[1], b.high[1]) &
          reaches(b.low[1], a.high[1]) & reaches(a.low[2], b.high[2]) & reaches(b.low[2], a.high[2])) != 0;
}

}  // namespace

/// Pairs that the leaves [first, last) make with themselves and with later leaves.
class SelfIntersectionTree::Search {
 public:
  Search(const SelfIntersectionTree& tree, std::span<const std::uint8_t> concerned, std::size_t max_pairs)
      : tree_(tree), concerned_(concerned), max_pairs_(max_pairs) {}

  std::vector<TrianglePair> run(std::size_t first, std::size_t last) {
    for (std::size_t leaf = first; leaf < last && pairs_.size() < max_pairs_; ++leaf) {
      leaf_ = leaf;
      visit(tree_.levels_.size() - 1, 0, tree_.levels_.back().size());
    }
    return std::move(pairs_);
  }

 private:
  void visit(std::size_t level, std::size_t first, std::size_t last) {
    const std::vector<Node>& nodes = tree_.levels_[level];
    const Node& own = tree_.levels_[0][leaf_];
    std::size_t leaves = 1;  // below a node
    for (std::size_t l = 0; l < level; ++l) leaves *= kFanOut;
    for (std::size_t node = std::max(first, leaf_ / leaves); node < last; ++node) {
      if (!(own.concerned || nodes[node].concerned) || !overlap(own.box, nodes[node].box)) continue;
      if (level == 0)
        compare_leaf(node, nodes[node].box);
      else
        visit(level - 1, kFanOut * node, std::min(kFanOut * (node + 1), tree_.levels_[level - 1].size()));
    }
  }

  void compare_leaf(std::size_t other, const Box& box) {
    const std::size_t end = std::min(kLeafSize * (leaf_ + 1), tree_.order_.size());
    const std::size_t other_end = std::min(kLeafSize * (other + 1), tree_.order_.size());
    for (std::size_t i = kLeafSize * leaf_; i < end; ++i) {
      if (!overlap(tree_.boxes_[i], box)) continue;
      for (std::size_t j = std::max(i + 1, kLeafSize * other); j < other_end; ++j)
        if (overlap(tree_.boxes_[i], tree_.boxes_[j])) compare(tree_.order_[i], tree_.order_[j]);
    }
  }

  void compare(std::uint32_t a, std::uint32_t b) {
    if (!concerned_.empty() && !concerned_[a] && !concerned_[b]) return;
    const SurfaceMesh& surface = tree_.surface_;
    if (pairs_.size() < max_pairs_ &&
        triangles_intersect(surface.points, surface.triangles[a], surface.triangles[b]))
      pairs_.push_back({std::min(a, b), std::max(a, b)});
  }

  const SelfIntersectionTree& tree_;
  std::span<const std::uint8_t> concerned_;
  std::size_t max_pairs_, leaf_ = 0;
  std::vector<TrianglePair> pairs_;
};

SelfIntersectionTree::SelfIntersectionTree(const SurfaceMesh& surface, int threads)
    : surface_(surface), threads_(threads), order_(order_of_triangles(surface)), boxes_(order_.size()) {
  std::size_t count = order_.size(), per_node = kLeafSize;
  do {
    count = (count + per_node - 1) / per_node;
    levels_.emplace_back(count);
    per_node = kFanOut;
  } while (count > kFanOut);
}

void SelfIntersectionTree::measure(std::span<const std::uint8_t> concerned) {
  parallel_for(threads_, levels_[0].size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t leaf = first; leaf < last; ++leaf) {
      Node& node = levels_[0][leaf];
      node.concerned = concerned.empty();
      const std::size_t begin = kLeafSize * leaf, end = std::min(begin + kLeafSize, order_.size());
      for (std::size_t slot = begin; slot < end; ++slot) {
        const Triangle& t = surface_.triangles[order_[slot]];
        const Eigen::Vector3d &p = surface_.points[t[0]], &q = surface_.points[t[1]],
                              &r = surface_.points[t[2]];
        for (int d = 0; d < 3; ++d) {
          boxes_[slot].low[d] = std::min({p[d], q[d], r[d]});
          boxes_[slot].high[d] = std::max({p[d], q[d], r[d]});
        }
        if (slot == begin)
          node.box = boxes_[slot];
        else
          grow(node.box, boxes_[slot]);
        node.concerned = node.concerned || (!concerned.empty() && concerned[order_[slot]] != 0);
      }
    }
  });
  for (std::size_t level = 1; level < levels_.size(); ++level)
    for (std::size_t i = 0; i < levels_[level].size(); ++i) {
      const std::vector<Node>& below = levels_[level - 1];
      Node& node = levels_[level][i] = below[kFanOut * i];
      for (std::size_t c = kFanOut * i + 1; c < std::min(kFanOut * (i + 1), below.size()); ++c) {
        grow(node.box, below[c].box);
        node.concerned = node.concerned || below[c].concerned;
      }
    }
}

std::vector<TrianglePair> SelfIntersectionTree::find(std::span<const std::uint8_t> concerned,
                                                     std::size_t max_pairs, const RunContext& ctx) {
  measure(concerned);
  constexpr std::size_t kLeavesAPart = 2048;
  const std::size_t leaves = levels_[0].size(), parts = (leaves + kLeavesAPart - 1) / kLeavesAPart;
  std::vector<std::vector<TrianglePair>> found(parts);
  parallel_for(threads_, parts, [&](std::size_t first, std::size_t last) {
    for (std::size_t part = first; part < last && !ctx.cancelled(); ++part)
      found[part] = Search(*this, concerned, max_pairs)
                        .run(kLeavesAPart * part, std::min(kLeavesAPart * (part + 1), leaves));
  });
  std::vector<TrianglePair> pairs;
  for (const std::vector<TrianglePair>& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
  if (pairs.size() > max_pairs) pairs.resize(max_pairs);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<TrianglePair> find_self_intersections(const SurfaceMesh& surface, std::size_t max_pairs,
                                                  int threads) {
  return SelfIntersectionTree(surface, threads).find({}, max_pairs);
}

}  // namespace voxtet
