// Restricted Delaunay refinement: points are added on the interfaces of a label field until every facet of
// the Delaunay triangulation that is dual to an interface is small, close and well shaped.
//
// Chew's algorithm as in Boissonnat & Oudot, "Provably good sampling and meshing of surfaces" (2005), for any
// number of labels: a Delaunay cell has the label of its circumcentre, a facet between two labels belongs to
// the interface, and a bad facet is refined at the centre of its surface Delaunay ball (where its dual
// segment meets the interface). The facets are a subset of one triangulation, so they never intersect and
// always conform.
#pragma once

#include <memory>
#include <vector>

#include "remesh/cells/labelled_cells.h"
#include "remesh/field/label_field.h"
#include "types/run_context.h"
#include "types/sizing_field.h"

namespace voxtet::remesh {

struct RefineCriteria {
  double facet_angle_deg = 30;    ///< lower bound on planar angles; at most 30 for termination
  double max_distance_mm = 0.25;  ///< facet circumcentre to centre of the surface ball
  double radius_per_edge = 0.8;   ///< surface ball radius allowed per target edge length
  /// Facets of layers (walls/wall_layers.h) whose ball has less than this part of the radius allowed may be
  /// farther off, as a factor on the distance: between facets much smaller than a layer is thick there is no
  /// room for good tetrahedra across it.
  double layer_radius_share = 0.6, layer_distance = 4;
};

/// Holds the growing triangulation. `field` and `sizing` must outlive it.
class DelaunayRefiner {
 public:
  DelaunayRefiner(const LabelField& field, const SizingField& sizing, const RefineCriteria& criteria);
  ~DelaunayRefiner();

  /// Adds points as they are, except those closer to an existing one than `separation_mm` or `edge_share` of
  /// the target edge length: facets around an edge much shorter than the others would become as small.
  /// Returns how many were added.
  std::size_t insert(const std::vector<Eigen::Vector3d>& points, double separation_mm, double edge_share = 0);

  /// Refines until no facet is bad. False when cancelled.
  bool refine(RunContext& ctx, double predicted_vertices);

  /// Marks a facet for refinement by refine(): the one opposite `corner` of a cell of the last cells(), after
  /// which nothing may have been inserted. Returns false, and marks nothing, if its surface ball is already
  /// smaller than `least_radius_mm`.
  bool request(std::uint32_t cell, std::uint32_t corner, double least_radius_mm);

  /// Points on interfaces that cells have missed. A cell has the label of its circumcentre; if its centroid
  /// lies at least `depth_mm` deep in another label, the point is where the label changes between the two. In
  /// the order of cells().
  std::vector<Eigen::Vector3d> passed_over(double depth_mm) const;

  std::size_t vertex_count() const;
  /// The triangulation as refine() left it.
  LabelledCells cells();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace voxtet::remesh
