#include "pipeline/stages/side_sizes.h"

#include "types/stage_names.h"

namespace voxtet {
namespace {

/// The loaded volume of each entry, in order.
template <class Entry, class Loaded, class Volume>
Status find_side_volumes(const std::vector<Entry>& entries, const Loaded& loaded, const std::string& list,
                         std::vector<const Volume*>& out) {
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Entry& entry = entries[i];
    const std::string name = list + "[" + std::to_string(i) + "]: ";
    const auto found = loaded.find(entry.name);
    if (found == loaded.end())
      return Error{
          ErrorCode::kBadInput, kSizingStage, name + "the file '" + entry.name + "' has not been loaded", {}};
    const std::string& digest = found->second.digest;
    if (!entry.sha256.empty() && entry.sha256 != digest)
      return Error{ErrorCode::kBadInput,
                   kSizingStage,
                   name + "the case was made with '" + entry.name + "' of digest " +
                       entry.sha256.substr(0, 12) + "..., the file loaded has " + digest.substr(0, 12) +
                       "...: these are different volumes",
                   {}};
    out.push_back(&found->second.volume);
  }
  return std::monostate{};
}

}  // namespace

Result<SizingField> build_sizing_field_of(const LoadedFiles& files, const SizingParams& sizing,
                                          const LabelVolume& volume, const SurfaceMesh& smooth,
                                          const Walls& walls, RunContext& ctx) {
  std::vector<const LabelVolume*> masks;
  std::vector<const ScalarVolume*> images;
  if (Status found = find_side_volumes(sizing.masks, files.masks, "sizing.masks", masks); !found)
    return found.error();
  if (Status found = find_side_volumes(sizing.images, files.images, "sizing.images", images); !found)
    return found.error();
  return build_sizing_field(volume, sizing, ctx, {walls, masks, images, &smooth});
}

}  // namespace voxtet
