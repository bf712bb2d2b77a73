// Makes room for labels that touch where a third label nearly closes the gap between them.
#pragma once

#include "remesh/field/label_distances.h"

namespace voxtet::remesh {

/// The labels of two neighbouring voxels touch on the edge between the voxels' centres. By interpolation a
/// third label may have the largest distance somewhere on this edge. If that label lies on more than one side
/// of the edge, or all around it, this would close a tunnel through it, or end the contact. Then the third
/// label's distances are lowered at both voxels until it loses by 0.3 (of the smallest spacing) all along the
/// edge. Neighbours are those of the Kuhn tetrahedra. Linear time.
void keep_contacts_open(const LabelVolume& grid, LabelDistances& distances);

}  // namespace voxtet::remesh
