// The fields of an NRRD header, parsed but not yet interpreted.
// Format: G. Kindlmann, "Definition of NRRD File Format", teem.sourceforge.net/nrrd/format.html.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "io/bytes/byte_source.h"
#include "types/result.h"

namespace voxtet {

inline constexpr const char* kNrrdReader = "read_nrrd";

inline Error bad_nrrd(const std::string& message) {
  return bad_input(kNrrdReader, message);
}

struct NrrdHeader {
  std::map<std::string, std::string> fields;      ///< by lower-case name without spaces ("spaceorigin")
  std::map<std::string, std::string> key_values;  ///< the lines with ":=", escapes resolved
  std::size_t data_at = 0;                        ///< first byte behind the header

  const std::string* find(const std::string& name) const {
    const auto at = fields.find(name);
    return at == fields.end() ? nullptr : &at->second;
  }
  /// Whether the names of data files follow, one a line, to the end of the file.
  bool has_list() const {
    const std::string* name = find("datafile");
    return name != nullptr && (*name == "LIST" || name->starts_with("LIST "));
  }
};

/// Errors: kBadInput for an unknown or repeated field, or a header without an end.
Result<NrrdHeader> parse_nrrd_header(std::span<const std::uint8_t> bytes);

}  // namespace voxtet
