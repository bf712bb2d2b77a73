// Small shifts of an adapted surface's points that take out the error of its chords.
#pragma once

#include <vector>

#include "remesh/field/label_field.h"
#include "types/surface_mesh.h"

namespace voxtet::remesh {

/// Points on a curved interface with flat facets between them leave the facets on the hollow side: bodies
/// lose volume. Each point moves so that the mean signed distance of the facets around it vanishes: the
/// regularised least squares of sum over facets area (normal . shift - distance)^2, in a few steps of at most
/// kMostShiftVoxels of the smallest spacing, each half as far as the one before. No triangle
/// becomes thinner than 29 degrees that was not, no angle between two of them sharper than 50 degrees; those
/// that are thinner are widened as far as their neighbours allow. Points near which the field does not know
/// the distance of a facet count it as 0. From no point of `reference`, the surface of the labels, does the
/// surface go farther away than kFarthestVoxels, where it was nearer. Intersections are not looked for.
void fit_surface(SurfaceMesh& surface, const LabelField& field, const SurfaceMesh& reference,
                 const std::vector<double>& volumes_mm3);

inline constexpr double kMostShiftVoxels = 0.15;
inline constexpr double kFarthestVoxels = 0.45;
/// Of the angle below which a triangle is not to become thinner: that to which refinement brings all, or
/// nearly.
inline constexpr double kThinnestCosine = 0.8724960070727971;  // 29.25 degrees

}  // namespace voxtet::remesh
