#include "volume/clean/clean_volume.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/with_commas.h"
#include "volume/clean/mend_handles.h"
#include "volume/clean/remove_specks.h"

namespace voxtet {
namespace {

std::string counted(std::size_t count, const std::string& what) {
  return with_commas(count) + " " + what + (count == 1 ? "" : "s");
}

/// One label has its surface by marching cubes, several by marching tetrahedra.
Connectivity connectivity_of(const LabelVolume& volume) {
  Label only = kBackground;
  for (const Label label : volume.labels) {
    if (label == kBackground || label == only) continue;
    if (only != kBackground) return Connectivity::kKuhn;
    only = label;
  }
  return Connectivity::kFaces;
}

/// "labels 1 (760), 2 (701), 3 (800) and 4 more"
std::string named(const Flaw& flaw) {
  constexpr std::size_t kMost = 4;
  const auto& labels = flaw.labels;
  if (labels.size() == 1) return "label " + std::to_string(labels[0].first);
  std::string text = "labels";
  for (std::size_t i = 0; i < std::min(kMost, labels.size()); ++i)
    text +=
        (i == 0 ? " " : ", ") + std::to_string(labels[i].first) + " (" + with_commas(labels[i].second) + ")";
  return text + (labels.size() > kMost ? " and " + std::to_string(labels.size() - kMost) + " more" : "");
}

class FlawCollector {
 public:
  void add(FlawKind kind, Label label, std::size_t count, std::size_t voxels, std::size_t largest = 0) {
    if (count == 0) return;
    Flaw& flaw = of_kind_.try_emplace(kind, Flaw{kind}).first->second;
    flaw.count += count;
    flaw.voxels += voxels;
    flaw.largest = std::max(flaw.largest, largest);
    if (label != kBackground) by_label_[kind][label] += count;
  }
  Flaws all() const {
    Flaws flaws;
    for (auto [kind, flaw] : of_kind_) {
      if (const auto labels = by_label_.find(kind); labels != by_label_.end())
        flaw.labels.assign(labels->second.begin(), labels->second.end());
      flaws.push_back(std::move(flaw));
    }
    return flaws;
  }

 private:
  std::map<FlawKind, Flaw> of_kind_;
  std::map<FlawKind, std::map<Label, std::size_t>> by_label_;
};

}  // namespace

const char* name_of(FlawKind kind) {
  switch (kind) {
    case FlawKind::kPieces: return "pieces";
    case FlawKind::kHoles: return "holes";
    case FlawKind::kHandles: return "handles";
    case FlawKind::kTunnels: return "tunnels";
    case FlawKind::kPits: break;
  }
  return "pits";
}

std::string in_words(const Flaw& flaw) {
  const std::string voxels = counted(flaw.voxels, "voxel");
  const std::string largest = flaw.count > 1 ? ", the largest of " + with_commas(flaw.largest) : "";
  switch (flaw.kind) {
    case FlawKind::kPieces:
      return counted(flaw.count, "loose piece") + " of " + named(flaw) + ": " + voxels + largest;
    case FlawKind::kHoles: return counted(flaw.count, "enclosed hole") + ": " + voxels + largest;
    case FlawKind::kHandles:
      return counted(flaw.count, "thin handle") + " of " + named(flaw) + ": " + voxels + " to take away";
    case FlawKind::kTunnels:
      return counted(flaw.count, "thin tunnel") + " through " + named(flaw) + ": " + voxels + " to fill";
    case FlawKind::kPits: break;
  }
  return counted(flaw.count, "thin pit") + " in " + named(flaw) + ": " + voxels + " to fill";
}

Flaws clean_volume(LabelVolume& volume, const CleanLimits& limits) {
  // Across faces a voxel may be alone that held to its label along a diagonal, once a handle is opened there.
  constexpr int kRounds = 4;
  const Connectivity connectivity = connectivity_of(volume);
  FlawCollector flaws;
  bool any = true;
  for (int round = 0; any && round < kRounds; ++round) {
    const auto removed = remove_specks(volume, {limits.speck_voxels, limits.hole_voxels});
    for (const auto& [label, pieces] : removed)
      flaws.add(label == kBackground ? FlawKind::kHoles : FlawKind::kPieces, label, pieces.pieces,
                pieces.voxels, pieces.largest);
    if (round > 0 && removed.empty()) break;
    const auto mended = mend_handles(volume, limits.handle_voxels, connectivity);
    for (const auto& [label, of] : mended) {
      flaws.add(FlawKind::kHandles, label, of.opened, of.opened_voxels);
      flaws.add(FlawKind::kTunnels, label, of.closed, of.closed_voxels);
      flaws.add(FlawKind::kPits, label, of.pits, of.pit_voxels);
    }
    any = !mended.empty();
  }
  return flaws.all();
}

Flaws find_flaws(LabelVolume volume) {
  return clean_volume(volume, kUsualCleaning);
}

}  // namespace voxtet
