// Moves a vertex to where the worst of its tets is best.
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

/// The lowest quality of the star, or some value of at most `bound` once it is known not to exceed that. The
/// side that shows this is moved to the front, since it likely will again.
double lowest_quality(const Point& apex, std::span<StarSide> sides, double bound);

struct Apex {
  Point at;
  double quality = 0;  ///< the lowest of the star's tets
};

/// A surface that an apex stays on.
class Track {
 public:
  virtual ~Track() = default;
  /// The place on the surface for a point near it; the start itself if that point is too far away.
  virtual Point pull(const Point& to) const = 0;
};

/// Climbs from `start` by at most `steps` steps, freely or on a track. Each step raises the lowest quality of
/// the star. No step is taken if a tet of the star is not positive. Reorders `sides`.
Apex ascend(const Point& start, std::span<StarSide> sides, int steps, const Track* track = nullptr);

/// The point nearest to the origin in the convex hull of one to four points.
Point nearest_in_hull(std::span<const Point> points);

/// Moves vertices of a complex. Keeps its work memory between calls.
class VertexSmoother {
 public:
  VertexSmoother(TetComplex& complex, const SizeGuard& guard) : complex_(complex), guard_(guard) {}

  /// Moves a vertex that is on no interface, or along a track, unless the lowest quality of its tets is at
  /// least `enough`. The move is kept, and the result true, if the lowest quality rose and no edge of the
  /// vertex is farther from its target than the farthest one was, or than `most_misfit`; else nothing
  /// happens.
  bool smooth(std::uint32_t vertex, double enough, int steps, const Track* track = nullptr,
              double most_misfit = 1);

 private:
  bool sizes_allow(std::uint32_t vertex, const Point& to, double most_misfit);

  TetComplex& complex_;
  const SizeGuard& guard_;
  IdSet seen_;
  std::vector<std::uint32_t> star_, others_;
  std::vector<StarSide> sides_;
};

}  // namespace voxtet::tetra
