#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "types/result.h"

namespace voxtet {

/// Most places that an error names.
inline constexpr std::size_t kMaxPlaces = 1000;

inline Error meshing_error(std::string message, ErrorPlace where = {}) {
  return {ErrorCode::kMeshing, "tetra", std::move(message), std::move(where)};
}

}  // namespace voxtet
