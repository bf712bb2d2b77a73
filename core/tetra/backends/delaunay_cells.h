// A Delaunay triangulation whose cells take the labels of a surface that is a part of it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/delaunay/delaunay_triangulation.h"
#include "tetra/backends/filled_parts.h"
#include "types/surface_mesh.h"

namespace voxtet::tetra {

class DelaunayCells {
 public:
  /// Points of a surface, numbered as there; none is a vertex yet.
  explicit DelaunayCells(std::span<const Eigen::Vector3d> points);

  /// Makes the first cell, of some of these points. False if all lie in one plane.
  bool begin(std::span<const std::uint32_t> vertices) { return triangulation_.begin(vertices); }
  /// Makes a point a vertex, if it is none yet. False if there is another one at its place. Fastest if points
  /// that are added one after the other are near each other.
  bool add(std::uint32_t vertex);
  /// The same for a new point, whose number is the next one.
  bool add(const Eigen::Vector3d& point);

  bool has_edge(std::uint32_t a, std::uint32_t b);
  /// For each triangle of a surface, whose points are the vertices, whether it is a facet.
  std::vector<bool> find_facets(const SurfaceMesh& surface) const;

  /// Gives every cell the label on its side of the surface, all of whose triangles must be facets. False if a
  /// cell lies on two sides.
  bool label(const SurfaceMesh& surface);

  /// Whoever adds cells after label() gives them their labels.
  DelaunayTriangulation& triangulation() { return triangulation_; }

  /// After label(): the points in use, and the tets of every label except background, with labels as regions.
  FilledParts take() const;

 private:
  /// Makes a point a vertex; `first` is in conflict with it.
  void insert(std::uint32_t vertex, std::uint32_t first);
  template <class Visit>
  void for_each_facet(const SurfaceMesh& surface, const Visit& visit) const;

  DelaunayTriangulation triangulation_;
  DelaunayTriangulation::Stock stock_;
  DelaunayTriangulation::Cavity cavity_;
  std::uint32_t last_made_ = 0;
};

}  // namespace voxtet::tetra
