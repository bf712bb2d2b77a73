// A sizing field -> how large the mesh will be, before there is any.
#pragma once

#include <cstdint>
#include <vector>

#include "types/label_volume.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"

namespace voxtet {

/// Of the finished mesh; triangles are those of the adapted surface, each counted once.
struct MeshForecast {
  double triangles = 0, points = 0, tets = 0;
};

/// Which surface is to be expected.
struct SurfaceExpectation {
  double max_distance_voxels = 0.5;  ///< from triangles to labels
  /// Refined until bends and thin places are resolved, as restricted Delaunay refinement does. Else only as
  /// far as local operations on the label surface cannot coarsen it, measured as a quarter of that.
  bool resolves_thin_places = true;
};

/// What a label surface asks of any mesh, measured once for many sizing fields. The triangles of the adapted
/// surface are the integral over the label surface of 2.15 / e^2, the tets that over the labels of 9.96 /
/// e^3, less 0.3 a triangle. There e is the edge length that the mesh will have: the target or, where
/// that is less, what the adapted surface takes to follow bends (geometry/elements/surface_curvature.h) and
/// to resolve layers and gaps thinner than an edge, from where lengths rise inwards by 0.7 a mm. Constants
/// and accuracy: tests/sweep/sweep_forecast.
class MeshForecaster {
 public:
  /// `label_surface` is the smoothed surface of the labels of `volume`, which has to outlive this. Linear
  /// time.
  MeshForecaster(const LabelVolume& volume, const SurfaceMesh& label_surface,
                 const SurfaceExpectation& expectation);

  /// `sizing` lies on the grid that build_sizing_field gives the volume. The rise of lengths takes as long as
  /// limit_gradation. Errors: kCancelled.
  Result<MeshForecast> forecast(const SizingField& sizing, const RunContext& ctx) const;

 private:
  /// A piece of the label surface.
  struct Sample {
    Eigen::Vector3d at;
    double area_mm2, curvature, gap_mm;  ///< gap: to the next surface, on either side
  };
  /// Triangles by area, in squared edges: at least 1 / edge_mm^2.
  double demand_per_mm2(const Sample& sample, double edge_mm) const;

  const LabelVolume& volume_;
  SurfaceExpectation expectation_;
  std::vector<Sample> samples_;
};

/// The tets that the target edge lengths alone ask for: a bound from below that needs a sum over the
/// voxels and no surface.
double least_tets(const LabelVolume& volume, const SizingField& sizing);

}  // namespace voxtet
