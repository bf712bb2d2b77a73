// The keywords and arrays of a legacy VTK file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/mesh/read/shared/mesh_cursor.h"

namespace voxtet {

struct VtkArray {
  std::string name;
  std::int64_t components = 1;
  std::vector<double> values;  ///< may be NaN
};

/// What a legacy file holds; arrays without those of texts.
struct VtkFile {
  std::string title;
  std::vector<double> points;
  /// Cell c has the points connectivity[offsets[c]] to connectivity[offsets[c + 1] - 1].
  std::vector<std::int64_t> offsets, connectivity, types;
  std::vector<VtkArray> field_data, cell_data, point_data;
};

/// Reads a whole file; `in` stands at its beginning. Checks that there are as many types and values as cells
/// and points, and that offsets ascend within the connectivity, but not which points cells have.
VtkFile read_vtk_file(MeshCursor& in);

}  // namespace voxtet
