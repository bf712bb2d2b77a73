// The named surfaces of one or two ventricles on a tetrahedral mesh.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace voxtet {

/// What a face of the mesh is a part of.
enum class HeartSurface : std::uint8_t {
  kNone,           ///< inside the wall, or not at the wall
  kEpicardium,     ///< the outside
  kLvEndocardium,  ///< around the left cavity
  kRvEndocardium,  ///< around the right cavity, on the side of its free wall
  kRvSeptum,       ///< around the right cavity, on the side of the septum
  kBase,           ///< the rim that is left where the ventricles are cut off or open into valves
};

/// As it stands in files: "none", "epicardium", "lv_endocardium", "rv_endocardium", "rv_septum", "base".
inline std::string_view name_of(HeartSurface surface) {
  constexpr std::string_view kNames[] = {"none",           "epicardium", "lv_endocardium",
                                         "rv_endocardium", "rv_septum",  "base"};
  return kNames[static_cast<int>(surface)];
}

/// A single ventricle has no kRvEndocardium and no kRvSeptum.
struct HeartSurfaces {
  std::vector<HeartSurface> faces;  ///< one for each of TetMesh::faces
  std::vector<bool> wall;           ///< one for each tetrahedron: whether it is of the ventricles' wall
  std::uint32_t apex = 0;           ///< the point of the epicardium that is farthest from the base
  bool right = false;               ///< whether there is a right ventricle
};

}  // namespace voxtet
