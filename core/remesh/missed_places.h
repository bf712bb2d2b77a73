// Where an adapted surface fails to follow the label surface.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "remesh/label_field.h"
#include "types/surface_mesh.h"

namespace voxtet::remesh {

/// Samples of `reference` (triangles' centroids, at most about 80,000, evenly through its list) that are
/// farther than `limit_mm` from the triangles of `surface` between the same two labels, each moved along its
/// normal onto the field's interface of the two labels, where that is within `limit_mm`; left out where it
/// is not. Not closer to each other than `separation_mm`. In the order of the reference.
std::vector<Eigen::Vector3d> missed_places(const SurfaceMesh& reference, const SurfaceMesh& surface,
                                           const LabelField& field, double limit_mm, double separation_mm);

}  // namespace voxtet::remesh
