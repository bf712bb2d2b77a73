// How stiff a system of equations in time is.
#pragma once

#include <Eigen/Core>

#include "physics/fem/fixed_order.h"

namespace voxtet::fem {

/// The largest eigenvalue of M^-1 K for a symmetric positive semidefinite K and a diagonal M > 0, and 5 %
/// more: by 40 steps of the power iteration, which comes from below. du/dt = - M^-1 K u is stable by forward
/// Euler for steps up to 2 over it.
double largest_eigenvalue_bound(const SparseMatrix& k, const Eigen::VectorXd& mass);

}  // namespace voxtet::fem
