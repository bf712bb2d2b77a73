#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "types/result.h"
#include "types/stage_names.h"
#include "types/surface_mesh.h"

namespace voxtet {

/// Most places that an error names.
inline constexpr std::size_t kMaxPlaces = 1000;

inline Error meshing_error(std::string message, ErrorPlace where = {}) {
  return {ErrorCode::kMeshing, kTetraStage, std::move(message), std::move(where)};
}

/// Triangles of a surface at which something is wrong: how many, and where the first ones are.
struct FaultyTriangles {
  std::size_t count = 0;
  ErrorPlace where;  ///< the triangles and their centroids, no more than kMaxPlaces

  FaultyTriangles(const SurfaceMesh& surface, const std::vector<bool>& marked)
      : count(static_cast<std::size_t>(std::count(marked.begin(), marked.end(), true))) {
    for (std::uint32_t t = 0; t < marked.size() && where.elements.size() < kMaxPlaces; ++t) {
      if (!marked[t]) continue;
      const auto [a, b, c] = surface.triangles[t];
      where.elements.push_back(t);
      where.points.push_back((surface.points[a] + surface.points[b] + surface.points[c]) / 3);
    }
  }
};

}  // namespace voxtet
