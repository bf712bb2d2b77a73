// Signed distances from voxel centres to the label boundaries of a surface.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "types/label_volume.h"
#include "types/surface_mesh.h"

namespace voxtet::remesh {

/// For each voxel centre, the labels among its 26 neighbours with the signed distance to each label's
/// boundary, in units of the smallest spacing. It is positive only for the voxel's own label. Its absolute
/// value is within [kNearest, kFarthest], at thin voxels (thin_voxels.h) at least kNearestThin, so that
/// sheets and wires are wide enough to be followed. The list is empty if all neighbours have the voxel's own
/// label.
struct LabelDistances {
  static constexpr float kNearest = 0.05F, kNearestThin = 0.3F, kFarthest = 2.0F;

  std::vector<std::uint32_t> offsets;  ///< voxel_count + 1
  std::vector<Label> labels;           ///< ascending within a voxel
  std::vector<float> values;
};

/// `volume`: its outermost layers are background. `surface`: boundary complex of its labels, within about
/// half a voxel of the voxels' faces; points in mm. The sign follows from the voxel's own label, even where
/// the surface has passed its centre. Exact if the closest point lies on a triangle of the closest vertex.
/// Linear time.
LabelDistances label_distances(const LabelVolume& volume, const SurfaceMesh& surface, int threads = 1);

}  // namespace voxtet::remesh
