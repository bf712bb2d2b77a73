// Signed distances from voxel centres to the label boundaries of a surface.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "types/label_volume.h"
#include "types/surface_mesh.h"

namespace voxtet::remesh {

/// Labels of a padded volume, x fastest. The outermost layers are background.
struct LabelGrid {
  std::array<int, 3> size{};
  std::vector<Label> labels;

  std::size_t voxel_count() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
};

/// Per voxel centre, the labels among its 26 neighbours with the signed distance to each label's boundary in
/// units of the smallest spacing: positive for the voxel's own label alone, absolute value within
/// [kNearest, kFarthest], at thin voxels (thin_voxels.h) at least kNearestThin, so that sheets and wires are
/// wide enough to be followed. A voxel among its like has an empty list.
struct LabelDistances {
  static constexpr float kNearest = 0.05F, kNearestThin = 0.3F, kFarthest = 2.0F;

  std::vector<std::uint32_t> offsets;  ///< voxel_count + 1
  std::vector<Label> labels;           ///< ascending within a voxel
  std::vector<float> values;
};

/// `surface`: boundary complex of the labels of `grid`, within about half a voxel of the voxels' faces;
/// points in mm. `index_to_mm`, `origin_mm`: of the padded grid. The sign is the voxel's own label, also
/// where the surface has passed its centre. Exact where the closest point lies at the closest vertex's
/// triangles. Linear time.
LabelDistances label_distances(const LabelGrid& grid, const SurfaceMesh& surface,
                               const Eigen::Matrix3d& index_to_mm, const Eigen::Vector3d& origin_mm);

}  // namespace voxtet::remesh
