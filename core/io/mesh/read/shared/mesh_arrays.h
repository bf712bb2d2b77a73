// What a file has besides tetrahedra and their labels: values, and the names of labels.
#pragma once

#include <string>
#include <vector>

#include "types/field.h"
#include "types/label_volume.h"

namespace voxtet {

struct MeshArrays {
  std::vector<Field> cell_data;  ///< as many values as the mesh has tetrahedra
  /// Names of arrays of VTU whose values are not one finite number each, or that a piece lacks.
  std::vector<std::string> left_out;
  /// What was done where a file has no labels, or not as they are expected, for people: full sentences.
  std::vector<std::string> notes;
  std::vector<LabelInfo> infos;  ///< names of labels, ascending by label; those that files make up are none
};

}  // namespace voxtet
