// How well a mesh keeps the labels: volumes, overlap, sizes, distances.
#pragma once

#include <vector>

#include "types/label_volume.h"
#include "types/quality_report.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// One entry per label of volume or mesh, ascending.
std::vector<LabelFidelity> measure_labels(const TetMesh& mesh, const LabelVolume& volume,
                                          const SizingField& sizing);

/// A set of triangles in mm.
struct TriangleSet {
  const std::vector<Eigen::Vector3d>& points;
  const std::vector<Triangle>& triangles;
};

/// Area-weighted distances from samples on `from` (sub-triangle centroids, spacing at most `spacing_mm`
/// unless that would take more than 400,000 samples; at least one a triangle) to `to`. No
/// point of `from` is farther than `max_mm + uncertainty_mm` from `to`.
DistanceSummary measure_distance(const TriangleSet& from, const TriangleSet& to, double spacing_mm);

}  // namespace voxtet
