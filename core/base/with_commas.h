// Counts as text.
#pragma once

#include <cstdint>
#include <string>

namespace voxtet {

/// "35,120"
inline std::string with_commas(std::uint64_t count) {
  std::string text = std::to_string(count);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, ",");
  return text;
}

}  // namespace voxtet
