#include "pipeline/field_volume.h"

#include <algorithm>

namespace voxtet {
namespace {

float in_walls(const std::vector<WallField>& walls, const Eigen::Vector3d& mm, bool thickness) {
  for (const WallField& wall : walls) {
    if (!wall.holds(wall.to_index(mm))) continue;
    if (thickness) return static_cast<float>(wall.thickness_at(mm));
    return static_cast<float>(std::clamp(wall.potential_at(mm), 0.0, 1.0));
  }
  return thickness ? 0.F : -1.F;
}

}  // namespace

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
  out.values.reserve(volume.voxel_count());
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i) {
        const Eigen::Vector3d mm = volume.to_mm({1.0 * i, 1.0 * j, 1.0 * k});
        out.values.push_back(name == "size" ? static_cast<float>(session.sizing()->at(mm))
                                            : in_walls(session.walls(), mm, name == "thickness"));
      }
  return out;
}

}  // namespace voxtet
