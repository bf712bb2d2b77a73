#include "physics/fem/assemble.h"

#include <gtest/gtest.h>

#include "geometry/elements/tet_measures.h"
#include "support/labelled_mesh.h"

namespace voxtet {
namespace {

double volume_of(const TetMesh& mesh) {
  double volume = 0;
  for (const Tet& tet : mesh.tets)
    volume +=
        tet_volume_mm3({mesh.points[tet[0]], mesh.points[tet[1]], mesh.points[tet[2]], mesh.points[tet[3]]});
  return volume;
}

/// The values of a linear function at the points.
Eigen::VectorXd linear(const TetMesh& mesh, const Eigen::Vector3d& slope) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(mesh.points.size()));
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    values[static_cast<Eigen::Index>(i)] = slope.dot(mesh.points[i]) + 2;
  return values;
}

Eigen::VectorXd product(const fem::SparseMatrix& matrix, const Eigen::VectorXd& x) {
  Eigen::VectorXd y;
  fem::multiply(matrix, x, y);
  return y;
}

Eigen::Matrix3d tensor() {
  Eigen::Matrix3d c;
  c << 3, 0.5, -0.2, 0.5, 2, 0.7, -0.2, 0.7, 1;
  return c;
}

TEST(Assemble, MassSumsToTheVolume) {
  const TetMesh mesh = test::kuhn_cube(4);
  const auto mass = fem::assemble_mass(mesh);
  const auto lumped = fem::assemble_lumped_mass(mesh);
  ASSERT_TRUE(mass.ok() && lumped.ok());
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(lumped->size());
  EXPECT_NEAR(fem::dot(ones, product(*mass, ones)), volume_of(mesh), 1e-10 * volume_of(mesh));
  EXPECT_NEAR(fem::dot(ones, *lumped), volume_of(mesh), 1e-10 * volume_of(mesh));
  EXPECT_LT((product(*mass, ones) - *lumped).cwiseAbs().maxCoeff(), 1e-12 * volume_of(mesh));
}

TEST(Assemble, MassIntegratesSquaresOfLinearFunctions) {
  // Over the one tetrahedron with corners 0 and 6 e_d: x^2 integrates to 6^5 * 2 / 5!.
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {0, 0, 6}};
  mesh.tets = {{0, 1, 2, 3}};
  mesh.labels = {1};
  const auto mass = fem::assemble_mass(mesh);
  ASSERT_TRUE(mass.ok());
  const Eigen::Vector4d x(0, 6, 0, 0);
  EXPECT_NEAR(fem::dot(x, product(*mass, x)), 7776 * 2 / 120.0, 1e-12);
}

TEST(Assemble, MatricesAreSymmetricToTheLastBit) {
  const TetMesh mesh = test::kuhn_cube(3);
  const std::vector<Eigen::Matrix3d> tensors(mesh.tets.size(), tensor());
  const auto stiffness = fem::assemble_stiffness(mesh, tensors);
  const auto mass = fem::assemble_mass(mesh);
  ASSERT_TRUE(stiffness.ok() && mass.ok());
  for (const fem::SparseMatrix* matrix : {&*stiffness, &*mass}) {
    const Eigen::MatrixXd dense(*matrix);
    EXPECT_TRUE(dense == dense.transpose());
  }
}

TEST(Assemble, StiffnessKillsConstantsAndIsExactForLinearFunctions) {
  const TetMesh mesh = test::kuhn_cube(4);
  const std::vector<Eigen::Matrix3d> tensors(mesh.tets.size(), tensor());
  const auto stiffness = fem::assemble_stiffness(mesh, tensors);
  ASSERT_TRUE(stiffness.ok());
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(stiffness->rows());
  EXPECT_LT(product(*stiffness, ones).cwiseAbs().maxCoeff(), 1e-11);

  const Eigen::Vector3d f(1, -2, 0.5), g(0.3, 1, 2);
  const double expected = volume_of(mesh) * f.dot(tensor() * g);
  EXPECT_NEAR(fem::dot(linear(mesh, f), product(*stiffness, linear(mesh, g))), expected,
              1e-10 * volume_of(mesh));
}

TEST(Assemble, ANumberIsThatNumberTimesTheUnitTensor) {
  const TetMesh mesh = test::kuhn_cube(3);
  std::vector<double> numbers;
  std::vector<Eigen::Matrix3d> tensors;
  for (const Label label : mesh.labels) {
    numbers.push_back(label == 1 ? 2.5 : 0.25);
    tensors.push_back(numbers.back() * Eigen::Matrix3d::Identity());
  }
  const auto scalar = fem::assemble_stiffness(mesh, numbers);
  const auto tensorial = fem::assemble_stiffness(mesh, tensors);
  ASSERT_TRUE(scalar.ok() && tensorial.ok());
  EXPECT_LT((Eigen::MatrixXd(*scalar) - Eigen::MatrixXd(*tensorial)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Assemble, RefusesAFlatTetrahedronAndTellsWhere) {
  TetMesh mesh = test::kuhn_cube(2);
  mesh.tets[5] = {mesh.tets[5][0], mesh.tets[5][1], mesh.tets[5][2], mesh.tets[5][2]};
  const auto mass = fem::assemble_mass(mesh);
  ASSERT_FALSE(mass.ok());
  EXPECT_EQ(mass.error().code, ErrorCode::kBadInput);
  EXPECT_EQ(mass.error().where.elements, std::vector<std::uint32_t>{5});
  EXPECT_NE(mass.error().message.find("tetrahedron 5"), std::string::npos) << mass.error().message;
  EXPECT_FALSE(fem::assemble_lumped_mass(mesh).ok());
}

TEST(Assemble, RefusesACoefficientTooFew) {
  const TetMesh mesh = test::kuhn_cube(2);
  const std::vector<double> numbers(mesh.tets.size() - 1, 1.0);
  const auto stiffness = fem::assemble_stiffness(mesh, numbers);
  ASSERT_FALSE(stiffness.ok());
  EXPECT_EQ(stiffness.error().code, ErrorCode::kInternal);
  EXPECT_NE(stiffness.error().message.find("found 47, expected one for each of 48"), std::string::npos)
      << stiffness.error().message;
}

}  // namespace
}  // namespace voxtet
