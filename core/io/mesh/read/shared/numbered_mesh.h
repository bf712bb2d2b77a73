// A mesh whose points and tetrahedra have numbers of their own, as in most formats of text.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "io/mesh/read/shared/mesh_cursor.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// In file order; numbers ("tags") are at most 2^53 and may have gaps.
struct NumberedMesh {
  std::vector<std::uint64_t> node_tags;
  std::vector<Eigen::Vector3d> nodes;
  std::vector<std::uint64_t> tet_tags;
  std::vector<std::array<std::uint64_t, 4>> tets;  ///< node tags
  std::vector<std::int64_t> labels;                ///< of the tetrahedra, as the file has them
  std::uint64_t curved = 0;                        ///< tetrahedra whose points on edges were passed over

  void add_tet(std::uint64_t tag, const std::array<std::uint64_t, 4>& corners, std::int64_t label) {
    tet_tags.push_back(tag);
    tets.push_back(corners);
    labels.push_back(label);
  }
};

/// Points and tetrahedra in the order of their tags, without labels; `labels` of `numbered` are put into the
/// same order. Fails where a tag comes twice, or a tetrahedron has a node that is not there.
TetMesh assemble(MeshCursor& in, NumberedMesh& numbered);

}  // namespace voxtet
