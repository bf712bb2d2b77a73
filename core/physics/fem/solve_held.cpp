#include "physics/fem/solve_held.h"

#include <utility>

#include "physics/fem/hold_points.h"
#include "physics/fem/solve_pcg.h"

namespace voxtet::fem {
namespace {

constexpr PcgParams kParams{1e-10, 20'000};
/// Iterations between two looks at whether the caller cancelled.
constexpr int kPart = 10;

}  // namespace

Result<Eigen::VectorXd> solve_held(SparseMatrix k, const Eigen::VectorXd& b, const std::vector<bool>& held,
                                   const Eigen::VectorXd& start, const std::string& stage,
                                   const RunContext& ctx) {
  // K (u - start) = b - K start, where u - start is 0 at held points.
  Eigen::VectorXd load;
  multiply(k, start, load);
  for (Eigen::Index i = 0; i < load.size(); ++i)
    load[i] = held[static_cast<std::size_t>(i)] ? 0 : b[i] - load[i];
  hold_points(k, held);
  auto solve = PcgSolve::start(k, load, Eigen::VectorXd::Zero(load.size()), kParams);
  if (!solve) return solve.error();
  for (;;) {
    const Result<bool> done = solve->iterate(k, kPart);
    if (!done) return done.error();
    if (*done) break;
    if (ctx.cancelled()) return cancelled_error(stage);
  }
  Eigen::VectorXd u = start;
  for (Eigen::Index i = 0; i < u.size(); ++i) u[i] += solve->x()[i];
  return u;
}

}  // namespace voxtet::fem
