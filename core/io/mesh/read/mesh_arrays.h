// What a file says of its tetrahedra beside their labels.
#pragma once

#include <string>
#include <vector>

#include "types/field.h"

namespace voxtet {

struct MeshArrays {
  std::vector<Field> cell_data;  ///< as many values as the mesh has tetrahedra
  std::vector<std::string>
      left_out;  ///< names of arrays that are not a finite number each, or not in every piece
};

}  // namespace voxtet
