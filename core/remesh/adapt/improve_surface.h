// Local operations on an already adapted surface, where sizes, shapes or distances are poor.
#pragma once

#include "remesh/adapt/adapt_complex.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"

namespace voxtet::remesh {

/// Improves `surface` (conforming, closed for every label, free of self-intersections) where refinement left
/// it finer than `sizing` asks, folded, or farther from `reference` than the envelope: edges are collapsed,
/// tubes with three edges around get fewer rings, vertices of junction curves and near changes are relocated,
/// facets are brought nearer. Each operation is one of adapt_complex's transactions, so topology is kept and
/// nothing intersects. An operation that leaves planar angles below params.min_angle_deg is followed by
/// others that open them, or taken back. Where the surface already breaks a limit it does not become worse.
/// params.schedule is not used.
///
/// Deterministic. Errors: kCancelled, kOutOfMemory.
Result<SurfaceMesh> improve_surface(const SurfaceMesh& surface, const SurfaceMesh& reference,
                                    const SizingField& sizing, const AdaptParams& params, RunContext& ctx,
                                    AdaptRecord* record = nullptr);

}  // namespace voxtet::remesh
