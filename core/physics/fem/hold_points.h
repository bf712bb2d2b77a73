// Points whose value is held (Dirichlet conditions).
#pragma once

#include <vector>

#include "physics/fem/fixed_order.h"

namespace voxtet::fem {

/// Sets the rows and columns of held points to zero, but for the diagonal, which stays; `held` has one entry
/// for each point. The matrix stays symmetric, and positive definite if it was. With zeros at the held points
/// of the right-hand side the solution is the change that leaves them as they are.
void hold_points(SparseMatrix& matrix, const std::vector<bool>& held);

}  // namespace voxtet::fem
