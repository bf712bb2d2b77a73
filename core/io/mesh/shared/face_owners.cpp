#include "io/mesh/shared/face_owners.h"

#include <algorithm>
#include <string>

namespace voxtet {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;

Triangle ascending(Triangle corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// The faces in lists by their smallest corner.
struct FaceLists {
  std::vector<std::uint32_t> first;  ///< per point
  std::vector<std::uint32_t> next;   ///< per face
};

FaceLists list_faces(const TetMesh& mesh) {
  FaceLists lists{std::vector<std::uint32_t>(mesh.points.size(), kNone), {}};
  lists.next.reserve(mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    std::uint32_t& first = lists.first[ascending(mesh.faces[f])[0]];
    lists.next.push_back(first);
    first = static_cast<std::uint32_t>(f);
  }
  return lists;
}

}  // namespace

Result<std::vector<FaceOwner>> face_owners(const TetMesh& mesh) {
  const FaceLists lists = list_faces(mesh);
  std::vector<FaceOwner> owners(mesh.faces.size(), {kNone, 0});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (std::uint32_t opposite = 0; opposite < 4; ++opposite) {
      const Tet& tet = mesh.tets[t];
      const Triangle side =
          ascending({tet[(opposite + 1) % 4], tet[(opposite + 2) % 4], tet[(opposite + 3) % 4]});
      for (std::uint32_t f = lists.first[side[0]]; f != kNone; f = lists.next[f])
        if (mesh.face_sides[f][0] == mesh.labels[t] && ascending(mesh.faces[f]) == side)
          owners[f] = {static_cast<std::uint32_t>(t), opposite};
    }
  for (std::size_t f = 0; f < owners.size(); ++f)
    if (owners[f].tet == kNone)
      return Error{ErrorCode::kInternal,
                   "write_mesh",
                   "face " + std::to_string(f) + " is on no tetrahedron of label " +
                       std::to_string(mesh.face_sides[f][0]),
                   {}};
  return owners;
}

}  // namespace voxtet
