// The voxel data of formats with text headers: attached or in a sibling file; raw, deflated or as text.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/bytes/volume_file.h"
#include "io/volume/label_voxels.h"

namespace voxtet {

enum class Packing { kRaw, kDeflated, kText };

/// How a header says its data are stored.
struct DataBlock {
  Packing packing = Packing::kRaw;
  std::int64_t skip_lines = 0;  ///< lines before the data, never inflated
  std::int64_t skip_bytes = 0;  ///< after the lines, counted in inflated data; -1: raw data are at the end of
                                ///< the file
  std::string skip_field;       ///< the header's name for `skip_bytes`
};

/// Reads the sibling that the header's `field` names. Absolute names and names that leave the folder are
/// refused.
Result<Bytes> read_sibling(const VolumeFile& file, const std::string& stage, const std::string& field,
                           const std::string& name);

/// `data` starts directly after the header, or is the whole sibling. Errors: kBadInput.
Result<std::vector<Label>> read_data_block(std::span<const std::uint8_t> data, const DataBlock& block,
                                           const VoxelLayout& layout);

}  // namespace voxtet
