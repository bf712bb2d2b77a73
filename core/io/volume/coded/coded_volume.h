// A label volume in as few bytes as a link can carry.
#pragma once

#include <span>

#include "io/bytes/bytes.h"
#include "types/label_volume.h"
#include "types/result.h"

namespace voxtet {

/// The largest volume that is decoded, in voxels: a link may come from anybody.
inline constexpr std::size_t kMostCodedVoxels = std::size_t{1} << 24U;

/// Labels and affine; names and colours (LabelVolume::infos) are left out. About 0.03 bits a voxel for a
/// heart. The same bytes on every platform. Errors: kUsage for more than 255 labels or kMostCodedVoxels.
Result<Bytes> code_volume(const LabelVolume& volume);

/// The volume that was coded, exactly. Errors: kBadInput for data that are damaged or end too early, and for
/// more than kMostCodedVoxels.
Result<LabelVolume> decode_volume(std::span<const std::uint8_t> bytes);

}  // namespace voxtet
