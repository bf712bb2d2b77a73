// The fields of a MetaImage header, parsed but not yet interpreted.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "io/bytes/byte_source.h"
#include "types/result.h"

namespace voxtet {

inline constexpr const char* kMetaImageReader = "read_metaimage";

inline Error bad_metaimage(const std::string& message) {
  return bad_input(kMetaImageReader, message);
}

struct MetaImageHeader {
  std::map<std::string, std::string> fields;  ///< by canonical name
  std::size_t data_at = 0;                    ///< first byte behind the header

  const std::string* find(const char* name) const {
    const auto at = fields.find(name);
    return at == fields.end() ? nullptr : &at->second;
  }
};

/// Unknown fields are allowed, as in MetaIO, unless they are one character away from a field that decides
/// where or what the voxels are. Errors: kBadInput for these, for repeated fields and a header without an
/// end.
Result<MetaImageHeader> parse_metaimage_header(std::span<const std::uint8_t> bytes);

/// The values of a field, or `otherwise` where it is absent. Errors: kBadInput naming the field.
Result<bool> meta_flag(const MetaImageHeader& header, const char* name, bool otherwise);
Result<std::vector<double>> meta_numbers(const MetaImageHeader& header, const char* name, std::size_t count,
                                         std::vector<double> otherwise);
Result<std::int64_t> meta_integer(const MetaImageHeader& header, const char* name, std::int64_t otherwise);

}  // namespace voxtet
