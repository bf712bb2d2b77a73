#include "tetra/delaunay_backend.h"

#include <optional>
#include <string>
#include <utility>

#include "tetra/delaunay_cells.h"
#include "tetra/recover_surface.h"

namespace voxtet {
namespace {

using namespace tetra;

Error meshing_error(std::string message) {
  return {ErrorCode::kMeshing, "tetra", std::move(message), {}};
}

}  // namespace

Result<FilledParts> run_delaunay(SurfaceMesh& surface, const SizingField& sizing,
                                 const DelaunayOptions& options, const RunContext& ctx) {
  DelaunayCells cells;
  for (const Eigen::Vector3d& p : surface.points)
    if (!cells.add(p)) return meshing_error("two points of the surface coincide");
  const std::size_t triangles = surface.triangles.size();
  const std::optional<Recovery> recovered = recover_surface(surface, cells);
  if (!recovered || !cells.label(surface)) return meshing_error("the surface is too far from a Delaunay one");
  if (recovered->flipped + recovered->split > 0)
    ctx.note("tetra", "to make the surface Delaunay, of " + std::to_string(triangles) + " triangles " +
                          std::to_string(2 * recovered->flipped) + " were flipped, and " +
                          std::to_string(recovered->split) + " edges halved");
  switch (cells.refine(sizing, options.radius_edge, options.max_points, ctx)) {
    case DelaunayCells::Refined::kCancelled: return cancelled_error("tetra");
    case DelaunayCells::Refined::kTooMany: return meshing_error("refinement did not come to an end");
    case DelaunayCells::Refined::kDone: break;
  }
  return cells.take();
}

}  // namespace voxtet
