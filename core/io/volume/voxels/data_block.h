// The voxel data of formats with text headers: attached or in files beside it; raw, deflated or as text.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/bytes/volume_file.h"
#include "io/volume/voxels/read_values.h"

namespace voxtet {

enum class Packing { kRaw, kDeflated, kText };

/// How a header says its data are stored.
struct DataBlock {
  Packing packing = Packing::kRaw;
  std::int64_t skip_lines = 0;  ///< lines before the data, never inflated
  std::int64_t skip_bytes = 0;  ///< after the lines, counted in inflated data; -1: raw data are at the end of
                                ///< the file
  std::string skip_field;       ///< the header's name for `skip_bytes`
  std::int64_t said_bytes = -1;  ///< length of the deflated data by CompressedDataSize; -1: not said
};

/// `data` starts directly after the header, or is the whole file beside it. A wrong `said_bytes` is
/// warned of where the data are whole. Errors: kBadInput.
Status read_data_block(std::span<const std::uint8_t> data, const DataBlock& block, const VoxelLayout& layout,
                       ValueSink& sink, Reading& reading);

/// The field of a header that names files of data.
struct DataFiles {
  std::string field;               ///< "data file", "ElementDataFile"
  std::vector<std::string> names;  ///< beside the header; in the order of the slices
};

/// The names that lines give, one a line, to the end of the bytes.
std::vector<std::string> names_of_lines(std::span<const std::uint8_t> bytes);

/// The names of "slice%03d.raw 1 24 1": a pattern with the first and the last number and the step. What is
/// absent is 1, as many as there are `slices`, 1. Errors: kBadInput naming `field`.
Result<std::vector<std::string>> names_of_pattern(const std::string& stage, const std::string& field,
                                                  const std::string& text, std::int64_t slices);

/// Reads files one after another, each of the same number of slices. Absolute names and names that leave the
/// folder are refused. Errors: kBadInput.
Status read_data_files(const VolumeFile& file, const DataFiles& files, const DataBlock& block,
                       const VoxelLayout& layout, ValueSink& sink, Reading& reading);

}  // namespace voxtet
