#include "io/volume/voxels/data_block.h"

#include <algorithm>
#include <optional>
#include <tuple>

#include "io/bytes/header_text.h"

namespace voxtet {
namespace {

constexpr std::int64_t kMostFiles = 20000, kMostNumber = 1000000000;

/// Reads the file beside the header that a field names.
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

/// "%03d" -> the digits of a number, at least so many.
struct NumberPlace {
  std::size_t begin = 0, end = 0;  ///< in the pattern
  std::size_t width = 0;
  char fill = ' ';
};

std::optional<NumberPlace> number_place(const std::string& pattern) {
  NumberPlace place;
  place.begin = pattern.find('%');
  std::size_t at = place.begin + 1;
  if (at < pattern.size() && pattern[at] == '0') place.fill = '0';
  for (; at < pattern.size() && pattern[at] >= '0' && pattern[at] <= '9'; ++at)
    place.width = std::min<std::size_t>(10 * place.width + static_cast<std::size_t>(pattern[at] - '0'), 100);
  if (at == pattern.size() || (pattern[at] != 'd' && pattern[at] != 'i' && pattern[at] != 'u'))
    return std::nullopt;
  place.end = at + 1;
  if (pattern.find('%', place.end) != std::string::npos) return std::nullopt;
  return place;
}

}  // namespace

Status read_data_block(std::span<const std::uint8_t> data, const DataBlock& block, const VoxelLayout& layout,
                       ValueSink& sink, Reading& reading) {
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
    return read_text_values(data.subspan(static_cast<std::size_t>(block.skip_bytes)), layout, sink);
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
  if (Status read = read_values(*source, layout, sink, reading); !read) return read;
  if (block.said_bytes >= 0 && static_cast<std::uint64_t>(block.said_bytes) != data.size())
    reading.warn("CompressedDataSize is " + std::to_string(block.said_bytes) +
                 ", but the compressed data have " + std::to_string(data.size()) +
                 " bytes; they are whole, and were read to their end");
  return std::monostate{};
}

std::vector<std::string> names_of_lines(std::span<const std::uint8_t> bytes) {
  std::vector<std::string> names;
  std::size_t at = 0;
  bool ended = false;
  while (const auto line = next_line(bytes, at, ended))
    if (const std::string_view name = trimmed(*line); !name.empty()) names.emplace_back(name);
  return names;
}

Result<std::vector<std::string>> names_of_pattern(const std::string& stage, const std::string& field,
                                                  const std::string& text, std::int64_t slices) {
  const auto refused = [&] {
    return bad_input(stage, field + " is " + in_quotes(text) +
                                "; expected a pattern with one %d, then the first and the last number and "
                                "the step between them, as slice%03d.raw 1 24 1");
  };
  const std::vector<std::string> words = words_of(text);
  const std::optional<NumberPlace> place = number_place(words[0]);
  std::vector<std::int64_t> numbers{1, 0, 1};
  for (std::size_t n = 1; n < std::min<std::size_t>(words.size(), 4); ++n) {
    const std::optional<std::int64_t> number = parse_integer(words[n]);
    if (!number || *number < 0 || *number > kMostNumber) return refused();
    numbers[n - 1] = *number;
  }
  if (words.size() < 3) numbers[1] = numbers[0] + slices - 1;
  const auto& [first, last, step] = std::tie(numbers[0], numbers[1], numbers[2]);
  if (!place || step < 1 || last < first || (last - first) / step >= kMostFiles) return refused();
  std::vector<std::string> names;
  for (std::int64_t number = first; number <= last; number += step) {
    std::string digits = std::to_string(number);
    if (digits.size() < place->width) digits.insert(0, place->width - digits.size(), place->fill);
    names.push_back(words[0].substr(0, place->begin) + digits + words[0].substr(place->end));
  }
  return names;
}

Status read_data_files(const VolumeFile& file, const DataFiles& files, const DataBlock& block,
                       const VoxelLayout& layout, ValueSink& sink, Reading& reading) {
  // Frames are slices too, one behind the other.
  const auto count = static_cast<std::int64_t>(files.names.size());
  const std::int64_t slices = layout.size[2] * layout.frames;
  if (count == 0 || slices % count != 0)
    return bad_input(layout.stage, files.field + " names " + std::to_string(count) +
                                       " files; expected one for each of the " + std::to_string(slices) +
                                       " slices, or the same number of slices in each");
  DataBlock part_block = block;
  if (count > 1) part_block.said_bytes = -1;
  VoxelLayout part = layout;
  part.size[2] = slices / count;
  part.frames = 1;
  for (const std::string& name : files.names) {
    const Result<Bytes> bytes = read_sibling(file, layout.stage, files.field, name);
    if (!bytes) return bytes.error();
    Status read = read_data_block(*bytes, part_block, part, sink, reading);
    if (!read && count > 1) return bad_input(layout.stage, in_quotes(name) + ": " + read.error().message);
    if (!read) return read;
  }
  return std::monostate{};
}

}  // namespace voxtet
