#include "geometry/elements/region_distance.h"

#include <algorithm>

#include "geometry/elements/rotation.h"

namespace voxtet {

RegionDistance::RegionDistance(const Region& region)
    : region_(region),
      to_box_(rotation_from_degrees(region.axes_deg).transpose()),
      middle_(region.centre_mm),
      half_(Eigen::Vector3d::Constant(region.radius_mm)) {
  if (region.shape == RegionShape::kBox) half_ = to_box_.transpose().cwiseAbs() * region.half_size_mm;
  if (region.shape == RegionShape::kCapsule) {
    middle_ = (region.centre_mm + region.end_mm) / 2;
    half_ += (region.end_mm - region.centre_mm).cwiseAbs() / 2;
  }
}

double RegionDistance::at(const Eigen::Vector3d& point_mm) const {
  const Eigen::Vector3d offset = point_mm - region_.centre_mm;
  if (region_.shape == RegionShape::kBox)
    return ((to_box_ * offset).cwiseAbs() - region_.half_size_mm).cwiseMax(0).norm();
  if (region_.shape == RegionShape::kSphere) return std::max(0.0, offset.norm() - region_.radius_mm);
  const Eigen::Vector3d along = region_.end_mm - region_.centre_mm;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp(offset.dot(along) / length2, 0.0, 1.0) : 0.0;
  return std::max(0.0, (offset - t * along).norm() - region_.radius_mm);
}

Eigen::Vector3d RegionDistance::low(double margin_mm) const {
  return middle_.array() - half_.array() - margin_mm;
}
Eigen::Vector3d RegionDistance::high(double margin_mm) const {
  return middle_.array() + half_.array() + margin_mm;
}

}  // namespace voxtet
