// Whether a mesh is sound: the pass/fail part of the evidence.
#pragma once

#include <span>
#include <vector>

#include "geometry/topology/adjacency.h"
#include "types/label_volume.h"
#include "types/quality_report.h"
#include "types/run_context.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// Checks of the mesh alone: finite coordinates, no inverted or flat tetrahedra (volume at most 1e-12 of the
/// longest edge cubed), no unused points, none closer than 1e-9 of the extent to another, no duplicate
/// tetrahedra, faces on at most two, label boundaries closed (hard) and manifold (soft), smallest dihedral
/// angle at least 10 degrees (soft). `faces`: result of `tet_faces`; `ledger`: that of their label_boundary.
std::vector<ChecklistItem> check_mesh_alone(const TetMesh& mesh, std::span<const TetFace> faces,
                                            const TopologyLedger& ledger, double min_dihedral_deg);

/// Checks that need the labels: `mesh.faces` are the tetrahedra's faces between labels, with their sides and
/// directions (hard); the labels are those of the voxels (hard); no difference between the topology ledgers
/// (soft); volumes within 0.5 %, or 2 % for labels below 1000 voxels or about three voxels thick (soft);
/// warns of each that is not, with what brings it nearer.
std::vector<ChecklistItem> check_against_labels(const TetMesh& mesh, std::span<const TetFace> faces,
                                                const LabelVolume& volume,
                                                const std::vector<LabelFidelity>& fidelity,
                                                const std::vector<TopologyDifference>& differences,
                                                const RunContext& ctx);

/// Of each wall whose layers shall be exact: whether nearly all of its area has so many (soft).
std::vector<ChecklistItem> check_exact_layers(std::span<const LayerCount> layers);

}  // namespace voxtet
