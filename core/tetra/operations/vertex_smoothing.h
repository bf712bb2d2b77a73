// A vertex goes where the worst of its tets is best.
// L. A. Freitag and C. Ollivier-Gooch, "Tetrahedral mesh improvement using swapping and smoothing", Int. J.
// Numer. Meth. Engng 40 (1997): steepest ascent of a minimum of smooth functions.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tetra/mesh/tet_complex.h"
#include "tetra/operations/size_guard.h"

namespace voxtet::tetra {

/// A side of a star: (apex, side[0], side[1], side[2]) is one of its tets.
using StarSide = std::array<Point, 3>;

/// The side of a tet opposite to one of its vertices.
StarSide side_opposite(const TetComplex& complex, std::uint32_t tet, std::uint32_t vertex);

/// The lowest quality of the star, or anything at most `bound` once it is known not to exceed it; the side
/// that shows so comes first, since it will again.
double lowest_quality(const Point& apex, std::span<StarSide> sides, double bound);

struct Apex {
  Point at;
  double quality = 0;  ///< the lowest of the star's tets
};

/// A surface that an apex stays on.
class Track {
 public:
  virtual ~Track() = default;
  /// The place on the surface for a point near it; the start itself where that is too far from it.
  virtual Point pull(const Point& to) const = 0;
};

/// Climbs from `start` by at most so many steps, anywhere or on a track. Each raises the lowest quality of
/// the star; there is none from a star with a tet that is not positive. Reorders `sides`.
Apex ascend(const Point& start, std::span<StarSide> sides, int steps, const Track* track = nullptr);

/// The point nearest to the origin in the convex hull of one to four.
Point nearest_in_hull(std::span<const Point> points);

/// Moves vertices of a complex. Holds what would else be allocated for each.
class VertexSmoother {
 public:
  VertexSmoother(TetComplex& complex, const SizeGuard& guard) : complex_(complex), guard_(guard) {}

  /// Moves a vertex that is on no interface, or along a track, unless the lowest quality of its tets is
  /// enough. True when that rose and no edge of the vertex has become farther from its target than the
  /// farthest was, or than `most_misfit`; else nothing happens.
  bool smooth(std::uint32_t vertex, double enough, int steps, const Track* track = nullptr,
              double most_misfit = 1);

 private:
  bool sizes_allow(std::uint32_t vertex, const Point& to, double most_misfit);

  TetComplex& complex_;
  const SizeGuard& guard_;
  std::vector<std::uint32_t> star_, others_;
  std::vector<StarSide> sides_;
};

}  // namespace voxtet::tetra
