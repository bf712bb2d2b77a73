// Work on a mesh by many threads with the result of one: cubes of space in eight colours.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"

namespace voxtet {

/// What work that belongs to one cube may reach: the cube and half a side around it.
struct CubeZone {
  Eigen::Vector3d low, high;
  bool holds(const Eigen::Vector3d& p) const {
    return low[0] <= p[0] && p[0] < high[0] && low[1] <= p[1] && p[1] < high[1] && low[2] <= p[2] &&
           p[2] < high[2];
  }
  /// In the cube itself.
  bool holds_inside(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d margin = (high - low) / 4;
    return CubeZone{low + margin, high - margin}.holds(p);
  }
};

/// Items in the cubes that their points lie in. Two cubes have the same colour if an even number of sides
/// leads from one to the other along each axis, so the zones of cubes of one colour never meet. All depends
/// on the points and the side alone.
class ColourLattice {
 public:
  static constexpr std::size_t kColours = 8;
  /// The items of one cube, in their order.
  struct Cube {
    CubeZone zone;
    std::span<const std::uint32_t> items;
  };

  /// Item i is at points[i]; points are finite. Cubes have the side `side_mm` > 0, or a larger one where they
  /// would be too many. What one item's work reaches should mostly be less than half a side away: for
  /// operations on a mesh, a side is some six edges. Where edges are graded, it follows the longer ones.
  ColourLattice(std::span<const Eigen::Vector3d> points, double side_mm);

  /// Cubes that have items, colour by colour.
  std::size_t size() const { return cubes_.size(); }
  std::span<const Cube> cubes_of(std::size_t colour) const {
    return std::span(cubes_).subspan(first_[colour], first_[colour + 1] - first_[colour]);
  }

 private:
  std::vector<std::uint32_t> items_;
  std::vector<Cube> cubes_;
  std::array<std::size_t, kColours + 1> first_{};
};

/// Calls visit(cube, number, own) for the cubes of one colour after those of the other, for those of a colour
/// on several threads at once; `number` counts cubes from 0 to size() - 1, `own` is what make_own() returned
/// on the thread, for this colour. Before the cubes of a colour before(first, last) is called with the range
/// of their numbers, and after(first, last) when they are done, on the caller's thread. The result is the
/// same for any number of threads if a visit
/// - writes points and elements only if all their corners are in its zone (the link between two elements: the
///   corners that they share),
/// - reads those alone that have at least one corner there,
/// - and else writes what belongs to its number, or to nobody.
/// It finds out before it changes anything; what reaches farther is put off, to be done one after the other
/// at the end. Points that move must stay where their zone is.
template <class Before, class MakeOwn, class Visit, class After>
void for_colours(int threads, const ColourLattice& lattice, const Before& before, const MakeOwn& make_own,
                 const Visit& visit, const After& after) {
  std::size_t first = 0;
  for (std::size_t colour = 0; colour < ColourLattice::kColours; ++colour) {
    const std::span<const ColourLattice::Cube> cubes = lattice.cubes_of(colour);
    if (cubes.empty()) continue;
    before(cubes, first);
    run_tasks_with(threads, cubes.size(), make_own,
                   [&](std::size_t i, auto& own) { visit(cubes[i], first + i, own); });
    after(cubes, first);
    first += cubes.size();
  }
}

}  // namespace voxtet
