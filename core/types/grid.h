// A regular grid: how many points it has along each axis, and where they are.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstddef>

namespace voxtet {

/// Points on a regular grid (for an image: the voxel centres). Index x runs fastest:
/// offset = i + size[0]*(j + size[1]*k). `index_to_mm` maps indices (points are at integers) to patient
/// space, RAS, mm. It may be oblique, mirrored (determinant < 0) or sheared, but never singular.
struct Grid {
  std::array<int, 3> size{0, 0, 0};
  Eigen::Matrix4d index_to_mm = Eigen::Matrix4d::Identity();

  std::size_t voxel_count() const { return offset(0, 0, size[2]); }
  std::size_t offset(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(size[0]) *
               (static_cast<std::size_t>(j) +
                static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(k));
  }
  std::size_t offset(const Eigen::Vector3i& index) const { return offset(index[0], index[1], index[2]); }
  /// Difference of offsets between a point and the next one along each axis.
  std::array<std::size_t, 3> strides() const { return {1, offset(0, 1, 0), offset(0, 0, 1)}; }
  bool contains(int i, int j, int k) const {
    return i >= 0 && j >= 0 && k >= 0 && i < size[0] && j < size[1] && k < size[2];
  }
  /// Whether a point of the grid has fewer than six neighbours.
  bool on_border(int i, int j, int k) const {
    return i == 0 || j == 0 || k == 0 || i + 1 == size[0] || j + 1 == size[1] || k + 1 == size[2];
  }
  /// Calls visit(i, j, k, offset) for every point, in the order of the offsets.
  template <class Visit>
  void visit(Visit&& visit) const {
    std::size_t at = 0;
    for (int k = 0; k < size[2]; ++k)
      for (int j = 0; j < size[1]; ++j)
        for (int i = 0; i < size[0]; ++i, ++at) visit(i, j, k, at);
  }

  Eigen::Matrix3d linear() const { return index_to_mm.topLeftCorner<3, 3>(); }
  Eigen::Vector3d origin() const { return index_to_mm.topRightCorner<3, 1>(); }
  /// Patient-space position (mm) of a continuous index.
  Eigen::Vector3d to_mm(const Eigen::Vector3d& index) const { return linear() * index + origin(); }
  Eigen::Vector3d to_mm(int i, int j, int k) const { return to_mm(Eigen::Vector3d(i, j, k)); }
  /// Distance between points along each index axis, mm.
  Eigen::Vector3d spacing_mm() const { return linear().colwise().norm().transpose(); }
  double smallest_spacing_mm() const { return spacing_mm().minCoeff(); }
  /// |det|: volume of one voxel, mm^3.
  double voxel_mm3() const { return std::abs(linear().determinant()); }
};

/// A grid that also maps points of space back to indices.
struct SearchableGrid : Grid {
  Eigen::Matrix4d mm_to_index = Eigen::Matrix4d::Identity();  ///< inverse of index_to_mm

  /// Sets mm_to_index. Call it after index_to_mm has been set.
  void invert() { mm_to_index = index_to_mm.inverse(); }
  /// Continuous index of a patient-space point (mm).
  Eigen::Vector3d to_index(const Eigen::Vector3d& point_mm) const {
    return mm_to_index.topLeftCorner<3, 3>() * point_mm + mm_to_index.topRightCorner<3, 1>();
  }
};

}  // namespace voxtet
