#include "io/bytes/write_png.h"

#include <zlib.h>

#include <string_view>

namespace voxtet {
namespace {

void add_number(std::uint32_t number, Bytes& out) {
  for (const int shift : {24, 16, 8, 0}) out.push_back(static_cast<std::uint8_t>(number >> shift));
}

void add_chunk(std::string_view type, const Bytes& data, Bytes& out) {
  add_number(static_cast<std::uint32_t>(data.size()), out);
  const std::size_t start = out.size();
  out.insert(out.end(), type.begin(), type.end());
  out.insert(out.end(), data.begin(), data.end());
  add_number(static_cast<std::uint32_t>(crc32(0, out.data() + start, static_cast<uInt>(out.size() - start))),
             out);
}

/// Each row as the difference to the one above (filter 2), which compresses shaded surfaces well.
Bytes filtered(const Picture& picture) {
  Bytes out;
  const auto width = static_cast<std::size_t>(picture.width);
  for (std::size_t y = 0; y < static_cast<std::size_t>(picture.height); ++y) {
    out.push_back(2);
    for (std::size_t x = 0; x < width; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        const int above = y > 0 ? picture.pixels[(y - 1) * width + x][c] : 0;
        out.push_back(static_cast<std::uint8_t>(picture.pixels[y * width + x][c] - above));
      }
  }
  return out;
}

}  // namespace

Bytes write_png(const Picture& picture) {
  Bytes out{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'}, header;
  add_number(static_cast<std::uint32_t>(picture.width), header);
  add_number(static_cast<std::uint32_t>(picture.height), header);
  header.insert(header.end(), {8, 2, 0, 0, 0});  // bits, RGB, deflate, filters, not interlaced
  add_chunk("IHDR", header, out);
  const Bytes rows = filtered(picture);
  uLongf size = compressBound(static_cast<uLong>(rows.size()));
  Bytes packed(size);
  compress2(packed.data(), &size, rows.data(), static_cast<uLong>(rows.size()), Z_BEST_COMPRESSION);
  packed.resize(size);
  add_chunk("IDAT", packed, out);
  add_chunk("IEND", {}, out);
  return out;
}

}  // namespace voxtet
