// How many elements lie between the two surfaces of a wall.
#pragma once

#include <span>
#include <vector>

#include "types/quality_report.h"
#include "types/tet_mesh.h"
#include "walls/wall_field.h"

namespace voxtet {

/// Counts for each wall, and two fields on tetrahedra (none without walls). `layer`: the layer, from 1, that
/// the tetrahedron's centroid lies in by the potential. `layers_across`: the fewest edges on a path from the
/// inner to the outer surface through one of its corners, counted as by_edges. Outside of all walls both have
/// no value; where walls overlap the first one counts. `layers_across` has no value either where there is no
/// such path, or where a side is near every corner.
struct FoundLayers {
  std::vector<LayerCount> counts;
  std::vector<Field> fields;
};

/// Counts layers over the outer surface of each wall in two independent ways. by_edges: for each vertex of
/// the outer surface the fewest edges to the inner one, weighted by its share of the area. Edges on the
/// wall's surface are not used (where a ventricle's free wall meets the septum, the path along it is short).
/// by_lines: from each outer face down the gradient of the potential, tetrahedron by tetrahedron, how many
/// different values of floor(layers * potential at the centroid) are met; lines that do not end on the inner
/// surface are not counted. Places are the parts of the outer surface, connected by its edges, whose vertices
/// have another number by edges than asked for.
///
/// Wall, inner and outer surface and sides: walls/wall_mesh.h. Outer vertices within two edges of a side are
/// left out.
FoundLayers count_layers(const TetMesh& mesh, std::span<const LayeredWall> walls);

}  // namespace voxtet
