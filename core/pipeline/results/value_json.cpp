#include "pipeline/results/value_json.h"

#include "recipe/legend.h"
#include "volume/select_labels.h"

namespace voxtet {
namespace {

using nlohmann::json;

json colour_json(const LabelInfo& info) {
  if (info.colour[0] < 0) return nullptr;
  return colour_text(info.colour);
}

}  // namespace

json matrix_json(const Eigen::Matrix4d& m) {
  json out = json::array();
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) out.push_back(m(row, column));
  return out;
}

json volume_json(const LabelVolume& volume, const std::string& digest) {
  const Eigen::Vector3d spacing = volume.spacing_mm();
  json labels = json::array();
  for (const auto& [label, count] : count_labels(volume)) {
    json entry{
        {"label", label}, {"name", "label " + std::to_string(label)}, {"colour", nullptr}, {"voxels", count}};
    for (const LabelInfo& info : volume.infos) {
      if (info.label != label) continue;
      if (!info.name.empty()) entry["name"] = info.name;
      entry["colour"] = colour_json(info);
    }
    labels.push_back(std::move(entry));
  }
  return {{"size", volume.size},
          {"spacing_mm", {spacing.x(), spacing.y(), spacing.z()}},
          {"index_to_mm", matrix_json(volume.index_to_mm)},
          {"digest", digest},
          {"labels", labels}};
}

}  // namespace voxtet
