// Voxels at which the topology of an adapted surface may differ from that of the label surface.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "remesh/label_field.h"
#include "types/surface_mesh.h"

namespace voxtet::remesh {

/// Looks at the ways from voxel centres to their neighbours, the edges of the Kuhn tetrahedra, and where
/// surfaces cross them. Holds the field and what crosses the ways of the reference.
class SuspectVoxels {
 public:
  SuspectVoxels(const SurfaceMesh& reference, const LabelField& field);

  /// By voxel of the field's padded grid: whether it is, or is next to,
  /// - a voxel whose centre the surface gives another label than the volume, one or both of the two labels of
  ///   `labels` (ascending), unless that takes or adds a simple point (Bertrand 1994), or
  /// - the end of a way that triangles beside `labels` cross although both centres keep their one label,
  /// where
  ///   the reference's do not.
  /// Empty if there are none.
  std::vector<bool> of(const SurfaceMesh& surface, const std::vector<Label>& labels) const;

 private:
  /// A triangle on a way, seen from one of its ends.
  struct Crossing {
    std::uint64_t voxel;  ///< offset in the grid
    double at;            ///< share of the way
    std::uint32_t triangle;
    std::uint8_t way;  ///< 0..6 forwards, 7..13 the same backwards
    Label label;       ///< on the side of the voxel
  };
  /// Of both ends of each way, by voxel, then by the share of the way.
  std::vector<Crossing> crossings(const SurfaceMesh& surface) const;
  Eigen::Vector3i voxel_of(std::uint64_t offset) const;
  bool inside(const Eigen::Vector3i& voxel) const;
  void mark_around(std::uint64_t voxel, std::vector<bool>& marked) const;

  const LabelField& field_;
  std::vector<std::uint64_t> reference_ways_;  ///< that the reference crosses; ascending
};

}  // namespace voxtet::remesh
