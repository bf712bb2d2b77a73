#include "physics/fem/hold_points.h"

namespace voxtet::fem {

void hold_points(SparseMatrix& matrix, const std::vector<bool>& held) {
  for (Eigen::Index row = 0; row < matrix.rows(); ++row)
    for (SparseMatrix::InnerIterator entry(matrix, row); entry; ++entry)
      if (entry.col() != row &&
          (held[static_cast<std::size_t>(row)] || held[static_cast<std::size_t>(entry.col())]))
        entry.valueRef() = 0;
}

}  // namespace voxtet::fem
