#include "io/volume/voxels/read_values.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "io/bytes/header_text.h"

namespace voxtet {
namespace {

constexpr std::size_t kBlockValues = std::size_t{1} << 12;

template <class T>
void decode(const std::uint8_t* in, std::span<double> out, const VoxelLayout& layout) {
  const bool scaled = layout.scaled();
  for (double& value : out) {
    value = static_cast<double>(load_value<T>(in, layout.big_endian));
    if (scaled) value = value * layout.slope + layout.inter;
    in += sizeof(T);
  }
}

void decode_any(const std::uint8_t* in, std::span<double> out, const VoxelLayout& layout) {
  switch (layout.type) {
    case VoxelType::kInt8: return decode<std::int8_t>(in, out, layout);
    case VoxelType::kUint8: return decode<std::uint8_t>(in, out, layout);
    case VoxelType::kInt16: return decode<std::int16_t>(in, out, layout);
    case VoxelType::kUint16: return decode<std::uint16_t>(in, out, layout);
    case VoxelType::kInt32: return decode<std::int32_t>(in, out, layout);
    case VoxelType::kUint32: return decode<std::uint32_t>(in, out, layout);
    case VoxelType::kInt64: return decode<std::int64_t>(in, out, layout);
    case VoxelType::kUint64: return decode<std::uint64_t>(in, out, layout);
    case VoxelType::kFloat32: return decode<float>(in, out, layout);
    case VoxelType::kFloat64: return decode<double>(in, out, layout);
  }
}

Error wrong_length(const VoxelLayout& layout, const std::string& found, std::uint64_t expected) {
  return bad_input(layout.stage, "the voxel data " + found + "; expected " + std::to_string(expected) +
                                     " bytes for " + std::to_string(layout.size[0]) + " x " +
                                     std::to_string(layout.size[1]) + " x " + std::to_string(layout.size[2]) +
                                     " voxels" +
                                     (layout.layers > 1   ? " of " + std::to_string(layout.layers) + " layers"
                                      : layout.frames > 1 ? " in " + std::to_string(layout.frames) + " frames"
                                                          : ""));
}

/// Nothing may follow the last voxel.
Status expect_end(ByteSource& source, const VoxelLayout& layout, std::uint64_t expected, Reading& reading) {
  std::uint8_t extra = 0;
  const Result<std::size_t> got = source.read({&extra, 1});
  if (!got) return got.error();
  if (*got > 0) {
    const std::string more =
        source.compressed() ? "go on" : "go on for " + std::to_string(1 + source.at_most_left()) + " bytes";
    return wrong_length(layout, more + " after the last voxel", expected);
  }
  if (source.padding() > 0)
    reading.note(std::to_string(source.padding()) + " zero bytes follow the compressed data; passed over");
  return std::monostate{};
}

}  // namespace

Status read_values(ByteSource& source, const VoxelLayout& layout, ValueSink& sink, Reading& reading) {
  const std::uint64_t count = layout.value_count();
  const std::size_t width = bytes_of(layout.type);
  const std::uint64_t expected = count * width;
  if (expected > source.at_most_left())
    return wrong_length(layout,
                        (source.compressed() ? "inflate to at most " : "are truncated: they have ") +
                            std::to_string(source.at_most_left()) + " bytes",
                        expected);
  sink.expect(count);
  std::vector<std::uint8_t> block(kBlockValues * width);
  std::array<double, kBlockValues> values;
  for (std::uint64_t done = 0; done < count;) {
    const auto batch = static_cast<std::size_t>(std::min<std::uint64_t>(count - done, kBlockValues));
    const Result<std::size_t> got = source.read({block.data(), batch * width});
    if (!got) return got.error();
    if (*got < batch * width)
      return wrong_length(
          layout, "are truncated: they have " + std::to_string(done * width + *got) + " bytes", expected);
    decode_any(block.data(), {values.data(), batch}, layout);
    if (Status taken = sink.take({values.data(), batch}); !taken) return taken;
    done += batch;
  }
  return expect_end(source, layout, expected, reading);
}

Status read_text_values(std::span<const std::uint8_t> text, const VoxelLayout& layout, ValueSink& sink) {
  const std::uint64_t count = layout.value_count();
  if (count > text.size() / 2)
    return bad_input(layout.stage, "the text data are truncated: " + std::to_string(text.size()) +
                                       " characters cannot hold " + std::to_string(count) +
                                       " numbers with white space after each");
  sink.expect(count);
  std::uint64_t done = 0;
  for (std::size_t at = 0;;) {
    while (at < text.size() && is_space(text[at])) ++at;
    if (at == text.size()) break;
    const std::size_t begin = at;
    while (at < text.size() && !is_space(text[at])) ++at;
    const std::string token(text.begin() + static_cast<std::ptrdiff_t>(begin),
                            text.begin() + static_cast<std::ptrdiff_t>(std::min(at, begin + 40)));
    if (done == count)
      return bad_input(layout.stage, "the text data go on after the last voxel with \"" + token +
                                         "\"; expected " + std::to_string(count) + " numbers");
    if (at == text.size())
      return bad_input(layout.stage, "the text data end inside the number \"" + token +
                                         "\"; expected white space after the last one");
    const std::optional<double> value = parse_double(token);
    if (!value)
      return bad_input(layout.stage,
                       voxel_name(layout, done) + " has the value \"" + token + "\"; expected a number");
    if (Status taken = sink.take({&*value, 1}); !taken) return taken;
    ++done;
  }
  if (done < count)
    return bad_input(layout.stage, "the text data are truncated: they have " + std::to_string(done) +
                                       " numbers; expected " + std::to_string(count));
  return std::monostate{};
}

}  // namespace voxtet
