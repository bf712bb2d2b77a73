// Laplace's equation in the wall of the ventricles: what their coordinates and fibres are made of.
// Bayer, Blake, Plank and Trayanova, "A novel rule-based algorithm for assigning myocardial fiber orientation
// to computational heart models", Annals of Biomedical Engineering 40 (2012).
#pragma once

#include <Eigen/Core>

#include "types/heart_surfaces.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// Potentials without unit, one value for each point of the mesh: linear on each tetrahedron of the wall, NaN
/// at points that no such tetrahedron has. No flow through the surfaces that are not named.
struct VentricularPotentials {
  /// 1 on the epicardium, 0 on both endocardia. With the next two it adds up to 1.
  Eigen::VectorXd epi;
  /// 1 on the left endocardium, 0 on the right one and on the epicardium.
  Eigen::VectorXd lv;
  /// 1 on the right endocardium with its part on the septum, 0 on the left one and on the epicardium. All 0
  /// in a single ventricle.
  Eigen::VectorXd rv;
  /// 0 at the apex, 1 on the base. The apex is a single point: the finer the mesh around it, the nearer is
  /// the potential to 1 everywhere else. Its direction, not its value, is meant to be used.
  Eigen::VectorXd base;
  /// 1 on the right endocardium of the free wall, 0 on the left one and on the right side of the septum, so
  /// that more than 1/2 is the free wall of the right ventricle; 1/2 at the line where it meets the septum.
  /// All 0 in a single ventricle.
  Eigen::VectorXd free_wall;
};

/// Where surfaces meet, the endocardia count more than the epicardium, and the right ventricle's more than
/// the left one's. Tells its progress and stops soon when it is cancelled, as stage "fibres". Returns errors
/// of wall_system(): kUsage, with the field, where a surface or the apex is missing.
Result<VentricularPotentials> ventricular_potentials(const TetMesh& mesh, const HeartSurfaces& surfaces,
                                                     const RunContext& ctx);

/// Whether a tetrahedron of the wall is of the right ventricle's free wall. The septum is the left one's.
bool is_right(const TetMesh& mesh, const VentricularPotentials& potentials, std::size_t tet);

}  // namespace voxtet
