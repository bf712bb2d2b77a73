// A finished mesh -> its evidence.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "types/label_volume.h"
#include "types/quality_report.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"
#include "walls/count_layers.h"

namespace voxtet {

struct QualityParams {
  int histogram_bins = 64;
  double sample_spacing_voxels = 0.25;  ///< for distances, in units of the smallest voxel spacing
};

/// What the mesh is compared with.
struct QualityReference {
  const LabelVolume& volume;         ///< what was meshed: presence, components, size of a voxel
  const LabelVolume& labels;         ///< as segmented, on their own grid: volumes and overlap
  const SurfaceMesh& label_surface;  ///< the smoothed extraction: the reference of distances and topology
  const SurfaceMesh& adapted;        ///< the surface that was filled with tets
  const SizingField& sizing;
  std::span<const LayeredWall> walls = {};  ///< whose layers are counted
  std::map<Label, double> more_mm3{};       ///< by label, to be added to the volume of its voxels in `labels`
};

/// All measures of the element-quality section: dihedral angles, radius ratio, mean ratio, aspect ratio, edge
/// length against the sizing field (log2), triangle aspect ratio of `label_surface` and of `adapted`,
/// distances both ways label by label, volume, Dice and topology per label, layers of walls, and the
/// checklist. Errors: kUsage (parameters), kBadInput (indices out of range, no tetrahedra), kCancelled. A
/// mesh with coordinates that are not finite gets the checklist alone.
Result<QualityReport> measure_quality(const TetMesh& mesh, const QualityReference& reference,
                                      const QualityParams& params, RunContext& ctx);

/// The part of the report that needs the mesh alone (for `voxtet check` on any mesh file).
Result<QualityReport> measure_mesh(const TetMesh& mesh, const QualityParams& params, RunContext& ctx);

}  // namespace voxtet
