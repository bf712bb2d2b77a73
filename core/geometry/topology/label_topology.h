// The topology of every label of a complex, and which labels touch.
#pragma once

#include "types/surface_mesh.h"
#include "types/topology_ledger.h"

namespace voxtet {

/// Shells are components of the label's triangles over their edges. Where a label touches itself along a
/// pinched edge, triangles that bound the same wedge of the label belong together, so that a touch joins
/// nothing of the label: two boxes that share an edge or a point are two components, and a hook that closes
/// on itself by a touch has no handle. Two cavities that share an edge are one. Linear time; small sorts
/// only.
TopologyLedger label_topology(const SurfaceMesh& surface);

}  // namespace voxtet
