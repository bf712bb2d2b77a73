// Voxels at which the topology of an adapted surface may differ from that of the label surface.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "remesh/field/label_field.h"
#include "types/surface_mesh.h"

namespace voxtet::remesh {

/// Examines the segments from voxel centres to their neighbours (the edges of the Kuhn tetrahedra), and where
/// surfaces cross them. Refers to the reference and the field.
class SuspectVoxels {
 public:
  SuspectVoxels(const SurfaceMesh& reference, const LabelField& field);

  /// By voxel of the field's padded grid: whether it is, or is next to,
  /// - a voxel whose centre the surface gives another label than the volume, one or both of the two labels of
  ///   `labels` (ascending), unless that takes or adds a simple point (Bertrand 1994), or
  /// - the end of a segment that triangles beside `labels` cross although both centres keep their one label,
  ///   where the reference's do not, or
  /// - nearest to one of `touching`, points where the surface touches itself.
  /// Empty if there are none.
  std::vector<bool> of(const SurfaceMesh& surface, const std::vector<Label>& labels,
                       const std::vector<Eigen::Vector3d>& touching, int threads = 1) const;

 private:
  /// What find(voxel, segment, share of the segment, triangle, found) adds for every triangle that crosses a
  /// forward segment of a voxel for which wanted(voxel) holds; in the order of the triangles.
  template <class Found, class Wanted, class Find>
  std::vector<Found> crossings_of(const SurfaceMesh& surface, int threads, const Wanted& wanted,
                                  const Find& find) const;
  /// Whether the voxel, whatever its own label, can join or leave `label` without a change of topology.
  template <class LabelAt>
  bool stays_simple(std::uint64_t voxel, Label label, const LabelAt& label_at) const;
  /// The segments (voxel * segments + segment) that no triangle of the reference crosses, ascending.
  std::vector<std::uint64_t> not_of_reference(std::vector<std::uint64_t> segments, int threads) const;
  std::uint64_t end_of(std::uint64_t voxel, std::size_t segment) const;
  Eigen::Vector3i voxel_of(std::uint64_t offset) const;
  bool inside(const Eigen::Vector3i& voxel) const;
  void mark_around(std::uint64_t voxel, std::vector<bool>& marked) const;

  const SurfaceMesh& reference_;
  const LabelField& field_;
  std::size_t segments_;
  Eigen::Vector3i last_;  ///< last voxel of the grid
};

}  // namespace voxtet::remesh
