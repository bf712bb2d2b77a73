// A wave through one tetrahedron: the local solver of the eikonal equation.
#pragma once

#include <array>
#include <cstddef>

namespace voxtet::eikonal {

/// A tetrahedron as a wave sees it: the squared travel time e . C^-1 e along each edge e, in ms^2. In the
/// order of corners 01, 02, 03, 12, 13, 23.
using SquaredEdgeTimes = std::array<double, 6>;

/// Earliest arrival at a corner x of a tetrahedron from its opposite face, in ms: the least t(y) + |x - y|
/// for y on the face, where t is linear between the arrivals at the face's corners, and |d| is the travel
/// time sqrt(d . C^-1 d). A corner that no wave has reached yet has an infinite time. `times` are those of
/// the four corners, of which that of x is not read.
double local_arrival(const SquaredEdgeTimes& edges, std::size_t x, const std::array<double, 4>& times);

}  // namespace voxtet::eikonal
