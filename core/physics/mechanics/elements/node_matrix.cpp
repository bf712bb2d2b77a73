#include "physics/mechanics/elements/node_matrix.h"

#include <algorithm>

namespace voxtet::mechanics {
namespace {

std::uint32_t place_in(NodeGroup ascending, std::uint32_t node) {
  return static_cast<std::uint32_t>(std::lower_bound(ascending.begin(), ascending.end(), node) -
                                    ascending.begin());
}

}  // namespace

NodeGraph::NodeGraph(std::size_t nodes, const std::vector<NodeGroup>& groups) {
  std::vector<std::vector<std::uint32_t>> near(nodes);
  for (const NodeGroup group : groups)
    for (const std::uint32_t node : group) near[node].insert(near[node].end(), group.begin(), group.end());
  for (auto& list : near) {
    std::sort(list.begin(), list.end());
    coupled_.insert(coupled_.end(), list.begin(), std::unique(list.begin(), list.end()));
    begin_.push_back(coupled_.size());
  }
}

void NodeGraph::append_places(NodeGroup group, std::vector<std::uint32_t>& places) const {
  for (const std::uint32_t a : group)
    for (const std::uint32_t b : group) places.push_back(place_in(of(a), b));
}

fem::SparseMatrix empty_node_matrix(const NodeGraph& graph, bool with_pressures) {
  const int nodes = static_cast<int>(graph.nodes()), per_node = with_pressures ? 4 : 3;
  const Eigen::Index size = per_node * static_cast<Eigen::Index>(nodes);
  fem::SparseMatrix matrix(size, size);
  matrix.resizeNonZeros(per_node * per_node * static_cast<Eigen::Index>(graph.couplings()));
  int* begin = matrix.outerIndexPtr();
  int* column = matrix.innerIndexPtr();
  int at = 0;
  *begin++ = 0;
  const auto add_row = [&](int i) {
    const NodeGroup coupled = graph.of(static_cast<std::size_t>(i));
    for (const std::uint32_t node : coupled)
      for (int d = 0; d < 3; ++d) column[at++] = 3 * static_cast<int>(node) + d;
    for (std::size_t k = 0; with_pressures && k < coupled.size(); ++k)
      column[at++] = 3 * nodes + static_cast<int>(coupled[k]);
    *begin++ = at;
  };
  for (int row = 0; row < 3 * nodes; ++row) add_row(row / 3);
  for (int i = 0; with_pressures && i < nodes; ++i) add_row(i);
  std::fill_n(matrix.valuePtr(), matrix.nonZeros(), 0.0);
  return matrix;
}

void add_block(std::uint32_t row, std::uint32_t column, const Eigen::Matrix3d& block,
               fem::SparseMatrix& matrix) {
  const int* const begin = matrix.outerIndexPtr() + 3 * static_cast<std::ptrdiff_t>(row);
  const int* const columns = matrix.innerIndexPtr();
  const auto offset = std::lower_bound(columns + begin[0], columns + begin[1], 3 * static_cast<int>(column)) -
                      columns - begin[0];
  add_block_at(row, static_cast<std::uint32_t>(offset / 3), block, matrix);
}

}  // namespace voxtet::mechanics
