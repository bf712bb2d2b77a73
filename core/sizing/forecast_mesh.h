// A sizing field -> how large the mesh will be, before there is any.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/cut/cut_plane.h"
#include "types/label_volume.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"

namespace voxtet {

/// Numbers of the finished mesh. Triangles are those of the adapted surface, each counted once.
struct MeshForecast {
  double triangles = 0, points = 0, tets = 0;
  double filled_tets = 0;  ///< with those beyond cuts, which are made and then left out
};

/// What kind of adapted surface to expect.
struct SurfaceExpectation {
  double max_distance_voxels = 0.5;  ///< from triangles to labels
  /// True: it is refined until bends and thin places are resolved, as restricted Delaunay refinement does.
  /// False: it keeps only what local operations on the label surface cannot coarsen: a quarter of these extra
  /// triangles, as measured.
  bool resolves_thin_places = true;
};

/// What a label surface asks of any mesh, measured once for many sizing fields. The number of triangles of
/// the adapted surface is the integral of 2.15 / e^2 over the label surface. The number of tets is the
/// integral of 9.96 / e^3 over the labels, less 0.3 per triangle. e is the edge length that the mesh will
/// have: the target or, where that is less, the length that the adapted surface needs to follow bends
/// (geometry/elements/surface_curvature.h) and to resolve layers and gaps thinner than an edge; from there,
/// lengths rise inwards by 0.7 per mm. Constants and accuracy: tests/sweep/sweep_forecast.
class MeshForecaster {
 public:
  /// `label_surface` is the smoothed surface of the labels of `volume` that are not beyond `cuts`. Volume and
  /// cuts have to outlive this. Linear time.
  MeshForecaster(const LabelVolume& volume, const CutPlanes& cuts, const SurfaceMesh& label_surface,
                 const SurfaceExpectation& expectation);

  /// `sizing` lies on the grid that build_sizing_field gives the volume. Computing how lengths rise takes as
  /// long as limit_gradation. Errors: kCancelled.
  Result<MeshForecast> forecast(const SizingField& sizing, const RunContext& ctx) const;

 private:
  /// A piece of the label surface.
  struct Sample {
    Eigen::Vector3d at;
    double area_mm2, curvature, gap_mm;  ///< gap: distance to the next surface, on either side
  };
  /// Triangles per area as 1 / e^2, where e is the edge length of the mesh: at least 1 / edge_mm^2.
  double demand_per_mm2(const Sample& sample, double edge_mm) const;

  const LabelVolume& volume_;
  const CutPlanes& cuts_;
  SurfaceExpectation expectation_;
  std::vector<Sample> samples_;
};

/// The number of tets that the target edge lengths alone ask for: a lower bound of filled_tets, from a sum
/// over the voxels without any surface.
double least_tets(const LabelVolume& volume, const SizingField& sizing);

}  // namespace voxtet
