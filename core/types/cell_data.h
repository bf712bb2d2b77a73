// Values that go with the elements of a mesh into files.
#pragma once

#include <string>
#include <vector>

namespace voxtet {

/// One value per tet under a name of letters, digits and underscores. Labels are exact as float.
struct CellData {
  std::string name;
  std::vector<float> values;
};

}  // namespace voxtet
