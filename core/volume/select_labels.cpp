#include "volume/select_labels.h"

#include "types/stage_names.h"

#include <algorithm>
#include <functional>
#include <string>

namespace voxtet {
namespace {

std::string listed(const std::vector<Label>& labels) {
  std::string text;
  for (const Label label : labels) text += (text.empty() ? "" : ", ") + std::to_string(label);
  return text;
}

bool holds(const std::vector<Label>& labels, Label label) {
  return std::find(labels.begin(), labels.end(), label) != labels.end();
}

/// For each kept label the one it is to carry, in `map` (65536 entries).
Status map_groups(const std::vector<LabelGroup>& groups, const std::vector<Label>& present,
                  const std::vector<Label>& kept, std::vector<Label>& map) {
  std::vector<std::size_t> group_of(65536, groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const std::string path = "merge[" + std::to_string(g) + "]";
    if (groups[g].empty())
      return usage_error(kVolumeStage, path + ": found no label, expected a group of labels to merge");
    const Label smallest = *std::min_element(groups[g].begin(), groups[g].end());
    for (const Label label : groups[g]) {
      const std::string name = "label " + std::to_string(label);
      if (!holds(present, label))
        return usage_error(kVolumeStage,
                           path + ": the volume holds no " + name + "; it holds " + listed(present));
      if (!holds(kept, label))
        return usage_error(kVolumeStage,
                           path + ": " + name + " is not among the labels to mesh, " + listed(kept));
      if (group_of[label] != groups.size())
        return usage_error(kVolumeStage, path + ": " + name + " is named already in merge[" +
                                             std::to_string(group_of[label]) +
                                             "]; a label belongs to one group");
      group_of[label] = g;
      map[label] = smallest;
    }
  }
  return std::monostate{};
}

}  // namespace

std::vector<std::pair<Label, std::size_t>> count_labels(const LabelVolume& volume) {
  std::vector<std::size_t> counts(65536, 0);
  // By runs: one counter after the other would wait for itself.
  for (auto at = volume.labels.begin(); at != volume.labels.end();) {
    const auto end = std::find_if(at, volume.labels.end(), [&](Label label) { return label != *at; });
    counts[*at] += static_cast<std::size_t>(end - at);
    at = end;
  }
  std::vector<std::pair<Label, std::size_t>> present;
  for (std::size_t label = 1; label < counts.size(); ++label)
    if (counts[label] > 0) present.emplace_back(static_cast<Label>(label), counts[label]);
  return present;
}

Result<std::shared_ptr<const LabelVolume>> select_labels(const std::shared_ptr<const LabelVolume>& volume,
                                                         const std::vector<Label>& wanted,
                                                         const std::vector<LabelGroup>& merge) {
  std::vector<Label> present;
  for (const auto& [label, count] : count_labels(*volume)) present.push_back(label);
  if (present.empty())
    return Error{ErrorCode::kBadInput, kVolumeStage, "the volume holds no label, only background", {}};
  std::vector<Label> kept = wanted.empty() ? present : wanted;
  std::sort(kept.begin(), kept.end());
  std::vector<Label> map(65536, kBackground);
  for (const Label label : kept) {
    if (!holds(present, label))
      return usage_error(kVolumeStage, "labels: the volume holds no label " + std::to_string(label) +
                                           "; it holds " + listed(present));
    map[label] = label;
  }
  if (Status mapped = map_groups(merge, present, kept, map); !mapped) return mapped.error();
  const auto stays = [&](Label label) { return map[label] == label; };
  const auto kept_info = [&](const LabelInfo& info) { return stays(info.label); };
  if (std::all_of(present.begin(), present.end(), stays) &&
      std::all_of(volume->infos.begin(), volume->infos.end(), kept_info))
    return volume;
  LabelVolume out = *volume;
  for (Label& label : out.labels) label = map[label];
  std::erase_if(out.infos, std::not_fn(kept_info));
  return std::make_shared<const LabelVolume>(std::move(out));
}

}  // namespace voxtet
