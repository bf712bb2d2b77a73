// How far two labelled complexes are apart.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "types/quality_report.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/surface_mesh.h"

namespace voxtet {

/// Triangles in mm with a label on each side.
struct TriangleSet {
  const std::vector<Eigen::Vector3d>& points;
  const std::vector<Triangle>& triangles;
  const std::vector<Sides>& sides;
};

struct DistanceParams {
  double spacing_mm = 0.25;    ///< between samples, or more where that would take more than 250,000
  double tolerance_mm = 0.05;  ///< how far the largest distance may be from the largest one found
};

struct SurfaceDistances {
  DistanceSummary forth, back;
};

/// Area-weighted distances from `a` to `b` and back. The boundary of each label is measured to that of the
/// same label, so that no other sheet nearby hides an error (an interface of two labels counts for both). If
/// the other set lacks the label, it is measured to the whole set. Mean, rms and p95 come from samples on a
/// lattice of every triangle (at least its corners). The largest distance is searched by branch and bound:
/// only pieces of triangles that could hold a larger one are divided, until none is left or 50,000 have been
/// divided; what remains open is `uncertainty_mm`. Bounds: between two points the distance to a surface
/// changes by no more than the points are apart, and the distance to one triangle is largest at a corner
/// (Guthe, Borodin, Klein, "Fast and accurate Hausdorff distance calculation between meshes", WSCG 2005). A
/// set without triangles gives zeros. Errors: kCancelled.
Result<SurfaceDistances> measure_distances(const TriangleSet& a, const TriangleSet& b,
                                           const DistanceParams& params, RunContext& ctx);

/// measure_distances in parts, for callers that have more to do at the same time.
class DistanceMeasurement {
 public:
  /// Everything that `a` and `b` refer to, and `ctx`, must outlive it.
  DistanceMeasurement(const TriangleSet& a, const TriangleSet& b, const DistanceParams& params,
                      RunContext& ctx);
  ~DistanceMeasurement();

  /// Measures one direction: 0 from `a`, 1 from `b`. Call it once for each; two threads may do so at the same
  /// time.
  void measure(std::size_t direction);
  Result<SurfaceDistances> result() const;
  /// Of each point of `a` (mm), once that direction was measured: the largest over the labels on whose
  /// boundary it lies. NaN for points of no triangle, and for all points if `b` has no triangles.
  std::vector<float> of_points() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace voxtet
