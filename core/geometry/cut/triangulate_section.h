// Triangles between the curves along which a plane passes through labelled surfaces.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "types/surface_mesh.h"

namespace voxtet {

/// Where a surface meets the plane: from one point of it to another, with the labels on both sides. Where the
/// surface lies in the plane, a triangle of it is on the left of its three edges.
struct SectionEdge {
  enum class Of { kAbove, kBelow, kWithin };  ///< where the rest of the surface's triangle lies

  std::uint32_t from = 0, to = 0;
  Label left = kBackground, right = kBackground;  ///< not of kWithin
  Of of = Of::kAbove;
};

/// Counterclockwise triangles between points of the plane, each with the label that it lies in. `added` stand
/// behind the points that were given.
struct SectionTriangles {
  std::vector<Eigen::Vector2d> added;
  std::vector<Triangle> triangles;
  std::vector<Label> labels;
};

/// The triangles of all regions whose label is wanted, and that the surface does not cover: a Delaunay
/// triangulation that keeps the edges, with points added about `spacing` from each other, and at least half
/// of that from the edges. Nothing where edges meet beyond common ends. Chew, "Constrained Delaunay
/// triangulations", 1989.
std::optional<SectionTriangles> triangulate_section(const std::vector<Eigen::Vector2d>& points,
                                                    const std::vector<SectionEdge>& edges,
                                                    const std::function<bool(Label)>& is_wanted,
                                                    double spacing);

}  // namespace voxtet
