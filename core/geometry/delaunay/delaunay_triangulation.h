// A Delaunay triangulation in space that grows by points, in flat arrays.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/elements/facet_corners.h"
#include "types/label_volume.h"

namespace voxtet {

/// Cells (tetrahedra) with neighbours, grown by A. Bowyer's and D. F. Watson's insertion (The Computer
/// Journal 24, 1981): the cells whose balls hold a new point, its cavity, give way to cells between the point
/// and the cavity's rim. The hull is closed by infinite cells, one behind each of its facets, so every cell
/// has four neighbours. All decisions are exact, so where no five points lie on a sphere the cells are the
/// only possible ones, and a cavity is always seen whole from its point.
///
/// Cells have slots, fewer than 2^29, and labels, which are those of who uses them: a new cell is background.
/// What is const may be called by many threads at once. insert() writes cells of the cavity, the links of
/// those beside it, and what belongs to their vertices and to the slots in stock.
class DelaunayTriangulation {
 public:
  static constexpr std::uint32_t kInfinite = 0xffffffffU;  ///< the vertex that all infinite cells share
  static constexpr std::uint32_t kNone = 0xffffffffU;      ///< no cell, no vertex

  /// The facet of a cell opposite to one of its corners, packed as 4 * cell + corner.
  using Facet = std::uint32_t;
  static std::uint32_t cell_of(Facet facet) { return facet >> 2; }
  static std::uint32_t corner_of(Facet facet) { return facet & 3; }

  /// A cell that no other one will ever be: slots are given anew.
  struct CellId {
    std::uint32_t slot, version;
  };

  /// The ball through a cell's corners. The centre as computed, mm, which may be far off or not finite where
  /// the cell is flat.
  struct Ball {
    Eigen::Vector3d centre;
    double radius2;
    double slack2;  ///< 8 times the square of the centre's largest error; infinite where not known
  };

  /// What a point will replace, and the workspace to find it: one for each thread.
  struct Cavity {
    std::vector<std::uint32_t> cells;
    std::vector<Facet> rim;  ///< of these cells, towards others
    std::vector<std::uint32_t> marks;
    std::uint32_t mark = 0;
  };
  /// Empty slots for new cells: one for each thread that inserts.
  struct Stock {
    std::vector<std::uint32_t> slots;  ///< the last ones go first
    std::size_t untouched = 0;         ///< the first ones, which have been empty ever since stock_up()
    std::vector<std::uint32_t> made;   ///< by the last insert()
  };

  /// Adds a point, finite, which no cell uses yet; its number counts from 0.
  std::uint32_t add_point(const Eigen::Vector3d& at) {
    points_.push_back(at);
    cell_at_.push_back(kNone);
    return static_cast<std::uint32_t>(points_.size() - 1);
  }
  /// Puts a point that no cell uses somewhere else.
  void place(std::uint32_t vertex, const Eigen::Vector3d& at) { points_[vertex] = at; }
  /// Makes the first cell, of the first four of these points that are not in one plane. False if all are.
  bool begin(std::span<const std::uint32_t> vertices);

  std::uint32_t point_count() const { return static_cast<std::uint32_t>(points_.size()); }
  const Eigen::Vector3d& point(std::uint32_t vertex) const { return points_[vertex]; }
  bool in_use(std::uint32_t vertex) const { return cell_at_[vertex] != kNone; }

  /// Number of slots for cells, empty ones included.
  std::uint32_t slots() const { return static_cast<std::uint32_t>(cells_.size()); }
  bool is_cell(std::uint32_t slot) const { return (versions_[slot] & 1) != 0; }
  CellId id(std::uint32_t cell) const { return {cell, versions_[cell]}; }
  /// Whether the cell has not been replaced.
  bool is_there(const CellId& cell) const { return versions_[cell.slot] == cell.version; }
  Label label(std::uint32_t cell) const { return labels_[cell]; }
  void set_label(std::uint32_t cell, Label label) { labels_[cell] = label; }
  bool is_infinite(std::uint32_t cell) const { return infinite_corner(cell) < 4; }
  bool is_finite(std::uint32_t slot) const { return is_cell(slot) && !is_infinite(slot); }
  const std::array<std::uint32_t, 4>& corners(std::uint32_t cell) const { return cells_[cell].corners; }
  /// The same facet as its other cell has it.
  Facet across(std::uint32_t cell, std::uint32_t corner) const { return cells_[cell].across[corner]; }
  Facet across(Facet facet) const { return cells_[cell_of(facet)].across[corner_of(facet)]; }
  std::uint32_t neighbour(std::uint32_t cell, std::uint32_t corner) const {
    return cell_of(across(cell, corner));
  }
  const Ball& ball(std::uint32_t cell) const { return balls_[cell]; }
  /// The index of a vertex among the corners of a cell; 4 if it is none of them.
  std::uint32_t corner_at(std::uint32_t cell, std::uint32_t vertex) const {
    const auto& c = cells_[cell].corners;
    return c[0] == vertex ? 0 : c[1] == vertex ? 1 : c[2] == vertex ? 2 : c[3] == vertex ? 3 : 4;
  }

