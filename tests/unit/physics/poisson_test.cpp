// Stiffness, mass, held points and solver together: Poisson's equation against a solution in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "physics/fem/assemble.h"
#include "physics/fem/hold_points.h"
#include "physics/fem/solve_pcg.h"
#include "support/slab_wall.h"

namespace voxtet {
namespace {

/// u = a(x) a(y) a(z) with a(s) = 4 s (1 - s), s from 0 to 1 across the slab: 0 on its surface, 1 in its
/// middle.
struct Solution {
  Eigen::Vector3d size{20, 20, test::kSlabThickness};

  /// One factor of u in dimension d, differentiated `order` times by mm.
  double factor(const Eigen::Vector3d& p, int d, int order) const {
    const double s = p[d] / size[d];
    if (order == 0) return 4 * s * (1 - s);
    return order == 1 ? 4 * (1 - 2 * s) / size[d] : -8 / (size[d] * size[d]);
  }
  double value(const Eigen::Vector3d& p) const { return factor(p, 0, 0) * factor(p, 1, 0) * factor(p, 2, 0); }
  /// - div (c grad u)
  double source(const Eigen::Vector3d& p, const Eigen::Matrix3d& c) const {
    double sum = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        double second = c(i, j);
        for (int d = 0; d < 3; ++d) second *= factor(p, d, (d == i) + (d == j));
        sum -= second;
      }
    return sum;
  }
};

/// The error in L2, relative to the root of the volume, with n bricks along each edge of the slab.
double error_at(int n) {
  const TetMesh mesh = test::slab(n, n);
  const Solution solution;
  Eigen::Matrix3d c;
  c << 3, 0.5, -0.2, 0.5, 2, 0.3, -0.2, 0.3, 1;
  const auto count = static_cast<Eigen::Index>(mesh.points.size());
  Eigen::VectorXd source(count), exact(count), load;
  std::vector<bool> held;
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector3d& p = mesh.points[static_cast<std::size_t>(i)];
    source[i] = solution.source(p, c);
    exact[i] = solution.value(p);
    held.push_back((p.array() == 0).any() || (p.array() == solution.size.array()).any());
  }
  auto stiffness = fem::assemble_stiffness(mesh, std::vector<Eigen::Matrix3d>(mesh.tets.size(), c)).value();
  const auto mass = fem::assemble_mass(mesh).value();
  fem::multiply(mass, source, load);
  for (Eigen::Index i = 0; i < count; ++i)
    if (held[static_cast<std::size_t>(i)]) load[i] = 0;
  fem::hold_points(stiffness, held);
  const fem::PcgParams params;
  fem::PcgSolve solve = fem::PcgSolve::start(stiffness, load, Eigen::VectorXd::Zero(count), params).value();
  const Result<bool> solved = solve.iterate(stiffness, params.max_iterations);
  if (!solved) {
    ADD_FAILURE() << solved.error().message;
    return 0;
  }
  const Eigen::VectorXd error = solve.x() - exact;
  Eigen::VectorXd weighted;
  fem::multiply(mass, error, weighted);
  return std::sqrt(fem::dot(error, weighted) / solution.size.prod());
}

TEST(Poisson, ErrorFallsWithTheSquareOfTheEdge) {
  const double coarse = error_at(6), middle = error_at(12), fine = error_at(24);
  EXPECT_LT(fine, 5e-3);
  EXPECT_NEAR(std::log2(middle / fine), 2, 0.15) << coarse << ' ' << middle << ' ' << fine;
  EXPECT_GT(std::log2(coarse / middle), 1.6);
}

}  // namespace
}  // namespace voxtet
