// Whether a mesh is sound: the pass/fail part of the evidence.
#pragma once

#include <vector>

#include "types/label_volume.h"
#include "types/quality_report.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// What can be said of a mesh alone: finite coordinates, no inverted tetrahedra, no duplicate or unused points, no
/// duplicate tetrahedra, faces on at most two, label boundaries closed (hard) and manifold (soft), smallest
/// dihedral angle at least 10 degrees (soft).
std::vector<ChecklistItem> check_mesh_alone(const TetMesh& mesh, double min_dihedral_deg);

/// What needs the labels: all present (hard), components as in the voxels (soft), volumes within 0.5 %, 2 % below
/// 1000 voxels (soft).
std::vector<ChecklistItem> check_against_labels(const TetMesh& mesh, const LabelVolume& volume,
                                                const std::vector<LabelFidelity>& fidelity);

}  // namespace voxtet
