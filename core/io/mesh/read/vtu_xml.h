// The XML of a .vtu file as far as a reader of grids needs it: which arrays there are and where their text
// is.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "types/result.h"

namespace voxtet {

/// A <DataArray> or <Array>. All views point into the file.
struct VtuArray {
  std::string_view section;  ///< "Points", "Cells", "CellData", "FieldData", ...
  std::string_view name, type, format, offset, components, tuples;
  std::string_view text;  ///< inline content
};

struct VtuPiece {
  std::string_view points, cells;  ///< NumberOfPoints, NumberOfCells
  std::vector<VtuArray> arrays;
};

struct VtuDocument {
  std::string_view grid_type, byte_order, header_type, compressor;
  std::vector<VtuArray> field_data;
  std::vector<VtuPiece> pieces;
  std::string_view appended_encoding;  ///< "raw", "base64", or empty without appended data
  std::string_view appended;           ///< from behind the "_" to the end of the file
};

/// Strict for what it uses (tags closed in order, attributes in quotes); knows no entities, CDATA or DTD,
/// which grids do not need. Stops at the appended data. The error message holds the line and no file name.
Result<VtuDocument> parse_vtu_xml(std::string_view file);

}  // namespace voxtet
