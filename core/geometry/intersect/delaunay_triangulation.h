// CGAL's Delaunay triangulation, with the data that refinement stores for each vertex and cell. All users
// share one set of types, so that its code is compiled once.
#pragma once

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

#include "types/label_volume.h"

namespace voxtet {

struct DelaunayCellInfo {
  Eigen::Vector3d centre;    ///< circumcentre, mm
  std::uint32_t serial = 0;  ///< unique per cell; 0 once the cell is removed
  Label label = kBackground;
};

using DelaunayKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
/// The info of a vertex is its number.
using DelaunayTriangulation = CGAL::Delaunay_triangulation_3<
    DelaunayKernel,
    CGAL::Triangulation_data_structure_3<
        CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, DelaunayKernel>,
        CGAL::Triangulation_cell_base_with_info_3<DelaunayCellInfo, DelaunayKernel,
                                                  CGAL::Delaunay_triangulation_cell_base_3<DelaunayKernel>>>>;

inline Eigen::Vector3d to_vector(const DelaunayKernel::Point_3& p) {
  return {p.x(), p.y(), p.z()};
}
inline DelaunayKernel::Point_3 to_point(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

/// Circumcentre of a finite cell; not finite if the cell is flat.
inline Eigen::Vector3d circumcentre(const DelaunayTriangulation::Cell_handle& cell) {
  const Eigen::Vector3d a = to_vector(cell->vertex(0)->point());
  const Eigen::Vector3d u = to_vector(cell->vertex(1)->point()) - a,
                        v = to_vector(cell->vertex(2)->point()) - a,
                        w = to_vector(cell->vertex(3)->point()) - a;
  const Eigen::Vector3d vw = v.cross(w);
  const Eigen::Vector3d sum =
      u.squaredNorm() * vw + v.squaredNorm() * w.cross(u) + w.squaredNorm() * u.cross(v);
  return a + sum / (2 * u.dot(vw));
}

}  // namespace voxtet
