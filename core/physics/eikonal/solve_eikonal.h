// Activation times of a wave of excitation that runs through tissue, by the eikonal equation.
// Fu, Kirby and Whitaker, "A fast iterative method for solving the eikonal equation on tetrahedral domains",
// SIAM Journal on Scientific Computing 35 (2013).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "types/result.h"
#include "types/run_context.h"
#include "types/tet_mesh.h"
#include "types/tissue.h"

namespace voxtet {

/// A point of the mesh from which a wave starts.
struct EikonalSource {
  std::uint32_t point = 0;
  double time_ms = 0;  ///< of any sign; has no effect where a wave from another source has come before
};

/// Solves sqrt(grad T . C grad T) = 1 on the tetrahedra that conduct, with
///
///     C = share (along^2 f f^T + across^2 (I - f f^T)),   f: the fibre,
///
/// or share along^2 I without fibres. T, in ms at every point, is when the first wave comes from any of the
/// sources; NaN where none does: where nothing conducts, or what does is not connected to a source.
///
/// T is linear on every tetrahedron, and first order in the edge length h; from a single point, or around
/// an edge, where the front is sharply curved, of order h log(1/h). Most errors are delays. No tetrahedron
/// would make any value earlier by more than 1e-9 ms. One thread, one order of work.
///
/// Returns kUsage, naming the field (physics.eikonal.sources, physics.tissue), for no source, a source at no
/// point of conducting tissue or without a finite time, for tissue that conducts nowhere, for speeds of any
/// kind that are not finite and positive, and for shares and fibres out of their range where they matter;
/// kInternal for lists that have not one entry for each tetrahedron and for kinds that are none; kCancelled.
Result<std::vector<double>> solve_eikonal(const TetMesh& mesh, const Tissue& tissue,
                                          std::span<const EikonalSource> sources, RunContext& ctx);

}  // namespace voxtet
