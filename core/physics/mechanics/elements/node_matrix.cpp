#include "physics/mechanics/elements/node_matrix.h"

#include <algorithm>

namespace voxtet::mechanics {

fem::SparseMatrix empty_node_matrix(const std::vector<std::vector<std::uint32_t>>& neighbours) {
  Eigen::Index entries = 0;
  for (const auto& of_node : neighbours) entries += 9 * static_cast<Eigen::Index>(of_node.size());
  const auto size = 3 * static_cast<Eigen::Index>(neighbours.size());
  fem::SparseMatrix matrix(size, size);
  matrix.resizeNonZeros(entries);
  int* begin = matrix.outerIndexPtr();
  int* column = matrix.innerIndexPtr();
  int at = 0;
  *begin++ = 0;
  for (const auto& of_node : neighbours)
    for (int row = 0; row < 3; ++row) {
      for (const std::uint32_t node : of_node)
        for (int d = 0; d < 3; ++d) column[at++] = 3 * static_cast<int>(node) + d;
      *begin++ = at;
    }
  std::fill_n(matrix.valuePtr(), entries, 0.0);
  return matrix;
}

void add_block(std::uint32_t row, std::uint32_t column, const Eigen::Matrix3d& block,
               fem::SparseMatrix& matrix) {
  const int* begin = matrix.outerIndexPtr() + 3 * static_cast<std::ptrdiff_t>(row);
  const int* columns = matrix.innerIndexPtr();
  const auto offset = std::lower_bound(columns + begin[0], columns + begin[1], 3 * static_cast<int>(column)) -
                      columns - begin[0];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) matrix.valuePtr()[begin[i] + offset + j] += block(i, j);
}

}  // namespace voxtet::mechanics
