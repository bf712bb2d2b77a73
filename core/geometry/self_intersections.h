// Exact search for triangles of a complex that meet elsewhere than in shared corners and edges.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "types/surface_mesh.h"

namespace voxtet {

/// Pairs of triangles (lower index first, ascending) whose intersection is more than their common corners or
/// common edge, decided with exact predicates; duplicates of a triangle count. Needs valid indices and
/// triangles with an area. Stops adding after `max_pairs`; which pairs are then given is unspecified. Boxes
/// are swept as in Zomorodian and Edelsbrunner, "Fast software for box intersections", 2000 (CGAL).
std::vector<std::array<std::uint32_t, 2>> find_self_intersections(const SurfaceMesh& surface,
                                                                  std::size_t max_pairs = 100000);

}  // namespace voxtet
