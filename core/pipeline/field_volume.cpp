#include "pipeline/field_volume.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxtet {
namespace {

/// Calls visit(mm) for each voxel, in order.
template <class Visit>
void for_voxels(const LabelVolume& volume, Visit&& visit) {
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i) visit(volume.to_mm({1.0 * i, 1.0 * j, 1.0 * k}));
}

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
  for_voxels(volume, [&](const Eigen::Vector3d& mm) { out.push_back(in_walls(walls, mm, value)); });
  return out;
}

Result<ScalarVolume> field_volume(const Session& session, std::string_view name) {
  if (name != "size" && name != "thickness" && name != "potential")
    return usage_error("field",
                       "no field '" + std::string(name) + "'; the fields are size, thickness, potential");
  if (!session.sizing()) return usage_error("field", "no fields yet: run the stage sizing");
  if (name != "size" && session.walls().empty())
    return usage_error("field",
                       "the case has no " + std::string(name) + ": its sizing.thickness names no wall");
  const LabelVolume& volume = *session.volume();
  ScalarVolume out{volume.size, volume.index_to_mm, {}};
  if (name == "size") {
    for_voxels(volume, [&](const Eigen::Vector3d& mm) {
      out.values.push_back(static_cast<float>(session.sizing()->at(mm)));
    });
    return out;
  }
  const bool thickness = name == "thickness";
  out.values =
      wall_values(session.walls(), volume, thickness ? WallValue::kThickness : WallValue::kPotential);
  // Images have numbers everywhere.
  for (float& value : out.values)
    if (std::isnan(value)) value = thickness ? 0.F : -1.F;
  return out;
}

}  // namespace voxtet