  /// A cell that holds the point, or an infinite one behind a facet of the hull that the point lies beyond.
  /// Walks there from any cell (O. Devillers, S. Pion and M. Teillaud, "Walking in a triangulation", 2002).
  std::uint32_t locate(const Eigen::Vector3d& p, std::uint32_t from) const;
  /// Whether one of a cell's corners is at p.
  bool has_corner_at(std::uint32_t cell, const Eigen::Vector3d& p) const;
  /// Whether p lies on the side of a facet on which its cell does.
  bool is_within(Facet facet, const Eigen::Vector3d& p) const { return side_of(facet, p) < 0; }
  /// Whether p lies inside of the ball of a cell; for an infinite one, beyond its facet of the hull, or in
  /// its plane and inside of its circumcircle.
  bool is_in_conflict(std::uint32_t cell, const Eigen::Vector3d& p) const {
    const Ball& ball = balls_[cell];
    const double distance2 = (p - ball.centre).squaredNorm(), sum = distance2 + ball.radius2;
    const double apart = distance2 - ball.radius2, sure = (apart < 0 ? -apart : apart) - kRounding * sum;
    if (sure > 0 && sure * sure > ball.slack2 * sum) return apart < 0;
    return is_surely_in_conflict(cell, p);
  }
  /// The cells in conflict with p that are connected with `first`, which is, through facets
  /// beyond which may_pass(cell) is true. False, and no more is looked at, where may_take(cell) is false for
  /// one of them.
  template <class MayPass, class MayTake>
  bool find_cavity(const Eigen::Vector3d& p, std::uint32_t first, Cavity& cavity, const MayPass& may_pass,
                   const MayTake& may_take) const;
  /// The same, all of them.
  void find_cavity(const Eigen::Vector3d& p, std::uint32_t first, Cavity& cavity) const {
    find_cavity(
        p, first, cavity, [](std::uint32_t) { return true; }, [](std::uint32_t) { return true; });
  }

  /// Empty slots for at least `count` cells.
  void stock_up(Stock& stock, std::size_t count);
  /// Empty slots of a stock, which are then given to others.
  void take_back(std::span<const std::uint32_t> slots);
  /// Puts cells between a vertex and the rim of its cavity, all of which it must see from inside. stock.made
  /// then holds them: the n-th has the n-th facet of the rim, with the vertex as the corner opposite to it.
  /// Neither has the cavity been changed nor a cell beside it since it was found. The stock has a slot for
  /// each facet of the rim, and takes those of the cavity.
  void insert(std::uint32_t vertex, const Cavity& cavity, Stock& stock);

  /// All cells at a vertex in use, into cavity.cells.
  void find_star(std::uint32_t vertex, Cavity& cavity) const;

 private:
  struct Cell {
    std::array<std::uint32_t, 4> corners;
    std::array<Facet, 4> across;
  };
  /// Of a squared distance, relative, with some room.
  static constexpr double kRounding = 3e-15;

  std::uint32_t infinite_corner(std::uint32_t cell) const { return corner_at(cell, kInfinite); }
  bool is_surely_in_conflict(std::uint32_t cell, const Eigen::Vector3d& p) const;
  /// 1 beyond a facet without the infinite vertex, -1 on the side of its cell, 0 in its plane.
  int side_of(Facet facet, const Eigen::Vector3d& p) const;
  void fill(std::uint32_t slot, const std::array<std::uint32_t, 4>& corners);
  void link(Facet facet, Facet other);

  std::vector<Eigen::Vector3d> points_;
  std::vector<std::uint32_t> cell_at_;  ///< a cell of each vertex
  std::vector<Cell> cells_;
  std::vector<Ball> balls_;
  std::vector<Label> labels_;
  std::vector<std::uint32_t> versions_;  ///< by slot: how often it was filled or emptied; odd for a cell
  std::vector<std::uint32_t> empty_;
};

template <class MayPass, class MayTake>
bool DelaunayTriangulation::find_cavity(const Eigen::Vector3d& p, std::uint32_t first, Cavity& cavity,
                                        const MayPass& may_pass, const MayTake& may_take) const {
  cavity.marks.resize(cells_.size(), 0);
  cavity.mark += 2;
  const std::uint32_t inside = cavity.mark, outside = inside + 1;
  cavity.cells.assign(1, first);
  cavity.rim.clear();
  cavity.marks[first] = inside;
  for (std::size_t k = 0; k < cavity.cells.size(); ++k) {
    const std::uint32_t cell = cavity.cells[k];
    if (!may_take(cell)) return false;
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t next = neighbour(cell, i);
      std::uint32_t& mark = cavity.marks[next];
      if (mark == inside) continue;
      if (mark != outside && may_pass(next)) {
        if (is_in_conflict(next, p)) {
          mark = inside;
          cavity.cells.push_back(next);
          continue;
        }
        mark = outside;
      }
      cavity.rim.push_back(4 * cell + i);
    }
  }
  return true;
}

}  // namespace voxtet
