// The content of a file.
#pragma once

#include <cstdint>
#include <vector>

namespace voxtet {

using Bytes = std::vector<std::uint8_t>;

}  // namespace voxtet
