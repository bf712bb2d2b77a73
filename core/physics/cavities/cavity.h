// The volume of a cavity of the heart from the surface around it, and how it changes as the surface moves.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "types/heart_surfaces.h"
#include "types/result.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// An endocardial surface, closed at each of its rims by a fan of triangles to the mean of the rim's points.
/// All triangles are oriented alike: normals point out of the cavity, into the wall.
struct Cavity {
  std::vector<Triangle> triangles;
  /// Each a closed ring of points, in the direction in which the fans' triangles have their edges.
  std::vector<std::vector<std::uint32_t>> rims;
};

enum class Ventricle { kLeft, kRight };

/// Closes a surface that is given by its triangles, whichever way each of them is oriented. `name` stands in
/// errors, as "lv_endocardium". Returns kMeshing, with the points concerned, for no triangles, for triangles
/// that do not hang together by edges, for edges of more than two triangles, for a surface that has one side
/// only, for a surface without a rim, for rims that meet in a point, and for a surface that encloses nothing.
Result<Cavity> close_cavity(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles,
                            std::string_view name);

/// That of a ventricle: around the right one are its endocardium and the septum. Errors as above, and
/// kInternal for names that are not those of the mesh's faces.
Result<Cavity> ventricle_cavity(const TetMesh& mesh, const HeartSurfaces& surfaces, Ventricle ventricle);

/// mm^3 (1 ml is 1000 of them): the sum of x_a . (x_b x x_c) / 6 over all triangles and fans. Points are in
/// mm, those of the cavity's mesh, which may have moved.
double volume_mm3(const Cavity& cavity, std::span<const Eigen::Vector3d> points);

/// Its derivatives with respect to the points, mm^2, added to `gradient` times `factor`; an entry for each
/// point. Times a pressure they are the forces on the points, in the direction in which they widen the
/// cavity.
void add_volume_gradient(const Cavity& cavity, std::span<const Eigen::Vector3d> points, double factor,
                         std::span<Eigen::Vector3d> gradient);

/// How that gradient changes as points move by `moves`, mm: the second derivatives, which are symmetric,
/// times the moves. Added to `change` times `factor`.
void add_volume_gradient_change(const Cavity& cavity, std::span<const Eigen::Vector3d> points,
                                std::span<const Eigen::Vector3d> moves, double factor,
                                std::span<Eigen::Vector3d> change);

}  // namespace voxtet
