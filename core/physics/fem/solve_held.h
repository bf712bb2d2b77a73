// A system of equations with values that are held at some points.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "physics/fem/fixed_order.h"
#include "types/result.h"
#include "types/run_context.h"

namespace voxtet::fem {

/// The u that solves K u = b at all points but those held, which keep their values of `start`: by conjugate
/// gradients from `start`, to a relative residual of 1e-10. One entry of `b`, `held` and `start` for each row
/// of K, which is symmetric and positive semidefinite, and definite once those points are held (see
/// hold_points). Returns kCancelled in the name of `stage` soon after ctx.cancelled(), and errors of
/// PcgSolve.
Result<Eigen::VectorXd> solve_held(SparseMatrix k, const Eigen::VectorXd& b, const std::vector<bool>& held,
                                   const Eigen::VectorXd& start, const std::string& stage,
                                   const RunContext& ctx);

}  // namespace voxtet::fem
