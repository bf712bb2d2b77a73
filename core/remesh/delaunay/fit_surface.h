// Small shifts of an adapted surface's points that remove the error of its chords.
#pragma once

#include <vector>

#include "remesh/field/label_field.h"
#include "types/run_context.h"
#include "types/surface_mesh.h"

namespace voxtet::remesh {

/// Flat facets between points on a curved interface all lie on its hollow side: bodies lose volume. Each
/// point moves so that the mean signed distance of the facets around it vanishes. This is the regularised
/// least-squares problem: sum over facets of area (normal . shift - distance)^2, in a few steps of at most
/// kMostShiftVoxels of the smallest spacing, each half as far as the one before. No triangle becomes thinner
/// than 29 degrees that was not, no angle between two of them sharper than 50 degrees; thinner triangles are
/// widened as far as their neighbours allow. Facets whose distance the field does not know count as 0. The
/// surface moves no farther than kFarthestVoxels away from any point of `reference`, the surface of the
/// labels, unless it was farther. Around layers, whose facets are coarser, both lengths are kLayerFreedom
/// times as long. Intersections are not checked. False when cancelled.
bool fit_surface(SurfaceMesh& surface, const LabelField& field, const SurfaceMesh& reference,
                 const std::vector<double>& volumes_mm3, const RunContext& ctx = {});

inline constexpr double kMostShiftVoxels = 0.15;
inline constexpr double kFarthestVoxels = 0.45;
inline constexpr double kLayerFreedom = 2;
/// Cosine of the angle below which a triangle may not become thinner: nearly all triangles have this angle
/// after refinement.
inline constexpr double kThinnestCosine = 0.8724960070727971;  // 29.25 degrees

}  // namespace voxtet::remesh
