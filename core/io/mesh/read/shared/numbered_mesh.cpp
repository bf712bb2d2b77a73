#include "io/mesh/read/shared/numbered_mesh.h"

#include <algorithm>
#include <string>
#include <utility>

namespace voxtet {
namespace {

/// The permutation that sorts `tags`; fails where one comes twice.
std::vector<std::uint32_t> sorted_by_tag(MeshCursor& in, const std::vector<std::uint64_t>& tags,
                                         const char* what) {
  std::vector<std::uint32_t> order(tags.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(i);
  if (!std::is_sorted(tags.begin(), tags.end()))
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return tags[a] < tags[b]; });
  for (std::size_t i = 1; i < order.size() && in.ok(); ++i)
    if (tags[order[i - 1]] == tags[order[i]])
      in.fail(std::string(what) + " tag " + std::to_string(tags[order[i]]) + " comes twice");
  return order;
}

/// Node tag -> index of the point, by subtraction where tags are without gaps.
class NodeIndex {
 public:
  explicit NodeIndex(std::vector<std::uint64_t> ascending) : tags_(std::move(ascending)) {
    dense_ = !tags_.empty() && tags_.back() - tags_.front() + 1 == tags_.size();
  }
  /// Index, or the number of nodes where no node has this tag.
  std::size_t find(std::uint64_t tag) const {
    if (dense_) return tag < tags_.front() || tag > tags_.back() ? tags_.size() : tag - tags_.front();
    const auto at = std::lower_bound(tags_.begin(), tags_.end(), tag);
    return at == tags_.end() || *at != tag ? tags_.size() : static_cast<std::size_t>(at - tags_.begin());
  }
  std::size_t size() const { return tags_.size(); }

 private:
  std::vector<std::uint64_t> tags_;
  bool dense_ = false;
};

}  // namespace

TetMesh assemble(MeshCursor& in, NumberedMesh& numbered) {
  TetMesh mesh;
  const std::vector<std::uint32_t> node_order = sorted_by_tag(in, numbered.node_tags, "node");
  const std::vector<std::uint32_t> tet_order = sorted_by_tag(in, numbered.tet_tags, "element");
  if (!in.ok()) return mesh;
  std::vector<std::uint64_t> tags;
  tags.reserve(node_order.size());
  mesh.points.reserve(node_order.size());
  for (const std::uint32_t node : node_order) {
    tags.push_back(numbered.node_tags[node]);
    mesh.points.push_back(numbered.nodes[node]);
  }
  const NodeIndex index(std::move(tags));
  mesh.tets.reserve(tet_order.size());
  std::vector<std::int64_t> labels;
  labels.reserve(tet_order.size());
  for (const std::uint32_t t : tet_order) {
    Tet tet{};
    for (std::size_t c = 0; c < 4; ++c) {
      const std::size_t point = index.find(numbered.tets[t][c]);
      if (point == index.size()) {
        in.fail("element " + std::to_string(numbered.tet_tags[t]) + ": node " +
                std::to_string(numbered.tets[t][c]) + " is not among the " + std::to_string(index.size()) +
                " nodes of the file");
        return mesh;
      }
      tet[c] = static_cast<std::uint32_t>(point);
    }
    mesh.tets.push_back(tet);
    labels.push_back(numbered.labels[t]);
  }
  numbered.labels = std::move(labels);
  return mesh;
}

}  // namespace voxtet
