// Makes trilinear interpolation join voxels of one label exactly as the extraction did.
#pragma once

#include "remesh/field/label_distances.h"

namespace voxtet::remesh {

/// Our marching cubes joins voxels of one label through faces only, and background along diagonals too.
/// Between eight voxel centres trilinear interpolation may join more: the label along the diagonal of a face
/// or of the cell, or two voxels of background through the label around them. This would open or close a
/// tunnel. There the distances of what must not be joined are lowered, and on faces those of what lies
/// between are raised, until it is apart (by slices of the cell, with a hyperbola each: Chernyaev 1995,
/// Marching Cubes 33). For one label and background; linear time.
void resolve_face_ambiguity(const LabelVolume& grid, LabelDistances& distances);

}  // namespace voxtet::remesh
