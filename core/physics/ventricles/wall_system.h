// Finite elements on the wall alone, and functions on it.
#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <optional>
#include <utility>
#include <vector>

#include "physics/fem/fixed_order.h"
#include "types/heart_surfaces.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// Mesh and surfaces are referred to, and must outlive it. One row for each point of the mesh; those of
/// points outside of the wall, which no tetrahedron of the wall has, are 0.
struct WallSystem {
  const TetMesh& mesh;
  const HeartSurfaces& surfaces;
  fem::SparseMatrix stiffness;  ///< mm
  std::vector<bool> outside;    ///< by point
};

/// Returns kUsage, naming the field, for surfaces that do not belong to the mesh, an empty wall, and where
/// the base, the epicardium, the left endocardium, of the right ventricle either part of its endocardium, or
/// the apex is missing in the wall; errors of add_stiffness().
Result<WallSystem> wall_system(const TetMesh& mesh, const HeartSurfaces& surfaces);

/// A value for each point; NaN: free.
using PointValues = Eigen::VectorXd;

/// The values given to the points of some surfaces of the wall. Points of several: the last one counts.
PointValues values_on(const WallSystem& system,
                      std::initializer_list<std::pair<HeartSurface, double>> values);

/// The u with K u = load at the free points of the wall and the values of `held` at all others; one value for
/// each point, NaN outside of the wall. Returns errors of solve_held().
Result<Eigen::VectorXd> solve_on_wall(const WallSystem& system, const PointValues& held,
                                      const Eigen::VectorXd& load, const RunContext& ctx);

/// The gradient of u on a tetrahedron of the wall, per mm.
Eigen::Vector3d gradient_on(const TetMesh& mesh, const Eigen::VectorXd& u, std::size_t tet);

/// The mean of u over a tetrahedron, which is its value at the centroid.
double mean_on(const TetMesh& mesh, const Eigen::VectorXd& u, std::size_t tet);

}  // namespace voxtet
