#include "io/volume/data_block.h"

#include "io/bytes/header_text.h"

namespace voxtet {

Result<Bytes> read_sibling(const VolumeFile& file, const std::string& stage, const std::string& field,
                           const std::string& name) {
  const bool drive = name.size() > 1 && name[1] == ':';
  if (name.empty() || name[0] == '/' || name[0] == '\\' || drive || name.find("..") != std::string::npos)
    return bad_input(stage, field + " is " + in_quotes(name) + "; expected a file beside the header");
  if (!file.sibling)
    return bad_input(stage,
                     field + " names the file " + in_quotes(name) + ", which was not given with the header");
  Result<Bytes> bytes = file.sibling(name);
  if (!bytes) return bad_input(stage, field + " names a file that cannot be read: " + bytes.error().message);
  return bytes;
}

Result<std::vector<Label>> read_data_block(std::span<const std::uint8_t> data, const DataBlock& block,
                                           const VoxelLayout& layout) {
  std::size_t at = 0;
  for (std::int64_t line = 0; line < block.skip_lines; ++line) {
    bool ended = false;
    if (!next_line(data, at, ended) || !ended)
      return bad_input(layout.stage, "line skip is " + std::to_string(block.skip_lines) +
                                         ", but the data have only " + std::to_string(line) + " lines");
  }
  data = data.subspan(at);
  const std::uint64_t expected = layout.value_count() * bytes_of(layout.type);
  if (block.packing == Packing::kText) {
    if (block.skip_bytes < 0 || static_cast<std::uint64_t>(block.skip_bytes) > data.size())
      return bad_input(layout.stage, block.skip_field + " is " + std::to_string(block.skip_bytes) +
                                         "; expected 0 to " + std::to_string(data.size()));
    return read_text_labels(data.subspan(static_cast<std::size_t>(block.skip_bytes)), layout);
  }
  std::uint64_t skip = static_cast<std::uint64_t>(block.skip_bytes);
  if (block.skip_bytes < 0) {
    if (block.skip_bytes != -1 || block.packing != Packing::kRaw)
      return bad_input(layout.stage, block.skip_field + " is " + std::to_string(block.skip_bytes) +
                                         "; expected 0 or more, or -1 with raw data");
    skip = data.size() > expected ? data.size() - expected : 0;
  }
  const std::unique_ptr<ByteSource> source =
      block.packing == Packing::kRaw ? make_memory_source(data) : make_inflate_source(data);
  if (Status skipped = skip_bytes(*source, skip, block.skip_field); !skipped)
    return bad_input(layout.stage, skipped.error().message);
  return read_labels(*source, layout);
}

}  // namespace voxtet
