#include "io/bytes/write_png.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <string>

namespace voxtet {
namespace {

std::uint32_t number_at(const Bytes& png, std::size_t at) {
  return (std::uint32_t{png[at]} << 24U) | (std::uint32_t{png[at + 1]} << 16U) |
         (std::uint32_t{png[at + 2]} << 8U) | png[at + 3];
}

TEST(WritePng, HasItsChunksAndItsPixels) {
  const Picture picture{2, 3, {{1, 2, 3}, {250, 5, 6}, {7, 8, 9}, {10, 11, 12}, {0, 0, 0}, {255, 255, 255}}};
  const Bytes png = write_png(picture);
  EXPECT_EQ(std::string(png.begin() + 1, png.begin() + 4), "PNG");
  Bytes packed;
  std::string types;
  std::size_t at = 8;
  while (at < png.size()) {
    const std::size_t size = number_at(png, at);
    const std::string type(png.begin() + static_cast<std::ptrdiff_t>(at) + 4,
                           png.begin() + static_cast<std::ptrdiff_t>(at) + 8);
    types += type + " ";
    EXPECT_EQ(number_at(png, at + 8 + size), crc32(0, png.data() + at + 4, static_cast<uInt>(size + 4)))
        << type;
    if (type == "IHDR") {
      EXPECT_EQ(number_at(png, at + 8), 2U);
      EXPECT_EQ(number_at(png, at + 12), 3U);
    }
    if (type == "IDAT")
      packed.assign(png.begin() + static_cast<std::ptrdiff_t>(at) + 8,
                    png.begin() + static_cast<std::ptrdiff_t>(at + 8 + size));
    at += size + 12;
  }
  EXPECT_EQ(at, png.size());
  EXPECT_EQ(types, "IHDR IDAT IEND ");
  Bytes rows(3 * (1 + 2 * 3));
  uLongf size = rows.size();
  ASSERT_EQ(uncompress(rows.data(), &size, packed.data(), static_cast<uLong>(packed.size())), Z_OK);
  ASSERT_EQ(size, rows.size());
  for (std::size_t y = 0; y < 3; ++y) {
    ASSERT_EQ(rows[7 * y], 2);  // the difference to the row above
    for (std::size_t i = 0; i < 6; ++i) {
      const int above = y > 0 ? picture.pixels[2 * (y - 1) + i / 3][i % 3] : 0;
      EXPECT_EQ(static_cast<std::uint8_t>(rows[7 * y + 1 + i] + above), picture.pixels[2 * y + i / 3][i % 3]);
    }
  }
}

}  // namespace
}  // namespace voxtet
