// Shape and size of an adapted surface, measured for the tests.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "types/sizing_field.h"
#include "types/surface_mesh.h"

namespace voxtet::test {

struct SurfaceReport {
  double least_planar_deg = 180;    ///< smallest angle of a triangle
  double least_dihedral_deg = 180;  ///< smallest angle between two triangles that share an edge
  double size_median = 0, size_p5 = 0, size_p95 = 0;  ///< log2(edge length / target at its midpoint)
};

inline double angle_deg(const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
  return std::atan2(u.cross(v).norm(), u.dot(v)) * (180 / EIGEN_PI);
}

inline SurfaceReport report_on(const SurfaceMesh& surface, const SizingField& sizing) {
  SurfaceReport out;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> opposite;
  for (const Triangle& t : surface.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
      const Eigen::Vector3d &p = surface.points[a], &q = surface.points[b], &r = surface.points[c];
      out.least_planar_deg = std::min(out.least_planar_deg, angle_deg(q - p, r - p));
      opposite[std::minmax(a, b)].push_back(c);
    }
  std::vector<double> sizes;
  for (const auto& [edge, points] : opposite) {
    const Eigen::Vector3d &p = surface.points[edge.first], &q = surface.points[edge.second];
    sizes.push_back(std::log2((q - p).norm() / sizing.at(0.5 * (p + q))));
    const Eigen::Vector3d axis = (q - p).normalized();
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        out.least_dihedral_deg = std::min(
            out.least_dihedral_deg,
            angle_deg(axis.cross(surface.points[points[i]] - p), axis.cross(surface.points[points[j]] - p)));
  }
  std::sort(sizes.begin(), sizes.end());
  if (sizes.empty()) return out;
  out.size_median = sizes[sizes.size() / 2];
  out.size_p5 = sizes[sizes.size() / 20];
  out.size_p95 = sizes[sizes.size() - 1 - sizes.size() / 20];
  return out;
}

}  // namespace voxtet::test
