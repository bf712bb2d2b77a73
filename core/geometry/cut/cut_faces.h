// Surfaces and meshes of a body that goes on beyond the planes of its cuts.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/cut/cut_plane.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"
#include "types/topology_ledger.h"

namespace voxtet {

/// The cuts (bit i: cuts[i]) of which a triangle with these sides is a face: between a label of the body and
/// what is beyond.
CutBits cuts_of_sides(const Sides& sides, const CutPlanes& cuts);
/// For each point the cuts (bit i: cuts[i]) in whose plane it lies, as a corner of a face of them.
std::vector<CutBits> cuts_of_points(std::size_t point_count, const std::vector<Triangle>& triangles,
                                    const std::vector<Sides>& sides, const CutPlanes& cuts);

/// Where a point is once it has been moved into the planes of some cuts.
Eigen::Vector3d in_planes(Eigen::Vector3d point, CutBits of_point, const CutPlanes& cuts);

/// Puts the points of a surface that was extracted from `volume` into the planes of their cuts: they are at
/// most a quarter of a voxel off. Those of one cut that have come to lie beyond another one go back before
/// it, in their order. Points of a rim, as the middles of a voxel of the body, one beyond and one of
/// background, stand a sixth of a voxel inside of the wall, and go outwards.
void settle_cuts(SurfaceMesh& extracted, const LabelVolume& volume, const CutPlanes& cuts);
/// Moves the points of cuts into their planes, as far as that leaves every element a third of its size.
/// Returns the largest distance that remains, mm.
double flatten_cuts(SurfaceMesh& surface, const CutPlanes& cuts);
double flatten_cuts(TetMesh& mesh, const CutPlanes& cuts);

/// A ledger without what is beyond the cuts, and its contacts.
TopologyLedger topology_before(const CutPlanes& cuts, TopologyLedger ledger);
/// Without what is beyond the cuts; faces there are between a label and background.
SurfaceMesh without_beyond(const SurfaceMesh& surface, const CutPlanes& cuts);
TetMesh without_beyond(TetMesh mesh, const CutPlanes& cuts);
/// Indices of triangles of `surface` turned into those of without_beyond(surface); those that go are left
/// out.
std::vector<std::uint32_t> shown_triangles(const std::vector<std::uint32_t>& triangles,
                                           const SurfaceMesh& surface, const CutPlanes& cuts);

/// The faces of a finished mesh in the plane of each cut, under its name; cuts without faces are left out.
std::vector<NamedSet> cut_sets(const TetMesh& mesh, const CutPlanes& cuts);

}  // namespace voxtet
