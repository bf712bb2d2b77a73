#include "pipeline/exports/field_volume.h"

#include <cmath>

#include "pipeline/stages/wall_values.h"

namespace voxtet {
Result<ScalarVolume> field_volume(const Session& session, std::string_view name) {
  if (name != "size" && name != "thickness" && name != "potential")
    return usage_error("field",
                       "no field '" + std::string(name) + "'; the fields are size, thickness, potential");
  if (!session.sizing()) return usage_error("field", "no fields yet: run the stage sizing");
  if (name != "size" && session.walls().empty())
    return usage_error("field",
                       "the case has no " + std::string(name) + ": its sizing.thickness names no wall");
  const LabelVolume& volume = *session.volume();
  ScalarVolume out{volume, {}};
  if (name == "size") {
    volume.visit([&](int i, int j, int k, std::size_t) {
      out.values.push_back(static_cast<float>(session.sizing()->at(volume.to_mm(i, j, k))));
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
