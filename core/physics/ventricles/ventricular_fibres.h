// Muscle fibres and sheets of the ventricles by rule.
#pragma once

#include <array>
#include <span>

#include "physics/ventricles/fibre_params.h"
#include "physics/ventricles/ventricular_potentials.h"
#include "types/heart_surfaces.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/tet_mesh.h"
#include "types/tissue.h"

namespace voxtet {

/// A place in a tetrahedron: how much of each corner it is.
using CornerShares = std::array<double, 4>;
inline constexpr std::array<CornerShares, 1> kCentroid{{{0.25, 0.25, 0.25, 0.25}}};

/// Fibres and sheets at places in the tetrahedra, those of one next to each other, zero outside of the wall.
/// On orthonormal frames: e_t across the wall, outwards; e_l along it, from apex to base; e_c = e_l x e_t,
/// counterclockwise seen from the base. With the angles of FibreParams
///
///     fibre = cos(alpha) e_c + sin(alpha) e_l
///     sheet = sin(beta) (cos(alpha) e_l - sin(alpha) e_c) + cos(beta) e_t
///
/// Rule linear: each tetrahedron is of one wall, the right ventricle's free wall or the left ventricle's, to
/// which the septum belongs. Angles are linear in WallDepth. e_t is against the gradient of the own
/// ventricle's potential; e_l is what the gradient of `base` has at right angles to e_t.
/// Rule bayer: Bayer et al., Annals of Biomedical Engineering 40 (2012), supplement; e_l comes first, and e_t
/// is what the potential's gradient has at right angles to it. A frame of the endocardia, blended from the
/// left to the right one by d = rv / (lv + rv), is blended with a frame of the epicardium by `epi`, by
/// bislerp.
/// Septum: its own angles count by the share far / (far + epi) of the potentials of the other ventricle's
/// endocardium and of the epicardium: 1 on its other side, 0 on the epicardium, smooth between them; in rule
/// linear in the left ventricle's wall only.
///
/// Gradients are means over the tetrahedra around each point, by volume, and then over a tetrahedron's
/// points. Where one vanishes, the direction is a coordinate axis, so that there is always a frame. |fibre| =
/// 1 and fibre . sheet = 0 to 1e-12. `potentials` are those of this mesh and its surfaces. Returns errors of
/// check_fibre_params(), and kCancelled.
Result<Fibres> tet_fibres(const TetMesh& mesh, const HeartSurfaces& surfaces,
                          const VentricularPotentials& potentials, const FibreParams& params,
                          const RunContext& ctx, std::span<const CornerShares> places = kCentroid);

/// Fibres and sheets at the points of the mesh, zero outside of the wall: of the mean of f f^T over the
/// tetrahedra around a point, by volume, the direction of the largest eigenvalue; the same for sheets, at
/// right angles to it. Signs do not matter to f f^T as they would to a mean of vectors.
Fibres point_fibres(const TetMesh& mesh, const Fibres& of_tets);

}  // namespace voxtet
