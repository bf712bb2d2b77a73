#include "physics/fem/solve_pcg.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>

#include "base/digest.h"
#include "physics/fem/assemble.h"
#include "support/labelled_mesh.h"

namespace voxtet {
namespace {

/// Mass and stiffness of the cube of cubes, and a right-hand side without symmetry.
struct System {
  fem::SparseMatrix matrix;
  Eigen::VectorXd b;

  System() {
    const TetMesh mesh = test::kuhn_cube(6);
    std::vector<double> coefficient;
    for (const Label label : mesh.labels) coefficient.push_back(label == 1 ? 20 : 0.5);
    matrix = fem::assemble_stiffness(mesh, coefficient).value() + fem::assemble_mass(mesh).value();
    matrix.makeCompressed();
    b.resize(matrix.rows());
    for (Eigen::Index i = 0; i < b.size(); ++i) b[i] = static_cast<double>((i * i + 7 * i) % 31) - 11;
  }
  Eigen::VectorXd zero() const { return Eigen::VectorXd::Zero(b.size()); }
};

Result<fem::PcgSolve> solve(const fem::SparseMatrix& a, const Eigen::VectorXd& b, const Eigen::VectorXd& x0,
                            const fem::PcgParams& params) {
  Result<fem::PcgSolve> solve = fem::PcgSolve::start(a, b, x0, params);
  if (!solve) return solve;
  const Result<bool> done = solve->iterate(a, params.max_iterations);
  if (!done) return done.error();
  EXPECT_TRUE(*done);
  return solve;
}

TEST(SolvePcg, AgreesWithADirectSolver) {
  const System system;
  const auto solved = solve(system.matrix, system.b, system.zero(), {1e-12, 1000});
  ASSERT_TRUE(solved.ok()) << solved.error().message;
  const Eigen::SparseMatrix<double> columns = system.matrix;
  const Eigen::VectorXd direct = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(columns).solve(system.b);
  EXPECT_LT((solved->x() - direct).norm(), 1e-9 * direct.norm());
  EXPECT_GT(solved->iterations(), 5);
  EXPECT_LT(solved->iterations(), 100);
}

TEST(SolvePcg, TheSolutionNeedsNoIteration) {
  const System system;
  const auto solved = solve(system.matrix, system.b, system.zero(), {1e-12, 1000});
  ASSERT_TRUE(solved.ok());
  const auto again = solve(system.matrix, system.b, solved->x(), {1e-10, 1000});
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(again->iterations(), 0);
  EXPECT_EQ(again->x(), solved->x());
  const auto nothing = solve(system.matrix, system.zero(), system.b, {});
  ASSERT_TRUE(nothing.ok());
  EXPECT_EQ(nothing->x(), system.zero());
}

TEST(SolvePcg, SameBytesOnEveryPlatform) {
  const System system;
  const auto solved = solve(system.matrix, system.b, system.zero(), {1e-8, 1000});
  ASSERT_TRUE(solved.ok());
  Sha256 sha;
  sha.update_values(solved->x().data(), static_cast<std::size_t>(solved->x().size()));
  EXPECT_EQ(sha.hex(), "bfd7eebeab4209395a50d08ce2543045c387a4c0692c8251fc6cc3f1df1fc245");
}

TEST(SolvePcg, SameBytesHoweverItIsCut) {
  const System system;
  const auto whole = solve(system.matrix, system.b, system.zero(), {});
  ASSERT_TRUE(whole.ok());
  for (const int iterations : {1, 2, 7}) {
    fem::PcgSolve cut = fem::PcgSolve::start(system.matrix, system.b, system.zero(), {}).value();
    int parts = 0;
    for (bool done = false; !done; ++parts) {
      // A value: what is copied goes on like the first.
      fem::PcgSolve copy = cut;
      const Result<bool> iterated = copy.iterate(system.matrix, iterations);
      ASSERT_TRUE(iterated.ok());
      done = *iterated;
      cut = copy;
    }
    EXPECT_EQ(cut.iterations(), whole->iterations());
    EXPECT_EQ(parts, (whole->iterations() + iterations - 1) / iterations) << iterations;
    EXPECT_EQ(cut.x(), whole->x()) << iterations;
  }
}

TEST(SolvePcg, StartsAgainInSomeRowsAlone) {
  const System system;
  const auto count = static_cast<int>(system.b.size());
  fem::PcgSolve solve = fem::PcgSolve::start(system.matrix, system.b, system.zero(), {}).value();
  ASSERT_TRUE(*solve.iterate(system.matrix, 1000));
  const fem::RowRanges rows{{3, 40}, {100, 101}, {200, count}};
  // A direct solve with all other rows and columns emptied.
  Eigen::MatrixXd part = Eigen::MatrixXd::Identity(count, count);
  Eigen::VectorXd b = system.zero();
  const Eigen::MatrixXd whole = system.matrix;
  for (const auto [first, last] : rows) {
    b.segment(first, last - first) = system.b.segment(first, last - first);
    for (const auto [from, to] : rows)
      part.block(first, from, last - first, to - from) = whole.block(first, from, last - first, to - from);
  }
  const Eigen::VectorXd direct = part.ldlt().solve(b);
  solve.start_again(system.matrix, system.b, system.zero(), rows);
  ASSERT_TRUE(*solve.iterate(system.matrix, 1000));
  EXPECT_LT((solve.x() - direct).norm(), 1e-8 * direct.norm());
  // What is solved already is left as it is.
  solve.start_again(system.matrix, system.b, direct, rows);
  ASSERT_TRUE(*solve.iterate(system.matrix, 1000));
  EXPECT_EQ(solve.iterations(), 0);
  EXPECT_EQ(solve.take_x(), direct);
  // And the next start does not see the one before.
  solve.start_again(system.matrix, system.b, system.zero(), {{0, count}});
  ASSERT_TRUE(*solve.iterate(system.matrix, 1000));
  fem::PcgSolve fresh = fem::PcgSolve::start(system.matrix, system.b, system.zero(), {}).value();
  ASSERT_TRUE(*fresh.iterate(system.matrix, 1000));
  EXPECT_EQ(solve.x(), fresh.x());
}

TEST(SolvePcg, TellsWhenItDoesNotConverge) {
  const System system;
  const auto solved = solve(system.matrix, system.b, system.zero(), {1e-10, 3});
  ASSERT_FALSE(solved.ok());
  EXPECT_EQ(solved.error().code, ErrorCode::kInternal);
  EXPECT_NE(solved.error().message.find("after 3 iterations"), std::string::npos) << solved.error().message;
}

TEST(SolvePcg, RefusesWhatIsNotPositiveDefinite) {
  fem::SparseMatrix matrix(2, 2);
  matrix.insert(0, 0) = 1;
  matrix.insert(0, 1) = matrix.insert(1, 0) = 2;
  matrix.insert(1, 1) = 1;
  matrix.makeCompressed();
  const auto indefinite = solve(matrix, Eigen::Vector2d(1, -1), Eigen::Vector2d::Zero(), {});
  ASSERT_FALSE(indefinite.ok());
  EXPECT_NE(indefinite.error().message.find("found -2"), std::string::npos) << indefinite.error().message;
  matrix.coeffRef(1, 1) = 0;
  EXPECT_FALSE(solve(matrix, Eigen::Vector2d(1, -1), Eigen::Vector2d::Zero(), {}).ok());
}

TEST(SolvePcg, RefusesSizesThatDiffer) {
  const System system;
  const auto solved = solve(system.matrix, Eigen::Vector2d(1, 1), system.zero(), {});
  ASSERT_FALSE(solved.ok());
  EXPECT_NE(solved.error().message.find("2 values of b"), std::string::npos) << solved.error().message;
}

}  // namespace
}  // namespace voxtet
