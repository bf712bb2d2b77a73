// How deep a place is in the wall of its ventricle.
// Potse, Dube, Richer, Vinet and Gulrajani, "A comparison of monodomain and bidomain reaction-diffusion
// models for action potential propagation in the human heart", IEEE Transactions on Biomedical Engineering 53
// (2006): the minimum distance parameter.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "geometry/search/closest_point.h"
#include "types/heart_surfaces.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// d_in / (d_in + d_out), with the distances in a straight line to the inner and to the outer surface of the
/// wall: 0 on the inner one, 1 on the outer one. It is linear in depth where a Laplace potential is not: in
/// the middle of a shell from 1 to 1.5, the potential is 0.6.
/// Left ventricle and septum: from the left endocardium to the epicardium or the right endocardium, whichever
/// is nearer. Right ventricle: from the right endocardium to the epicardium or the left endocardium.
class WallDepth {
 public:
  /// The surfaces are those that wall_system() accepts.
  WallDepth(const TetMesh& mesh, const HeartSurfaces& surfaces);

  /// At a place in mm; in the right ventricle only if there is one.
  double at(const Eigen::Vector3d& place, bool right) const;

 private:
  struct Sides {
    ClosestPointTree inner, outer;
  };
  Sides left_;
  std::optional<Sides> right_;
};

}  // namespace voxtet
