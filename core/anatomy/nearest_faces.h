// Distances to named parts of the wall's surface.
#pragma once

#include <vector>

#include "anatomy/name_faces.h"
#include "base/parallel.h"
#include "geometry/search/closest_point.h"

namespace voxtet::anatomy {

/// The faces of whose kinds `wanted` approves.
template <class Wanted>
std::vector<Triangle> triangles_of(const WallSurface& surface, const FaceKinds& kinds, Wanted&& wanted) {
  std::vector<Triangle> triangles;
  for (std::size_t f = 0; f < kinds.size(); ++f)
    if (wanted(kinds[f])) triangles.push_back(surface.faces[f].corners);
  return triangles;
}

/// The closest point of the tree to the centre of every face of whose kind `wanted` approves; the origin and
/// distance 0 for all others.
template <class Wanted>
std::vector<ClosestPointTree::Hit> closest_to_faces(const ClosestPointTree& tree, const WallSurface& surface,
                                                    const FaceKinds& kinds, int threads, Wanted&& wanted) {
  std::vector<ClosestPointTree::Hit> hits(kinds.size(), {Eigen::Vector3d::Zero(), 0, 0});
  parallel_for(threads, kinds.size(), [&](std::size_t first, std::size_t last) {
    std::uint32_t hint = 0;
    for (std::size_t f = first; f < last; ++f) {
      if (!wanted(kinds[f])) continue;
      hits[f] = tree.closest(surface.faces[f].centre, hint);
      hint = hits[f].triangle;
    }
  });
  return hits;
}

}  // namespace voxtet::anatomy
