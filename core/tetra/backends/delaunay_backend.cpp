#include "tetra/backends/delaunay_backend.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "geometry/elements/surface_measures.h"
#include "geometry/search/morton_curve.h"
#include "tetra/backends/delaunay_cells.h"
#include "tetra/backends/recover_surface.h"
#include "tetra/backends/refine_cells.h"
#include "tetra/mesh/meshing_error.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

using namespace tetra;

constexpr std::uint32_t kPointsPerQuestion = 512;
/// By how much flips may change the volume of a label.
constexpr double kVolumeTolerance = 5e-3;

Status check_volumes(const std::vector<double>& before, const std::vector<double>& after) {
  for (std::size_t label = 1; label < before.size(); ++label)
    if (std::abs(after[label] - before[label]) > kVolumeTolerance * before[label])
      return meshing_error("a Delaunay surface would change the volume of label " + std::to_string(label) +
                           " from " + std::to_string(before[label]) + " to " + std::to_string(after[label]) +
                           " mm3");
  return std::monostate{};
}

}  // namespace

Result<FilledParts> run_delaunay(SurfaceMesh& surface, const SizingField& sizing,
                                 const DelaunayOptions& options, const WallLayers& layers,
                                 const RunContext& ctx) {
  DelaunayCells cells(surface.points);
  const std::vector<std::uint32_t> order =
      MortonCurve(surface.points).order(surface.points.size(), [&](std::size_t v) {
        return surface.points[v];
      });
  if (!cells.begin(order)) return meshing_error("all points of the surface lie in one plane");
  std::size_t added = 0;
  for (const std::uint32_t v : order) {
    if (added++ % kPointsPerQuestion == 0 && ctx.cancelled()) return cancelled_error(kTetraStage);
    if (!cells.add(v)) return meshing_error("two points of the surface coincide");
  }
  const std::size_t triangles = surface.triangles.size();
  const std::vector<double> volumes = enclosed_volumes_mm3(surface);
  const Result<Recovery> recovered = recover_surface(surface, cells, ctx);
  if (!recovered) return recovered.error();
  if (const Status kept = check_volumes(volumes, enclosed_volumes_mm3(surface)); !kept) return kept.error();
  if (recovered->flipped + recovered->split > 0)
    ctx.note(kTetraStage, "to make the surface of " + std::to_string(triangles) + " triangles Delaunay, " +
                              std::to_string(recovered->flipped) + " edges were flipped and " +
                              std::to_string(recovered->split) + " halved");
  if (!cells.label(surface)) return meshing_error("a cell lies on two sides of the surface");
  switch (refine_cells(cells, sizing, options.radius_edge, options.max_points, layers, ctx)) {
    case Refined::kCancelled: return cancelled_error(kTetraStage);
    case Refined::kTooMany: return meshing_error("refinement did not come to an end");
    case Refined::kDone: break;
  }
  return cells.take();
}

}  // namespace voxtet
