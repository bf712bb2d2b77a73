// Room for labels that touch where a third one all but closes the way.
#pragma once

#include "remesh/field/label_distances.h"

namespace voxtet::remesh {

/// Two neighbouring voxels' labels touch on the edge between them; between voxels' centres a third label's
/// distance may be the largest there, and where that label stands on more than one side of the edge, or all
/// around it, a tunnel through it would close, or the contact end. There the third label's distances are
/// lowered at both voxels until it loses by 0.3 (of the smallest spacing) all along the edge. Neighbours are
/// those of the Kuhn tetrahedra. Linear time.
void keep_contacts_open(const LabelVolume& grid, LabelDistances& distances);

}  // namespace voxtet::remesh
