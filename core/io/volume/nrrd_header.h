// The fields of an NRRD header, parsed but not yet interpreted.
// Format: G. Kindlmann, "Definition of NRRD File Format", teem.sourceforge.net/nrrd/format.html.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/bytes/byte_source.h"
#include "io/volume/data_block.h"
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
};

/// Errors: kBadInput for an unknown or repeated field, or a header without an end.
Result<NrrdHeader> parse_nrrd_header(std::span<const std::uint8_t> bytes);

/// Where the voxels are: which axes of the file are spatial, and the affine in RAS, mm.
struct NrrdGeometry {
  std::vector<std::int64_t> sizes;
  std::array<std::size_t, 3> axes{};     ///< the spatial axes of the file
  std::optional<std::size_t> list_axis;  ///< the other one of a four-dimensional file
  Eigen::Matrix4d index_to_mm = Eigen::Matrix4d::Identity();
};

Result<NrrdGeometry> nrrd_geometry(const NrrdHeader& header);

}  // namespace voxtet
