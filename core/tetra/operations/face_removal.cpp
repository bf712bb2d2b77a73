#include "tetra/operations/face_removal.h"

#include <algorithm>
#include <array>
#include <limits>

namespace voxtet::tetra {
namespace {

/// Faces of one removal, at most.
constexpr std::size_t kMostFaces = 8;

/// What a set of faces gives: the lowest quality of their tets, and of those that take their place.
struct Exchange {
  double before, after;
};

/// Grows the set of faces from one of them over its edges, keeping what pays.
class FaceSet {
 public:
  FaceSet(const TetComplex& complex, std::uint32_t a, std::uint32_t b) : complex_(complex), a_(a), b_(b) {}

  /// The face between tets `above` (at a) and `below` (at b), with corners (u, v, w) such that (u, v, w, b)
  /// is positive.
  Exchange start(std::uint32_t above, std::uint32_t below, const Triangle& face) {
    gone_[gone_count_++] = above;
    gone_[gone_count_++] = below;
    Exchange sum{std::min(complex_.quality_of(above), complex_.quality_of(below)),
                 std::numeric_limits<double>::infinity()};
    for (std::size_t e = 0; e < 3 && sum.after > 0; ++e) {
      const Exchange part = grow(above, below, face[e], face[(e + 1) % 3], face[(e + 2) % 3]);
      sum = {std::min(sum.before, part.before), std::min(sum.after, part.after)};
    }
    return sum;
  }

  std::span<const std::uint32_t> gone() const { return {gone_.data(), gone_count_}; }
  std::span<const Tet> made() const { return {made_.data(), made_count_}; }

 private:
  /// What lies beyond the edge (u, w) of a face of the set, whose third corner is x: the tet of the new edge
  /// and (u, w), or what the next face gives instead.
  Exchange grow(std::uint32_t above, std::uint32_t below, std::uint32_t u, std::uint32_t w, std::uint32_t x) {
    const Tet closing{a_, b_, u, w};
    const Exchange closed{std::numeric_limits<double>::infinity(), complex_.quality_at(closing)};
    const std::size_t gone_before = gone_count_, made_before = made_count_;
    const std::uint32_t next_above = complex_.behind(above, complex_.corner_at(above, x));
    const std::uint32_t next_below = complex_.behind(below, complex_.corner_at(below, x));
    const auto gone_end = gone_.begin() + static_cast<std::ptrdiff_t>(gone_count_);
    if (gone_count_ < 2 * kMostFaces && next_above != kNone && next_below != kNone &&
        std::find(gone_.begin(), gone_end, next_above) == gone_end) {
      const std::uint32_t y = far_corner(above, x), z = far_corner(below, x);
      if (y == z) {
        gone_[gone_count_++] = next_above;
        gone_[gone_count_++] = next_below;
        // Seen from b, the next face is (u, y, w).
        const Exchange first = grow(next_above, next_below, u, y, w);
        const Exchange second = first.after > 0 ? grow(next_above, next_below, y, w, u) : first;
        const Exchange open{std::min({first.before, second.before, complex_.quality_of(next_above),
                                      complex_.quality_of(next_below)}),
                            std::min(first.after, second.after)};
        if (open.after > open.before || open.after > closed.after) return open;
        gone_count_ = gone_before;
        made_count_ = made_before;
      }
    }
    made_[made_count_++] = closing;
    return closed;
  }

  /// The corner of the tet behind the side opposite to x that is not on that side.
  std::uint32_t far_corner(std::uint32_t t, std::uint32_t x) const {
    const Facet facet = complex_.across(t, complex_.corner_at(t, x));
    return complex_.corners(tet_of(facet))[corner_of(facet)];
  }

  const TetComplex& complex_;
  std::uint32_t a_, b_;
  std::array<std::uint32_t, 2 * kMostFaces> gone_;
  std::array<Tet, kMostFaces + 2> made_;
  std::size_t gone_count_ = 0, made_count_ = 0;
};

}  // namespace

bool remove_faces(TetComplex& complex, std::uint32_t t, std::uint32_t corner, const SizeGuard& guard) {
  const std::uint32_t below = complex.behind(t, corner);
  if (below == kNone) return false;
  const std::uint32_t a = complex.corners(t)[corner];
  const std::uint32_t b = complex.corners(below)[corner_of(complex.across(t, corner))];
  const auto& side = kFacetCorners[corner];
  const Tet& c = complex.corners(t);
  FaceSet set(complex, a, b);
  const Exchange exchange = set.start(t, below, {c[side[0]], c[side[1]], c[side[2]]});
  return exchange.after > exchange.before && guard.allows(complex.point(a), complex.point(b)) &&
         complex.replace(set.gone(), set.made());
}

}  // namespace voxtet::tetra
