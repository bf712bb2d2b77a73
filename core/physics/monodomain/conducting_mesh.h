// The part of a mesh that conducts.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "types/result.h"
#include "types/tet_mesh.h"
#include "types/tissue.h"

namespace voxtet {

/// The tetrahedra of a mesh that conduct, in the order of the whole mesh, with the points that they use, in
/// the order of Morton's curve: points near each other have numbers near each other. Points of nothing but
/// scar or blood take no part.
struct ConductingMesh {
  TetMesh mesh;                              ///< points and tets; without labels and faces
  std::vector<std::uint32_t> points;         ///< of each point its number in the whole mesh
  std::vector<Eigen::Matrix3d> diffusivity;  ///< of each tetrahedron, mm^2/ms
  std::vector<std::uint16_t> kind;  ///< of each point: the kind that has most of the volume around it
};

/// Diffusivities are those at which a plane wave has the tissue's speeds (diffusivity_of) on a fine mesh;
/// with `corrected_for`, a share of the consistent mass, on this one (diffusivity_on_mesh). Errors: kInternal
/// for lists of a wrong length, kUsage where nothing conducts and, naming physics.tissue, for a kind whose
/// cell or speeds are out of range.
Result<ConductingMesh> conducting_mesh(const TetMesh& whole, const Tissue& tissue,
                                       std::optional<double> corrected_for = {});

}  // namespace voxtet
