#include "physics/ventricles/wall_depth.h"

#include <algorithm>
#include <initializer_list>
#include <vector>

namespace voxtet {
namespace {

using enum HeartSurface;

ClosestPointTree tree_of(const TetMesh& mesh, const HeartSurfaces& surfaces,
                         std::initializer_list<HeartSurface> wanted) {
  std::vector<Triangle> triangles;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (std::find(wanted.begin(), wanted.end(), surfaces.faces[f]) != wanted.end())
      triangles.push_back(mesh.faces[f]);
  return {mesh.points, triangles};
}

}  // namespace

WallDepth::WallDepth(const TetMesh& mesh, const HeartSurfaces& surfaces)
    : left_{tree_of(mesh, surfaces, {kLvEndocardium}),
            tree_of(mesh, surfaces, {kEpicardium, kRvEndocardium, kRvSeptum})} {
  if (surfaces.right)
    right_.emplace(Sides{tree_of(mesh, surfaces, {kRvEndocardium, kRvSeptum}),
                         tree_of(mesh, surfaces, {kEpicardium, kLvEndocardium})});
}

double WallDepth::at(const Eigen::Vector3d& place, bool right) const {
  const Sides& sides = right ? *right_ : left_;
  const double in = sides.inner.closest(place).distance_mm, out = sides.outer.closest(place).distance_mm;
  // Both are 0 where the two surfaces meet.
  return in + out > 0 ? in / (in + out) : 0;
}

}  // namespace voxtet
