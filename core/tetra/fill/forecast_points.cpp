#include "tetra/fill/forecast_points.h"

#include <Eigen/Core>
#include <algorithm>

#include "geometry/elements/surface_measures.h"

namespace voxtet {
namespace {

/// Volume of a mean tetrahedron over its cubed edge length; measured.
constexpr double kVolumePerCubedEdge = 0.096;
constexpr double kTetsPerPoint = 5.5;
constexpr int kShells = 16;

double tets_per_mm3(double edge_mm) {
  return 1 / (kVolumePerCubedEdge * edge_mm * edge_mm * edge_mm);
}

}  // namespace

double forecast_points(const SurfaceMesh& surface, const SizingField& sizing) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : surface.points) middle += p / static_cast<double>(surface.points.size());
  double volume = 0, tets = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (surface.sides[t][1] != kBackground) continue;
    const auto [ia, ib, ic] = surface.triangles[t];
    const Eigen::Vector3d &a = surface.points[ia], &b = surface.points[ib], &c = surface.points[ic];
    const double cone = (a - middle).dot(triangle_cross(a, b, c)) / 6;
    const Eigen::Vector3d axis = (a + b + c) / 3 - middle;
    double mean = 0;
    for (int k = 0; k < kShells; ++k) {
      // A shell's share of the cone is the difference of the cubes of its bounds.
      const double share = static_cast<double>(3 * k * (k + 1) + 1) / (kShells * kShells * kShells);
      mean += share * tets_per_mm3(sizing.at(middle + axis * ((k + 0.5) / kShells)));
    }
    volume += cone;
    tets += cone * mean;
  }
  const auto [low, high] = std::minmax_element(sizing.h_mm.begin(), sizing.h_mm.end());
  volume = std::max(volume, 0.0);
  tets = std::clamp(tets, volume * tets_per_mm3(*high), volume * tets_per_mm3(*low));
  return static_cast<double>(surface.points.size()) + tets / kTetsPerPoint;
}

}  // namespace voxtet
