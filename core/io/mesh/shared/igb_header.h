// The header of .igb files ("IGB File" in the manual of CARP, output file formats).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/bytes/bytes.h"
#include "types/result.h"

namespace voxtet {

/// 1024 bytes of words "keyword:value", then t frames of x * y * z values each. A true value is that of the
/// file times `facteur` plus `zero`.
struct IgbHeader {
  static constexpr std::size_t kBytes = 1024;
  enum class Type { kByte, kChar, kShort, kInt, kUint, kFloat, kDouble };

  std::uint64_t values = 0;  ///< of a frame: x * y * z
  std::uint64_t frames = 1;
  Type type = Type::kFloat;
  bool big_endian = false;
  double facteur = 1, zero = 0;
  double first_ms = 0, interval_ms = 1;
  std::string unit = "1";

  std::size_t value_bytes() const;
};

/// Reads and checks the header of a whole file: x, y, type and systeme are required, the size must be that of
/// the frames; a form feed may follow them. Times: org_t, and inc_t or else dim_t / (t - 1), in unites_t (ms
/// or s). Errors: kBadInput without the name of the file.
Result<IgbHeader> read_igb_header(std::span<const std::uint8_t> file);

/// The values of a frame, which must be finite. `file` is the one that the header was read from.
Result<std::vector<float>> read_igb_frame(std::span<const std::uint8_t> file, const IgbHeader& header,
                                          std::size_t frame);

}  // namespace voxtet
