// Values that go with the elements of a mesh into files.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "types/field.h"

namespace voxtet {

/// One value per tet under a name of letters, digits and underscores. Labels are exact as float.
struct CellData {
  std::string name;
  std::vector<float> values;
};

inline bool is_cell_data_name(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

}  // namespace voxtet
