// The adapted surface by the paper's method: local operations on a labelled complex, each a transaction.
#pragma once

#include <array>
#include <cstdint>

#include "remesh/adapt/adapt_schedule.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"

namespace voxtet::remesh {

struct AdaptParams {
  AdaptSchedule schedule = AdaptSchedule::kAdaptive;
  double voxel_mm = 1;           ///< smallest spacing of the labels' voxels
  double envelope_voxels = 0.5;  ///< how far the result may be from the reference, and the reference from the
                                 ///< result
  double min_angle_deg = 18;     ///< planar angles below this are not made
  double min_dihedral_deg = 25;  ///< the same for dihedral angles at junctions of labels; inside a surface
                                 ///< the larger of this and 60 holds
  double shape_weight = 0.7;     ///< relocation: 0 sizes alone, 1 shapes alone
  bool verify = false;  ///< after every operation, look from scratch for intersections around it (slow)
};

/// What was done, for the report and the tests.
struct AdaptRecord {
  std::array<std::uint64_t, 4> accepted{};  ///< splits, collapses, flips, relocations
  std::uint64_t violations = 0;             ///< found by `verify`; expected 0
};

/// Adapts `reference` (closed and manifold for every label, free of self-intersections) to `sizing`; the
/// median edge has the target length. The result has the same topology, label by label, and is free of
/// self-intersections: every operation keeps both. Where the reference itself breaks a limit, nothing near
/// becomes worse, and the last passes try to repair it; where nothing may be done the input remains.
/// Distances to the reference, both ways, stay below the envelope at samples (its vertices; points less than
/// a voxel apart on the result). The volume of each label is balanced to that of the reference. Sheets that
/// face each other stay apart by a quarter of the target edge length, or by their original distance. Target
/// lengths are met where topology and envelope allow.
///
/// Zilske, Lamecker and Zachow, "Adaptive remeshing of non-manifold surfaces", Eurographics 2008; link
/// conditions by Dey et al. 1999; areas by Surazhsky and Gotsman 2003. About 11 microseconds per triangle of
/// the input. Deterministic. Errors: kCancelled, kOutOfMemory.
Result<SurfaceMesh> adapt_complex(const SurfaceMesh& reference, const SizingField& sizing,
                                  const AdaptParams& params, RunContext& ctx, AdaptRecord* record = nullptr);

}  // namespace voxtet::remesh
