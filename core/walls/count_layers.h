// How many elements lie between the two surfaces of a wall.
#pragma once

#include <span>
#include <vector>

#include "types/quality_report.h"
#include "types/tet_mesh.h"
#include "walls/wall_field.h"

namespace voxtet {

/// By wall; and where they are, two fields of tetrahedra, none where there are no walls. `layer`: of the
/// layers asked for, that of the centroid by the potential, from 1. `layers_across`: the fewest edges from
/// the inner to the outer surface by way of a corner, counted as by_edges. A tetrahedron in no wall has
/// neither; where walls overlap the first one counts; there are no layers across where there is no such way,
/// or a side is near every corner.
struct FoundLayers {
  std::vector<LayerCount> counts;
  std::vector<Field> fields;
};

/// Counts layers over the outer surface of each wall, in two ways that share nothing but the surface.
/// by_edges: the fewest edges from a vertex of the outer surface to the inner one, none of them on the wall's
/// surface (where a ventricle's free wall meets the septum, the way along it is short), weighted by its share
/// of the area. by_lines: from each outer face down the gradient of the potential, tetrahedron by
/// tetrahedron, how many of the sheets floor(layers * potential at the centroid) are met; lines that end
/// elsewhere than on the inner surface are not counted. Places are the parts of the outer surface, joined by
/// its edges, whose vertices have another number by edges than asked for.
///
/// Wall, inner and outer surface and sides: walls/wall_mesh.h. Outer vertices that two edges join to a
/// side are left out.
FoundLayers count_layers(const TetMesh& mesh, std::span<const LayeredWall> walls);

}  // namespace voxtet
