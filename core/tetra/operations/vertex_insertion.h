// A new vertex in a cavity that is dug around a bad tet.
// B. M. Klingner and J. R. Shewchuk, "Aggressive tetrahedral mesh improvement", 16th International Meshing
// Roundtable (2007).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tetra/mesh/tet_complex.h"
#include "tetra/operations/size_guard.h"
#include "tetra/operations/vertex_smoothing.h"

namespace voxtet::tetra {

/// Inserts vertices into a complex. Keeps its work memory between calls.
class VertexInserter {
 public:
  /// Vertices that the complex has at this time do not count as inserted.
  VertexInserter(TetComplex& complex, const SizeGuard& guard)
      : complex_(complex), guard_(guard), first_inserted_(complex.point_count()) {}

  /// Replaces tet t, and as many tets around it as needed, by a star around a new vertex, if that raises the
  /// lowest quality and the sizes of the new edges are allowed. complex.made() are then the new tets.
  bool insert(std::uint32_t t);

  /// Where a new vertex for tet t may start: a place, and the tet from which the cavity grows. First come
  /// kInside places inside of t and at the middles of its edges, then places inside of the tets behind its
  /// sides.
  struct Start {
    Point at;
    std::uint32_t tet;
  };
  static constexpr std::size_t kInside = 7;
  std::vector<Start> starts_at(std::uint32_t t) const;
  /// The same from one start; with `gain` 0 it may lower the lowest quality.
  bool insert_from(const Start& start, bool interfaces_count, double gain);

  /// Puts a vertex on an edge. `around_edge` are its tets, all of one label; as many tets around them as
  /// needed are replaced, too. Done only if the new tets have at least `least_quality`, the sizes of the new
  /// edges are allowed, and allowed(v) holds for all neighbours v of the new vertex. complex.made() are then
  /// the new tets.
  template <class Allowed>
  bool split(std::span<const std::uint32_t> around_edge, const Point& middle, double least_quality,
             const Allowed& allowed);

 private:
  /// A side of the cavity, seen from inside.
  struct Side {
    std::uint32_t tet, corner;
    double quality;  ///< of the tet that it forms with the new vertex
  };
  Apex settle(const Point& at, bool interfaces_count);
  void dig(const Point& at, bool interfaces_count);
  void absorb(std::uint32_t t, const Point& at);
  double lowest_before() const;
  bool sizes_allow(const Point& at) const;
  Apex smooth(const Point& at);
  bool commit(const Point& at);

  TetComplex& complex_;
  const SizeGuard& guard_;
  const std::uint32_t first_inserted_;
  std::vector<std::uint32_t> cavity_;
  std::vector<Side> sides_;
  std::vector<StarSide> star_;
  std::vector<Tet> made_;
};

template <class Allowed>
bool VertexInserter::split(std::span<const std::uint32_t> around_edge, const Point& middle,
                           double least_quality, const Allowed& allowed) {
  cavity_.assign(around_edge.begin(), around_edge.end());
  const Apex apex = settle(middle, true);
  if (!(apex.quality >= least_quality) || !sizes_allow(apex.at)) return false;
  for (const Side& s : sides_)
    for (const std::uint32_t k : kFacetCorners[s.corner])
      if (!allowed(complex_.corners(s.tet)[k])) return false;
  return commit(apex.at);
}

}  // namespace voxtet::tetra
