#include <algorithm>
#include <limits>

#include "anatomy/name_faces.h"
#include "anatomy/surface_parts.h"

namespace voxtet::anatomy {
namespace {

constexpr double kCap = 0.05;  ///< of the epicardium's height

/// Towards the base. What closes a surface has the area vector that is missing to zero; the normals here
/// point into the cavity.
Eigen::Vector3d up_of(const WallSurface& surface, const FaceKinds& kinds) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t f = 0; f < kinds.size(); ++f)
    if (kinds[f] >= wall::kInner) sum += surface.faces[f].area_mm2 * surface.faces[f].normal;
  return sum.normalized();
}

}  // namespace

std::uint32_t find_apex(const Points& points, const WallSurface& surface, const FaceKinds& kinds) {
  const Eigen::Vector3d up = up_of(surface, kinds);
  double low = std::numeric_limits<double>::max(), high = -low;
  std::size_t deepest = 0;
  for (std::size_t f = 0; f < kinds.size(); ++f) {
    if (kinds[f] != wall::kOuter) continue;
    const double height = up.dot(surface.faces[f].centre);
    if (height < low) low = height, deepest = f;
    high = std::max(high, height);
  }
  std::vector<std::uint8_t> in_cap;
  for (std::size_t f = 0; f < kinds.size(); ++f)
    in_cap.push_back(kinds[f] == wall::kOuter &&
                     up.dot(surface.faces[f].centre) <= low + kCap * (high - low));
  const SurfaceParts parts = surface_parts(surface, in_cap);
  const auto of_cap = [&](std::size_t f) { return parts.of[f] == parts.of[deepest]; };

  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (std::size_t f = 0; f < kinds.size(); ++f)
    if (of_cap(f)) centroid += surface.faces[f].area_mm2 * surface.faces[f].centre;
  centroid /= parts.area_mm2[parts.of[deepest]];
  std::uint32_t apex = surface.faces[deepest].corners[0];
  double nearest = std::numeric_limits<double>::max();
  for (std::size_t f = 0; f < kinds.size(); ++f) {
    if (!of_cap(f)) continue;
    for (const std::uint32_t point : surface.faces[f].corners) {
      const Eigen::Vector3d way = points[point] - centroid;
      const double aside = (way - up.dot(way) * up).squaredNorm();
      if (aside < nearest) nearest = aside, apex = point;
    }
  }
  return apex;
}

}  // namespace voxtet::anatomy
