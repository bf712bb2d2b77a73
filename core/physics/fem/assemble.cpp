#include "physics/fem/assemble.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "physics/fem/element.h"
#include "physics/fem/point_tets.h"

namespace voxtet::fem {
namespace {

using ElementMatrix = std::array<std::array<double, 4>, 4>;

std::optional<Error> check_mesh(const TetMesh& mesh) {
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const double volume = element_of(mesh, t).volume;
    if (volume > 0) continue;
    const Eigen::Vector3d& p = mesh.points[mesh.tets[t][0]];
    return Error{ErrorCode::kBadInput,
                 "fem",
                 "tetrahedron " + std::to_string(t) + " of the mesh: found a volume of " +
                     std::to_string(volume) + " mm^3, expected more than 0",
                 {{p}, {static_cast<std::uint32_t>(t)}}};
  }
  return std::nullopt;
}

std::optional<Error> check_count(const TetMesh& mesh, std::size_t coefficients) {
  if (coefficients == mesh.tets.size()) return std::nullopt;
  return Error{ErrorCode::kInternal,
               "fem",
               "coefficients of the stiffness: found " + std::to_string(coefficients) +
                   ", expected one for each of " + std::to_string(mesh.tets.size()) + " tetrahedra",
               {}};
}

/// Adds the matrices that `element_matrix(t)` gives, in the order of the tetrahedra.
template <class ElementMatrixOf>
Status add_elements(const TetMesh& mesh, SparseMatrix& matrix, ElementMatrixOf&& element_matrix) {
  if (const auto error = check_mesh(mesh)) return *error;
  const int* const row_begin = matrix.outerIndexPtr();
  const int* const column = matrix.innerIndexPtr();
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const ElementMatrix local = element_matrix(t);
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t row = mesh.tets[t][i];
      for (std::size_t j = 0; j < 4; ++j) {
        const int* const at = std::lower_bound(column + row_begin[row], column + row_begin[row + 1],
                                               static_cast<int>(mesh.tets[t][j]));
        matrix.valuePtr()[at - column] += local[i][j];
      }
    }
  }
  return std::monostate{};
}

/// The element's stiffness from c grad phi_i, the flux of each of its functions.
ElementMatrix element_stiffness(const Element& element, const std::array<Eigen::Vector3d, 4>& flux) {
  ElementMatrix local{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      local[i][j] = local[j][i] = element.volume * flux[i].dot(element.gradient[j]);
  return local;
}

template <class Coefficient>
Status add_stiffness_of(const TetMesh& mesh, std::span<const Coefficient> coefficient, SparseMatrix& matrix) {
  if (const auto error = check_count(mesh, coefficient.size())) return *error;
  return add_elements(mesh, matrix, [&](std::size_t t) {
    const Element element = element_of(mesh, t);
    std::array<Eigen::Vector3d, 4> flux;
    for (std::size_t i = 0; i < 4; ++i) {
      if constexpr (std::is_same_v<Coefficient, Eigen::Matrix3d>)
        flux[i] = coefficient[t].template selfadjointView<Eigen::Lower>() * element.gradient[i];
      else
        flux[i] = coefficient[t] * element.gradient[i];
    }
    return element_stiffness(element, flux);
  });
}

}  // namespace

SparseMatrix empty_matrix(const TetMesh& mesh) {
  const PointTets of = tets_of_points(mesh);
  const auto size = static_cast<Eigen::Index>(mesh.points.size());
  std::vector<int> columns, row_begin{0};
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const auto first = static_cast<std::ptrdiff_t>(columns.size());
    for (std::size_t at = of.begin[i]; at < of.begin[i + 1]; ++at)
      for (const std::uint32_t point : mesh.tets[of.tets[at]]) columns.push_back(static_cast<int>(point));
    std::sort(columns.begin() + first, columns.end());
    columns.erase(std::unique(columns.begin() + first, columns.end()), columns.end());
    row_begin.push_back(static_cast<int>(columns.size()));
  }
  SparseMatrix matrix(size, size);
  matrix.resizeNonZeros(static_cast<Eigen::Index>(columns.size()));
  std::copy(row_begin.begin(), row_begin.end(), matrix.outerIndexPtr());
  std::copy(columns.begin(), columns.end(), matrix.innerIndexPtr());
  std::fill_n(matrix.valuePtr(), columns.size(), 0.0);
  return matrix;
}

namespace {

template <class Coefficient>
Result<SparseMatrix> stiffness(const TetMesh& mesh, std::span<const Coefficient> coefficient) {
  SparseMatrix matrix = empty_matrix(mesh);
  if (Status added = add_stiffness_of(mesh, coefficient, matrix); !added) return added.error();
  return matrix;
}

}  // namespace

Result<SparseMatrix> assemble_stiffness(const TetMesh& mesh, std::span<const double> coefficient) {
  return stiffness(mesh, coefficient);
}

Status add_stiffness(const TetMesh& mesh, std::span<const double> coefficient, SparseMatrix& matrix) {
  return add_stiffness_of(mesh, coefficient, matrix);
}

Result<SparseMatrix> assemble_stiffness(const TetMesh& mesh, std::span<const Eigen::Matrix3d> coefficient) {
  return stiffness(mesh, coefficient);
}

Status add_stiffness(const TetMesh& mesh, std::span<const Eigen::Matrix3d> coefficient,
                     SparseMatrix& matrix) {
  return add_stiffness_of(mesh, coefficient, matrix);
}

Result<SparseMatrix> assemble_mass(const TetMesh& mesh) {
  SparseMatrix matrix = empty_matrix(mesh);
  if (Status added = add_mass(mesh, matrix); !added) return added.error();
  return matrix;
}

Status add_mass(const TetMesh& mesh, SparseMatrix& matrix) {
  return add_elements(mesh, matrix, [&](std::size_t t) {
    const double twentieth = element_of(mesh, t).volume / 20;
    ElementMatrix local{};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) local[i][j] = i == j ? 2 * twentieth : twentieth;
    return local;
  });
}

Result<Eigen::VectorXd> assemble_lumped_mass(const TetMesh& mesh) {
  if (const auto error = check_mesh(mesh)) return *error;
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(mesh.points.size()));
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const double quarter = element_of(mesh, t).volume / 4;
    for (const std::uint32_t point : mesh.tets[t]) mass[point] += quarter;
  }
  return mass;
}

}  // namespace voxtet::fem
