// Where an adapted surface fails to follow the label surface.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "remesh/delaunay/seed_junctions.h"
#include "remesh/field/label_field.h"
#include "types/surface_mesh.h"
#include "walls/wall_layers.h"

namespace voxtet::remesh {

struct MissedCriteria {
  double limit_mm;       ///< farther than this from the surface counts as missed
  double separation_mm;  ///< between the places
  /// Around these labels (ascending), at the suspect voxels or all over if there are none, every other
  /// triangle of the reference is a sample, not only some 100,000 of all, and missed also where the closest
  /// triangle is turned by more than an angle: the wall of a tunnel has its lid near, but nothing parallel.
  std::vector<Label> thorough = {};
  std::vector<bool> suspects = {};  ///< SuspectVoxels::of the surface and these labels
  double turned_cosine = 0.3;       ///< of that angle
  double narrow_share = 1;          ///< of the limit: what it is there where labels are narrow
};

/// Where surfaces, one better than the other, miss a reference. Holds the reference and its field.
class MissedPlaces {
 public:
  MissedPlaces(const SurfaceMesh& reference, const LabelField& field);

  /// Samples of the reference (triangles' centroids, evenly through its list) that are farther than the limit
  /// from the triangles of `surface` between the same two labels, each moved along its normal onto the
  /// field's interface of the two labels, where that is within the limit; left out where it is not. Grouped
  /// by labels, in the order of the reference. A triangle that has followed a sample and is still there is
  /// looked at first, and will do.
  std::vector<Eigen::Vector3d> of(const SurfaceMesh& surface, const MissedCriteria& criteria);

 private:
  const SurfaceMesh& reference_;
  const LabelField& field_;
  std::vector<std::uint32_t> samples_;      ///< triangles that may be samples, by their two labels
  std::vector<std::uint64_t> followed_by_;  ///< by sample, what names the triangle that was last closest
};

/// A point of a reference that is far from a surface, and the surface's triangle that is closest.
struct FarPoint {
  Eigen::Vector3d point;
  std::uint32_t triangle;
};

/// Points of the reference that are farther than the limit from the triangles of `surface` between the same
/// two labels, layers counted as their parents. Once for every two labels that meet there, in their order.
std::vector<FarPoint> far_points(const SurfaceMesh& reference, const SurfaceMesh& surface,
                                 const WallLayers& layers, double limit_mm);

/// Points on the junction curves of `reference` (its junction_edges): middles of edges that are farther than
/// the limit from the junction curves of `surface`, then what is closest to middles of the surface's junction
/// edges that are farther than the limit from the reference's. In the order of the edges.
std::vector<Eigen::Vector3d> missed_junctions(const SurfaceMesh& reference, const std::vector<Edge>& edges,
                                              const SurfaceMesh& surface, double limit_mm);

}  // namespace voxtet::remesh
