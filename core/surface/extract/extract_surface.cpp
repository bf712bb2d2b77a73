#include "surface/extract/extract_surface.h"

#include <new>
#include <string>
#include <vector>

#include "surface/extract/extract_methods.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

struct LabelCount {
  Label smallest = kBackground;
  bool several = false;
};

LabelCount count_labels(const std::vector<Label>& labels) {
  LabelCount found;
  Label first = kBackground;
  for (const Label label : labels) {
    if (label == kBackground || label == first) continue;
    if (first == kBackground) {
      first = found.smallest = label;
    } else {
      found.several = true;
      if (label < found.smallest) found.smallest = label;
    }
  }
  return found;
}

Error bad_input(const std::string& message) {
  return {ErrorCode::kBadInput, kSurfaceStage, message, {}};
}

std::string size_text(const LabelVolume& volume) {
  return std::to_string(volume.size[0]) + " x " + std::to_string(volume.size[1]) + " x " +
         std::to_string(volume.size[2]);
}

Status check_volume(const LabelVolume& volume) {
  if (volume.size[0] < 1 || volume.size[1] < 1 || volume.size[2] < 1)
    return bad_input("the volume's size is " + size_text(volume) + ", expected at least 1 x 1 x 1");
  if (volume.labels.size() != volume.voxel_count())
    return bad_input("the volume has " + std::to_string(volume.labels.size()) + " labels, expected " +
                     size_text(volume));
  if (!volume.index_to_mm.allFinite() || !(volume.voxel_mm3() > 0))
    return bad_input("the volume's affine is singular or not finite, expected an invertible one");
  return std::monostate{};
}

}  // namespace

Result<SurfaceMesh> extract_surface(const LabelVolume& volume, const ExtractParams& params, RunContext& ctx) {
  if (const Status status = check_volume(volume); !status) return status.error();
  const LabelCount found = count_labels(volume.labels);
  if (found.smallest == kBackground)
    return bad_input("no voxel of the " + size_text(volume) + " volume has a label, expected at least one");
  const bool binary = params.method == ExtractMethod::kMarchingCubes ||
                      (params.method == ExtractMethod::kAuto && !found.several);
  try {
    return binary ? extract_marching_cubes(volume, found.smallest, ctx) : extract_marching_tets(volume, ctx);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory,
                 kSurfaceStage,
                 "not enough memory for the surface of a " + size_text(volume) + " volume",
                 {}};
  }
}

}  // namespace voxtet
