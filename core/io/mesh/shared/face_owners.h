// The tetrahedra that boundary faces belong to.
#pragma once

#include <cstdint>
#include <vector>

#include "types/result.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// A face, as the side of a tetrahedron opposite to one corner.
struct FaceOwner {
  std::uint32_t tet = 0;
  std::uint32_t opposite = 0;  ///< 0 to 3
};

/// For each face the tetrahedron behind it: the one of label sides[0]. Errors: kInternal naming a face that
/// is on no tetrahedron of this label.
Result<std::vector<FaceOwner>> face_owners(const TetMesh& mesh);

}  // namespace voxtet
