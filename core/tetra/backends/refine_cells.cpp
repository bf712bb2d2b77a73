#include "tetra/backends/refine_cells.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/level_stacks.h"
#include "geometry/search/colour_lattice.h"
#include "types/stage_names.h"

namespace voxtet::tetra {
namespace {

using Eigen::Vector3d;

/// Circumradius allowed per target edge length. Measured on hearts and aorta (tests/sweep/sweep_sizes): the
/// median of inner edges is within 2 % of the target. The optimised angles are the same for 3 % more or less.
constexpr double kRadiusPerEdge = 0.75;
/// Levels of the squared circumradius over what is allowed. With more levels sizes are more even, with fewer
/// it is quicker: 0.45 s for 210,000 tets with these, 0.85 s with the worst first; the 95 % quantile of
/// |log2 l/h| is 0.005 larger.
constexpr std::array<double, 3> kLevels{1, 1.25, 2};
/// A point is too close to a triangle of the surface in a ball around its circumcentre with this part of its
/// radius. Measured on hearts and aorta: between 0.65 and 0.9 the optimised angles are the same; farther out
/// they fall, farther in there are more tets, and flatter ones, for the optimiser.
constexpr double kProtected = 0.8;
constexpr std::size_t kTriesPerQuestion = 512;
/// Sides of the cubes that threads share out, in a target edge length that this part of bad cells do not
/// exceed: 99 % of cavities reach less than half a side from their point.
constexpr double kEdgesPerCube = 8, kLongShare = 0.9;
/// Slots for new cells that a cube has for each of its bad cells and besides, and cells that a point adds, at
/// most. What is left to do once they are used up waits for the next pass.
constexpr std::size_t kSlotsPerCell = 4, kSlotsPerCube = 256, kCellsPerPoint = 6;

/// Circumcentre and squared circumradius of a triangle.
std::pair<Vector3d, double> circumcircle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d u = b - a, v = c - a, n = u.cross(v);
  const Vector3d offset =
      (u.squaredNorm() * v.cross(n) + v.squaredNorm() * n.cross(u)) / (2 * n.squaredNorm());
  return {a + offset, offset.squaredNorm()};
}

/// A cell to be refined, as it was when it was examined.
struct BadCell {
  DelaunayTriangulation::CellId id;
  double size;     ///< squared circumradius over what is allowed
  double edge_mm;  ///< target
  Vector3d centre;
};
using BadCells = LevelStacks<BadCell, kLevels.size()>;

/// What a cube has for its work, and what comes of it.
struct Share {
  DelaunayTriangulation::Stock stock;
  std::vector<std::uint32_t> points;  ///< numbers for new ones; the last ones go first
  std::vector<BadCell> later;         ///< for the next pass
  std::vector<BadCell> far;           ///< whose cavities leave the zone
};

class CellRefiner {
 public:
  CellRefiner(DelaunayCells& cells, const SizingField& sizing, double radius_edge, const WallLayers& layers,
              const RunContext& ctx)
      : triangulation_(cells.triangulation()),
        sizing_(sizing),
        radius_edge_(radius_edge),
        layers_(layers),
        ctx_(ctx) {}

  Refined run(std::size_t max_points) {
    std::vector<BadCell> waiting;
    for (std::uint32_t cell = 0; cell < triangulation_.slots(); ++cell)
      if (triangulation_.is_finite(cell) && !layers_.is_layer(triangulation_.label(cell)))
        examine(cell, waiting);
    first_points_ = triangulation_.point_count();
    while (!waiting.empty()) {
      waiting = run_pass(waiting);
      if (cancelled_) return Refined::kCancelled;
      if (points() > max_points) return Refined::kTooMany;
    }
    return Refined::kDone;
  }

 private:
  using Cavity = DelaunayTriangulation::Cavity;

  std::size_t points() const { return triangulation_.point_count() - spare_points_.size(); }

  void tell_progress() const {
    const auto now = static_cast<double>(points()), first = static_cast<double>(first_points_);
    ctx_.progress(kTetraStage, (now - first) / (now + first));
  }

  /// Adds the cell to `bad` if it is.
  void examine(std::uint32_t cell, std::vector<BadCell>& bad) const {
    if (triangulation_.label(cell) == kBackground) return;
    const DelaunayTriangulation::Ball& ball = triangulation_.ball(cell);
    if (!ball.centre.allFinite()) return;
    const auto& c = triangulation_.corners(cell);
    const double edge = sizing_.at(ball.centre), allowed = kRadiusPerEdge * edge;
    double shortest2 = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j)
        shortest2 =
            std::min(shortest2, (triangulation_.point(c[i]) - triangulation_.point(c[j])).squaredNorm());
    const double size = ball.radius2 / (allowed * allowed);
    if (size > kLevels[0] || ball.radius2 > radius_edge_ * radius_edge_ * shortest2)
      bad.push_back({triangulation_.id(cell), size, edge, ball.centre});
  }

