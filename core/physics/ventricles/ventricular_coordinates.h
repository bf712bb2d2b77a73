// Where a point is in the ventricles, in coordinates that can be compared between hearts.
// Near to Bayer et al., "Universal ventricular coordinates", Medical Image Analysis 45 (2018), and Schuler et
// al., "Cobiveco", Medical Image Analysis 74 (2021); what differs is said below.
#pragma once

#include <vector>

#include "physics/ventricles/ventricular_potentials.h"
#include "types/field.h"
#include "types/heart_surfaces.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// Four fields on points, NaN outside of the wall:
/// - `transmural`, without unit: WallDepth in the wall of the point's ventricle, 0 on its endocardium and 1
/// on
///   the epicardium; in the septum 0 on the left side and 1 on the right one, as in Bayer et al. At the line
///   where the free wall of the right ventricle leaves the septum it jumps.
/// - `apicobasal`, without unit: a / (a + b), with the lengths a from the apex and b to the base along the
///   gradient of the potential `base`: 0 at the apex (a point of the epicardium), 1 on the base. Lengths are
///   the functions whose gradients agree best, in the mean of squares, with the potential's gradient divided
///   by its norm (Crane, Weischedel and Wardetzky, "Geodesics in heat", ACM Transactions on Graphics 32,
///   2013).
/// - `rotational`, radians, more than -pi to pi: the angle about the long axis of the left ventricle, a
/// straight
///   line from the apex through the centroid of the left endocardium; for both ventricles. Counterclockwise
///   seen from the base; 0 at the centroid of the right side of the septum, in a single ventricle towards the
///   patient's right (+x), or towards +y where the axis is within some 8 degrees of x.
/// - `ventricle`: 0 left with the septum, 1 the free wall of the right one (`free_wall` above 1/2). Cobiveco
///   parts the septum in its middle instead.
/// `potentials` are those of this mesh and its surfaces. Returns errors of wall_system() and solve_on_wall().
Result<std::vector<Field>> ventricular_coordinates(const TetMesh& mesh, const HeartSurfaces& surfaces,
                                                   const VentricularPotentials& potentials,
                                                   const RunContext& ctx);

}  // namespace voxtet
