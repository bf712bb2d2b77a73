// A cavity of the heart, from the surface around it.
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

}  // namespace voxtet
