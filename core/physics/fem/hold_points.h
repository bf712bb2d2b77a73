// Points whose value is held (Dirichlet conditions).
#pragma once

#include <vector>

#include "physics/fem/fixed_order.h"

namespace voxtet::fem {

/// Sets the rows and columns of held points to zero, except for the diagonal; `held` has one entry for each
/// point. A held point whose diagonal is 0, because all coefficients around it are, gets the diagonal 1. The
/// matrix stays symmetric, and positive definite if it was. If the right-hand side is zero at the held
/// points, the solution is a change that leaves their values as they are.
void hold_points(SparseMatrix& matrix, const std::vector<bool>& held);

}  // namespace voxtet::fem
