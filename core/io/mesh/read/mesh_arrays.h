// Values on tetrahedra that a file has besides their labels.
#pragma once

#include <string>
#include <vector>

#include "types/field.h"

namespace voxtet {

struct MeshArrays {
  std::vector<Field> cell_data;  ///< as many values as the mesh has tetrahedra
  /// Names of arrays of VTU whose values are not one finite number each, or that a piece lacks.
  std::vector<std::string> left_out;
};

}  // namespace voxtet
