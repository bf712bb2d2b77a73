#include "pipeline/select_labels.h"

#include <algorithm>
#include <string>

namespace voxtet {

std::vector<std::pair<Label, std::size_t>> count_labels(const LabelVolume& volume) {
  std::vector<std::size_t> counts(65536, 0);
  for (const Label label : volume.labels) ++counts[label];
  std::vector<std::pair<Label, std::size_t>> present;
  for (std::size_t label = 1; label < counts.size(); ++label)
    if (counts[label] > 0) present.emplace_back(static_cast<Label>(label), counts[label]);
  return present;
}

Result<LabelVolume> select_labels(const LabelVolume& volume, const std::vector<Label>& wanted, bool merge) {
  const auto present = count_labels(volume);
  if (present.empty())
    return Error{ErrorCode::kBadInput, "volume", "the volume holds no label, only background", {}};
  std::vector<Label> kept = wanted;
  if (kept.empty())
    for (const auto& [label, count] : present) kept.push_back(label);
  std::sort(kept.begin(), kept.end());
  for (const Label label : kept) {
    if (std::any_of(present.begin(), present.end(), [&](const auto& p) { return p.first == label; }))
      continue;
    std::string held;
    for (const auto& [other, count] : present) held += (held.empty() ? "" : ", ") + std::to_string(other);
    return Error{ErrorCode::kUsage,
                 "volume",
                 "labels: the volume holds no label " + std::to_string(label) + "; it holds " + held,
                 {}};
  }
  std::vector<Label> map(65536, kBackground);
  for (const Label label : kept) map[label] = merge ? kept.front() : label;
  LabelVolume out = volume;
  for (Label& label : out.labels) label = map[label];
  std::erase_if(out.infos, [&](const LabelInfo& info) { return map[info.label] != info.label; });
  return out;
}

}  // namespace voxtet