  /// Refines these cells, and where that makes others nearby, those too. Returns what is left to do.
  std::vector<BadCell> run_pass(const std::vector<BadCell>& waiting) {
    const double side = kEdgesPerCube * long_edge_mm(waiting);
    std::vector<BadCell> near, far, later;
    std::vector<Vector3d> centres;
    for (const BadCell& bad : waiting) {
      if (!triangulation_.is_there(bad.id)) continue;
      if (reaches(bad, side / 2)) {
        far.push_back(bad);
      } else {
        near.push_back(bad);
        centres.push_back(bad.centre);
      }
    }
    // What a cube empties is given to no other one before the end: bad cells are known by their slots.
    std::vector<std::uint32_t> emptied;
    const ColourLattice lattice(centres, side);
    std::vector<Share> shares(lattice.size());
    const auto hand_out = [&](std::span<const ColourLattice::Cube> cubes, std::size_t first) {
      for (std::size_t n = 0; n < cubes.size(); ++n) stock_up(shares[first + n], cubes[n].items.size());
    };
    const auto refine = [&](const ColourLattice::Cube& cube, std::size_t n, Cavity& cavity) {
      refine_cube(cube, side / 2, near, shares[n], cavity);
    };
    const auto collect = [&](std::span<const ColourLattice::Cube> cubes, std::size_t first) {
      for (Share& share : std::span(shares).subspan(first, cubes.size())) {
        const std::span<const std::uint32_t> slots = share.stock.slots;
        triangulation_.take_back(slots.first(share.stock.untouched));
        emptied.insert(emptied.end(), slots.begin() + static_cast<std::ptrdiff_t>(share.stock.untouched),
                       slots.end());
        spare_points_.insert(spare_points_.end(), share.points.begin(), share.points.end());
        far.insert(far.end(), share.far.begin(), share.far.end());
        later.insert(later.end(), share.later.begin(), share.later.end());
        share = Share();
      }
      tell_progress();
    };
    for_colours(
        ctx_.threads, lattice, hand_out, [] { return Cavity(); }, refine, collect);
    triangulation_.take_back(emptied);
    if (!cancelled_) refine_far(far, later);
    return later;
  }

  /// The target edge length that few of these cells exceed.
  static double long_edge_mm(const std::vector<BadCell>& cells) {
    std::vector<double> edges;
    edges.reserve(cells.size());
    for (const BadCell& bad : cells) edges.push_back(bad.edge_mm);
    const auto at =
        edges.begin() + static_cast<std::ptrdiff_t>(kLongShare * static_cast<double>(edges.size()));
    std::nth_element(edges.begin(), at, edges.end());
    return *at;
  }

  bool reaches(const BadCell& bad, double distance) const {
    return triangulation_.ball(bad.id.slot).radius2 >= distance * distance;
  }

  void stock_up(Share& share, std::size_t bad_cells) {
    const std::size_t slots = kSlotsPerCell * bad_cells + kSlotsPerCube;
    triangulation_.stock_up(share.stock, slots);
    while (share.points.size() < slots / kCellsPerPoint) {
      if (spare_points_.empty()) spare_points_.push_back(triangulation_.add_point(Vector3d::Zero()));
      share.points.push_back(spare_points_.back());
      spare_points_.pop_back();
    }
  }

  /// Changes cells in the zone of the cube alone. Cells whose balls have a smaller radius than `reach` lie
  /// there if their centres are in the cube.
  void refine_cube(const ColourLattice::Cube& cube, double reach, const std::vector<BadCell>& near,
                   Share& share, Cavity& cavity) {
    if (ctx_.cancelled()) cancelled_ = true;
    BadCells waiting{kLevels};
    for (const std::uint32_t i : cube.items) waiting.push(near[i].size, near[i]);
    std::vector<BadCell> made;
    for (std::size_t tries = 1; const std::optional<BadCell> bad = waiting.pop(); ++tries) {
      if (tries % kTriesPerQuestion == 0 && ctx_.cancelled()) cancelled_ = true;
      if (cancelled_) return;
      if (!triangulation_.is_there(bad->id)) continue;
      const double margin = distance_to_border(cube.zone, bad->centre);
      const auto in_zone = [&](std::uint32_t cell) {
        // Its ball holds the centre.
        if (4 * triangulation_.ball(cell).radius2 < margin * margin) return true;
        const auto& corners = triangulation_.corners(cell);
        return std::all_of(corners.begin(), corners.end(),
                           [&](std::uint32_t v) { return cube.zone.holds(triangulation_.point(v)); });
      };
      if (!find_cavity(*bad, cavity, in_zone)) {
        share.far.push_back(*bad);
        continue;
      }
      if (!may_fill(*bad, cavity)) continue;
      if (share.points.empty() || share.stock.slots.size() < cavity.rim.size()) {
        // There would not be room for the largest ones in the next pass either.
        (cavity.rim.size() > kSlotsPerCube ? share.far : share.later).push_back(*bad);
        while (const std::optional<BadCell> other = waiting.pop()) share.later.push_back(*other);
        return;
      }
      insert(*bad, cavity, share);
      made.clear();
      for (const std::uint32_t cell : share.stock.made) examine(cell, made);
      for (const BadCell& other : made)
        if (cube.zone.holds_inside(other.centre) && !reaches(other, reach))
          waiting.push(other.size, other);
        else
          share.later.push_back(other);
    }
  }

