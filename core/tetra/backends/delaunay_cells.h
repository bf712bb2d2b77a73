// A Delaunay triangulation whose cells take the labels of a surface that is a part of it, and are then
// refined.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "tetra/backends/filled_parts.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"
#include "walls/wall_layers.h"

namespace voxtet::tetra {

/// Wraps CGAL's Delaunay_triangulation_3.
class DelaunayCells {
 public:
  DelaunayCells();
  ~DelaunayCells();

  /// False if there is a vertex at this place already. In the end `number` must have taken all values from 0
  /// on. Fastest if points that are added one after the other are near each other.
  bool add(const Eigen::Vector3d& point, std::uint32_t number);
  bool has_edge(std::uint32_t a, std::uint32_t b) const;
  /// For each triangle of a surface, whose points are the vertices, whether it is a facet.
  std::vector<bool> find_facets(const SurfaceMesh& surface) const;

  /// Gives every cell the label on its side of the surface, all of whose triangles must be facets. False if a
  /// cell lies on two sides.
  bool label(const SurfaceMesh& surface);

  enum class Refined { kDone, kCancelled, kTooMany };
  /// After label(): adds points at the circumcentres of cells that are larger than `sizing` asks for, then of
  /// those whose ratio of circumradius to shortest edge is above `radius_edge`. Points that would be too
  /// close to the surface or behind it are left out. A point only changes cells of one label: the
  /// triangulation stays Delaunay as seen from inside each label. No point is added in a layer. Polls
  /// ctx.cancelled(). Stops at `max_points`.
  Refined refine(const SizingField& sizing, double radius_edge, std::size_t max_points,
                 const WallLayers& layers, const RunContext& ctx);

  /// After label(): the points, and the tets of every label except background, with labels as regions.
  FilledParts take() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace voxtet::tetra
