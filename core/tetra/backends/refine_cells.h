// Points inside of labels, where Delaunay cells are too large or too long.
#pragma once

#include <cstddef>

#include "tetra/backends/delaunay_cells.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "walls/wall_layers.h"

namespace voxtet::tetra {

enum class Refined { kDone, kCancelled, kTooMany };

/// For cells with labels: adds points at the circumcentres of cells that are larger than `sizing` asks for,
/// and of those whose ratio of circumradius to shortest edge is above `radius_edge`. Points that would be too
/// close to the surface or behind it are left out. A point only changes cells of one label: the triangulation
/// stays Delaunay as seen from inside each label. No point is added in a layer. Polls ctx.cancelled(). Stops
/// when there are more than `max_points`, or soon after. On ctx.threads, with the result of one.
Refined refine_cells(DelaunayCells& cells, const SizingField& sizing, double radius_edge,
                     std::size_t max_points, const WallLayers& layers, const RunContext& ctx);

}  // namespace voxtet::tetra
