// A colour image -> the bytes of a PNG.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "io/bytes/bytes.h"

namespace voxtet {

using Rgb = std::array<std::uint8_t, 3>;

/// Rows from top to bottom. Equal images give equal bytes.
struct Picture {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;  ///< width * height
};

/// 8 bits a channel, no alpha (ISO/IEC 15948).
Bytes write_png(const Picture& picture);

}  // namespace voxtet
