#include "physics/fem/hold_points.h"

namespace voxtet::fem {

void hold_points(SparseMatrix& matrix, const std::vector<bool>& held) {
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    for (SparseMatrix::InnerIterator entry(matrix, row); entry; ++entry) {
      const bool row_held = held[static_cast<std::size_t>(row)];
      if (entry.col() != row && (row_held || held[static_cast<std::size_t>(entry.col())]))
        entry.valueRef() = 0;
      else if (row_held && entry.value() == 0)
        entry.valueRef() = 1;
    }
}

}  // namespace voxtet::fem
