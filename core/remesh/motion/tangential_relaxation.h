// The step of a vertex along its surface that improves sizes and shapes of the triangles around it.
#pragma once

#include <Eigen/Core>
#include <span>

namespace voxtet::remesh {

/// A triangle at a vertex, by its other two corners in order.
struct RingTriangle {
  Eigen::Vector3d p, q;
  double target_area = 1;  ///< relative to the others
  double need = 1;         ///< how much its shape counts
};

struct TangentialStep {
  Eigen::Vector3d normal;  ///< area-weighted mean of the triangles' normals; of length 1
  Eigen::Vector3d step;    ///< perpendicular to it
};

/// The step from `x` to a weighted mean of two places. The first gives the triangles their target shares of
/// the area (Surazhsky and Gotsman, "Explicit surface remeshing", 2003: least squares, areas being linear in
/// the tangent plane). The second, with `shape_weight`, is the mean of the apexes that would make each
/// triangle equilateral.
TangentialStep tangential_relaxation(const Eigen::Vector3d& x, std::span<const RingTriangle> ring,
                                     double shape_weight);

}  // namespace voxtet::remesh