  /// One after the other. What that makes to be refined comes to `later`.
  void refine_far(const std::vector<BadCell>& far, std::vector<BadCell>& later) {
    BadCells waiting{kLevels};
    for (const BadCell& bad : far) waiting.push(bad.size, bad);
    Share share;
    Cavity cavity;
    for (std::size_t tries = 1; const std::optional<BadCell> bad = waiting.pop(); ++tries) {
      if (tries % kTriesPerQuestion == 0 && ctx_.cancelled()) cancelled_ = true;
      if (cancelled_) return;
      if (!triangulation_.is_there(bad->id)) continue;
      find_cavity(*bad, cavity, [](std::uint32_t) { return true; });
      if (!may_fill(*bad, cavity)) continue;
      if (share.points.empty()) stock_up(share, 0);
      triangulation_.stock_up(share.stock, cavity.rim.size());
      insert(*bad, cavity, share);
      for (const std::uint32_t cell : share.stock.made) examine(cell, later);
    }
    triangulation_.take_back(share.stock.slots);
    spare_points_.insert(spare_points_.end(), share.points.begin(), share.points.end());
  }

  static double distance_to_border(const CubeZone& zone, const Vector3d& p) {
    return std::min((p - zone.low).minCoeff(), (zone.high - p).minCoeff());
  }

  /// The cells whose balls hold the centre of a bad cell and that are connected with it inside its label.
  template <class MayTake>
  bool find_cavity(const BadCell& bad, Cavity& cavity, const MayTake& may_take) const {
    const Label label = triangulation_.label(bad.id.slot);
    return triangulation_.find_cavity(
        bad.centre, bad.id.slot, cavity,
        [&](std::uint32_t cell) { return triangulation_.label(cell) == label; }, may_take);
  }

  /// Whether the centre of a bad cell sees the whole rim of the cavity and is not too close to triangles of
  /// the surface there.
  bool may_fill(const BadCell& bad, const Cavity& cavity) const {
    const Vector3d& p = bad.centre;
    return std::all_of(cavity.rim.begin(), cavity.rim.end(), [&](DelaunayTriangulation::Facet facet) {
      if (!triangulation_.is_within(facet, p)) return false;
      const std::uint32_t other = DelaunayTriangulation::cell_of(triangulation_.across(facet));
      if (triangulation_.label(other) == triangulation_.label(bad.id.slot)) return true;
      const auto& corners = triangulation_.corners(DelaunayTriangulation::cell_of(facet));
      const auto& [j, k, l] = kFacetCorners[DelaunayTriangulation::corner_of(facet)];
      const auto [centre, radius2] =
          circumcircle(triangulation_.point(corners[j]), triangulation_.point(corners[k]),
                       triangulation_.point(corners[l]));
      return (p - centre).squaredNorm() >= kProtected * kProtected * radius2;
    });
  }

  void insert(const BadCell& bad, const Cavity& cavity, Share& share) {
    const Label label = triangulation_.label(bad.id.slot);
    const std::uint32_t vertex = share.points.back();
    share.points.pop_back();
    triangulation_.place(vertex, bad.centre);
    triangulation_.insert(vertex, cavity, share.stock);
    for (const std::uint32_t cell : share.stock.made) triangulation_.set_label(cell, label);
  }

  DelaunayTriangulation& triangulation_;
  const SizingField& sizing_;
  double radius_edge_;
  const WallLayers& layers_;
  const RunContext& ctx_;
  std::size_t first_points_ = 0;
  std::vector<std::uint32_t> spare_points_;
  std::atomic<bool> cancelled_ = false;
};

}  // namespace

Refined refine_cells(DelaunayCells& cells, const SizingField& sizing, double radius_edge,
                     std::size_t max_points, const WallLayers& layers, const RunContext& ctx) {
  return CellRefiner(cells, sizing, radius_edge, layers, ctx).run(max_points);
}

}  // namespace voxtet::tetra
