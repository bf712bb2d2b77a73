#include "pipeline/stages/wall_values.h"

#include <algorithm>
#include <limits>

namespace voxtet {
namespace {

float in_walls(const Walls& walls, const Eigen::Vector3d& mm, WallValue value) {
  for (const WallField& wall : walls) {
    if (!wall.holds(wall.to_index(mm))) continue;
    if (value == WallValue::kThickness) return static_cast<float>(wall.thickness_at(mm));
    return static_cast<float>(std::clamp(wall.potential_at(mm), 0.0, 1.0));
  }
  return std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

std::vector<float> wall_values(const Walls& walls, const LabelVolume& volume, WallValue value) {
  std::vector<float> out;
  out.reserve(volume.voxel_count());
  volume.visit([&](int i, int j, int k, std::size_t) {
    out.push_back(in_walls(walls, volume.to_mm(i, j, k), value));
  });
  return out;
}

}  // namespace voxtet
