// Adds vertices where a path along edges through a wall has too few edges.
#pragma once

#include <span>

#include "types/result.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "types/tet_mesh.h"
#include "walls/wall_field.h"

namespace voxtet {

/// Where fewer edges than a wall has layers lead from its inner to its outer surface (walls/wall_mesh.h), a
/// vertex is put on one of them, the longest edges first. The new tets must have no dihedral angle below 25
/// degrees, edges of allowed lengths (tetra/operations/vertex_insertion.h) and no other short path. Paths
/// that end near the wall's sides do not count. Labels, faces and existing points stay as they are; new
/// points come last. ctx.note says what was done. Errors: kCancelled; kOutOfMemory.
Result<TetMesh> deepen_walls(TetMesh mesh, std::span<const LayeredWall> walls, const SizingField& sizing,
                             RunContext& ctx);

}  // namespace voxtet
