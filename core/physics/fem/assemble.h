// Mass and stiffness of linear (P1) elements on the tetrahedra of a mesh.
// Quarteroni and Valli, "Numerical Approximation of Partial Differential Equations" (1994), chapters 3 and 6.
#pragma once

#include <Eigen/Core>
#include <span>

#include "physics/fem/fixed_order.h"
#include "types/result.h"
#include "types/tet_mesh.h"

namespace voxtet::fem {

// phi_i is the function that is linear on every tetrahedron, 1 at point i and 0 at all others. Every matrix
// has an entry for each pair of points of a common tetrahedron, summed in the order of the tetrahedra, and is
// symmetric to the last bit.
// All functions return kInternal if the number of coefficients is wrong, and kBadInput, with its place, for a
// tetrahedron without a positive volume.

/// Zeros where two points have a tetrahedron in common: what matrices are added to.
SparseMatrix empty_matrix(const TetMesh& mesh);

/// K_ij = integral of c grad phi_i . grad phi_j, in mm times the unit of c: one number for each tetrahedron.
Result<SparseMatrix> assemble_stiffness(const TetMesh& mesh, std::span<const double> coefficient);

/// Adds it to a matrix that empty_matrix() gave.
Status add_stiffness(const TetMesh& mesh, std::span<const double> coefficient, SparseMatrix& matrix);

/// K_ij = integral of grad phi_i . (C grad phi_j), in mm times the unit of C: one symmetric tensor for each
/// tetrahedron, of which the lower triangle is read.
Result<SparseMatrix> assemble_stiffness(const TetMesh& mesh, std::span<const Eigen::Matrix3d> coefficient);
Status add_stiffness(const TetMesh& mesh, std::span<const Eigen::Matrix3d> coefficient, SparseMatrix& matrix);

/// M_ij = integral of phi_i phi_j, the consistent mass, in mm^3.
Result<SparseMatrix> assemble_mass(const TetMesh& mesh);
/// Adds it to a matrix that empty_matrix() gave.
Status add_mass(const TetMesh& mesh, SparseMatrix& matrix);

/// The row sums of the consistent mass: a quarter of the volume around each point, in mm^3.
Result<Eigen::VectorXd> assemble_lumped_mass(const TetMesh& mesh);

}  // namespace voxtet::fem
