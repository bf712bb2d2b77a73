// Measures of triangles and of the closed surfaces of a labelled complex.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "types/surface_mesh.h"

namespace voxtet {

/// Right-hand normal of a triangle, its length is twice the area (mm^2).
inline Eigen::Vector3d triangle_cross(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                      const Eigen::Vector3d& c) {
  return (b - a).cross(c - a);
}

/// mm^2.
inline double triangle_area_mm2(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                const Eigen::Vector3d& c) {
  return 0.5 * triangle_cross(a, b, c).norm();
}

/// Signed volume (mm^3) that the boundary of `label` encloses; positive when its triangles follow the
/// convention of SurfaceMesh. `label` must not be background.
double enclosed_volume_mm3(const SurfaceMesh& surface, Label label);

/// The same for every label at once: entry l is the volume of label l, 0 for labels without triangles and for
/// background. As long as the largest label + 1.
std::vector<double> enclosed_volumes_mm3(const SurfaceMesh& surface);

/// Roughness: sum over edges with exactly two triangles of length (mm) times squared turning angle (rad^2).
/// A flat surface has 0, a staircase much. Linear time.
double staircase_energy_mm(const SurfaceMesh& surface);

}  // namespace voxtet
