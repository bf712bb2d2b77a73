// Trilinear interpolation that joins voxels of one label as its extraction did.
#pragma once

#include "remesh/field/label_distances.h"

namespace voxtet::remesh {

/// Marching cubes as we extract one label joins its voxels through faces alone, and background along
/// diagonals too. Between eight voxel centres trilinear interpolation may join more: the label along the
/// diagonal of a face or of the cell, or two voxels of background through the label around them, and so open
/// or close a tunnel. There the distances of what is not to be joined are lowered, and on faces those between
/// it raised, until it is apart (by slices of the cell, with a hyperbola each: Chernyaev 1995, Marching Cubes
/// 33). For one label and background; linear time.
void resolve_face_ambiguity(const LabelVolume& grid, LabelDistances& distances);

}  // namespace voxtet::remesh
