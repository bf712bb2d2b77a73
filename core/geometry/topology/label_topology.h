// The topology of every label of a complex, and which labels touch.
#pragma once

#include "types/surface_mesh.h"
#include "types/topology_ledger.h"

namespace voxtet {

/// Shells are components of the label's triangles, connected over edges. Where a label touches itself along a
/// pinched edge, triangles that bound the same wedge of the label belong together, so that touching connects
/// nothing: two boxes that share an edge or a point are two components, and a hook whose end touches itself
/// has no handle. Two cavities that share an edge count as one. Linear time; small sorts only.
TopologyLedger label_topology(const SurfaceMesh& surface);

}  // namespace voxtet
