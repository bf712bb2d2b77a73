// Which side of the wall each face of its surface is on, in the words of walls/wall_grid.h: kOuter is the
// epicardium, kSide the base, kInner the left cavity and kInner + 1 the right one.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "anatomy/wall_surface.h"
#include "walls/wall_grid.h"

namespace voxtet::anatomy {

using Points = std::vector<Eigen::Vector3d>;
/// A wall::Kind for each face of a WallSurface; kWall: a shell of its own, at none of the named surfaces.
using FaceKinds = std::vector<std::uint8_t>;

/// Names every face by the voxels across it (look_across.h): kOuter or an inner space. Then the largest part
/// of each stays, and all other parts take the name around them.
FaceKinds look_at_sides(const Points& points, const WallSurface& surface, const wall::WallGrid& grid,
                        int threads);

/// Turns those outer faces into kSide that are the rim between outer and inner surface. Seen from the rim,
/// the nearest of the inner surfaces is its border, and lies beside the face, not behind it: a face may be of
/// the rim if the nearest inner face is within an edge of the border, and the way there makes more than 45
/// degrees with the face's normal. Of these the rim grows from the openings on, up to creases of 40
/// degrees. This asks for no plane, so that valves may have any direction. Openings with a border shorter
/// than a fifth of the longest are holes in the wall, and have no rim. What reaches no inner surface is none.
/// Rims do not meet in points.
void find_base(const Points& points, const WallSurface& surface, int threads, FaceKinds& kinds);

/// Cavities that were found (walls/find_cavities.h) end at planes across a direction that was searched for,
/// not quite at the base: makes them end at the mean plane of the base faces. False, and nothing changed,
/// where they would run out below that plane, as where the base is no plane, and where there is no base.
bool end_at_base(const WallSurface& surface, const FaceKinds& kinds, wall::WallGrid& grid);

/// Mean thickness (mm) of the free wall of each of the inner spaces 0 to `count` - 1: over its faces that
/// are nearer to the epicardium than to another inner space, the distance to the epicardium.
std::vector<double> free_wall_mm(const Points& points, const WallSurface& surface, const FaceKinds& kinds,
                                 std::size_t count, int threads);

/// For each face of the right cavity (kInner + 1) whether it is of the septum: the potential in the wall that
/// is 0 at the left cavity and 1 outside, and that neither the right cavity nor the base lets through, is
/// below 1/2 there. The larger part of septum and of free wall stays, islands take the other's name. False
/// for all other faces. `grid` is that of look_at_sides().
std::vector<bool> find_septum(const Points& points, const WallSurface& surface, const FaceKinds& kinds,
                              wall::WallGrid grid, int threads);

/// The point of the epicardium that is farthest from the base. The base faces where the inner surfaces are
/// open: along the sum of their area vectors. So that a rough surface does not lead away from the tip, the
/// cap is taken around the deepest face that lies in the lowest twentieth of the epicardium, and of its
/// points the one nearest to the line through its centroid, straight to the base. At least one face is
/// kOuter.
std::uint32_t find_apex(const Points& points, const WallSurface& surface, const FaceKinds& kinds);

}  // namespace voxtet::anatomy
