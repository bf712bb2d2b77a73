// Tetrahedra that know their neighbours, for local changes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/id_set.h"
#include "geometry/elements/facet_corners.h"
#include "tetra/mesh/tet_quality.h"
#include "types/tet_mesh.h"

namespace voxtet::tetra {

inline constexpr std::uint32_t kNone = 0xffffffffU;

/// The side of a tet opposite to one of its corners, packed as 4 * tet + corner; kNone for the outside.
using Facet = std::uint32_t;
inline std::uint32_t tet_of(Facet facet) {
  return facet >> 2;
}
inline std::uint32_t corner_of(Facet facet) {
  return facet & 3;
}

/// The corners other than i and j, such that (i, j, first, second) is an even permutation of 0, 1, 2, 3.
inline constexpr std::uint32_t kOtherCorners[4][4][2] = {{{0, 0}, {2, 3}, {3, 1}, {1, 2}},
                                                         {{3, 2}, {0, 0}, {0, 3}, {2, 0}},
                                                         {{1, 3}, {3, 0}, {0, 0}, {0, 1}},
                                                         {{2, 1}, {0, 2}, {1, 0}, {0, 0}}};

/// The tets around an edge (a, b) inside one label, in order: tet i has the corners a, b, ring[i], ring[i +
/// 1], and these are positive.
struct EdgeRing {
  static constexpr std::uint32_t kMost = 7;
  std::uint32_t a = 0, b = 0, size = 0;
  std::array<std::uint32_t, kMost> ring, tets;
};

/// The corners of a side, ascending.
Triangle ascending(Triangle corners);

/// Interfaces that replace others with the same sides; as many or fewer. Both are oriented as seen from one
/// side of the interface.
struct InterfaceExchange {
  std::vector<Triangle> gone, made;
};

/// A tetrahedral mesh with neighbours, the quality of each tet, and one tet for each point. The sides of tets
/// between different labels, or a label and background, are interfaces: only relabel() changes them. Every
/// tet is positive by the exact predicate.
class TetComplex {
 public:
  /// Needs a mesh as TetMesh describes it.
  explicit TetComplex(TetMesh mesh);
  /// The mesh without removed tets and points; points keep their order.
  TetMesh release() &&;

  /// Number of slots for tets, those of removed tets included.
  std::uint32_t places() const { return static_cast<std::uint32_t>(cells_.size()); }
  bool alive(std::uint32_t t) const { return cells_[t].corners[0] != kNone; }
  const Tet& corners(std::uint32_t t) const { return cells_[t].corners; }
  Label label(std::uint32_t t) const { return cells_[t].label; }
  double quality_of(std::uint32_t t) const { return cells_[t].quality; }
  /// The other tet's side that lies on this one, or kNone.
  Facet across(std::uint32_t t, std::uint32_t corner) const { return cells_[t].across[corner]; }
  /// The tet behind a side, or kNone where the side is an interface.
  std::uint32_t behind(std::uint32_t t, std::uint32_t corner) const {
    const Facet facet = across(t, corner);
    return facet != kNone && label(tet_of(facet)) == label(t) ? tet_of(facet) : kNone;
  }
  /// The index of a vertex among the corners of a tet; 4 if it is none of them.
  std::uint32_t corner_at(std::uint32_t t, std::uint32_t vertex) const {
    const Tet& c = cells_[t].corners;
    return c[0] == vertex ? 0 : c[1] == vertex ? 1 : c[2] == vertex ? 2 : c[3] == vertex ? 3 : 4;
  }

  const Point& point(std::uint32_t vertex) const { return points_[vertex]; }
  std::uint32_t point_count() const { return static_cast<std::uint32_t>(points_.size()); }
  /// False for points that no tet uses.
  bool in_use(std::uint32_t vertex) const { return tet_at_[vertex] != kNone; }
  /// On an interface.
  bool on_interface(std::uint32_t vertex) const { return on_interface_[vertex]; }
  /// Volume of all tets of a label, mm³; 0 for a label without tets.
  double volume_mm3(Label label) const { return label < label_end() ? volumes_mm3_[label] : 0; }
  /// One more than the largest label.
  std::size_t label_end() const { return volumes_mm3_.size(); }
  double tet_volume_mm3(std::uint32_t t) const;
  double quality_at(const Tet& t) const {
    return quality(points_[t[0]], points_[t[1]], points_[t[2]], points_[t[3]]);
  }

  /// False if an interface meets the edge between two corners of a tet, or if it has more than
  /// EdgeRing::kMost tets.
  bool find_ring(std::uint32_t t, std::uint32_t i, std::uint32_t j, EdgeRing& ring) const;
  /// All tets at a vertex, across interfaces too, into `star`. `seen` is work memory.
  void find_star(std::uint32_t vertex, IdSet& seen, std::vector<std::uint32_t>& star) const;
  /// The other corners of the tets at a vertex, each once.
  void find_neighbours(std::uint32_t vertex, std::span<const std::uint32_t> star, IdSet& seen,
                       std::vector<std::uint32_t>& neighbours) const;

  /// Replaces the tets `gone` by `made`: both of one label, filling the same space behind the same sides. If
  /// not all of `made` are positive by the exact predicate, nothing happens and the result is false. Points
  /// that lose all their tets are removed, too. made() then holds the slots of the new tets.
  bool replace(std::span<const std::uint32_t> gone, std::span<const Tet> made);
  const std::vector<std::uint32_t>& made() const { return made_; }

  /// The interfaces, as TetMesh lists them.
  const std::vector<Triangle>& interfaces() const { return faces_; }
  const std::vector<Sides>& interface_sides() const { return face_sides_; }

  /// Gives a tet the label behind its interfaces; with background it is removed. At least one of its sides
  /// must be no interface. The list of interfaces is wrong until exchange_interfaces().
  void relabel(std::uint32_t t, Label label);
  /// Brings the list of interfaces up to date; no interface may be in two exchanges.
  void exchange_interfaces(std::span<const InterfaceExchange> exchanges);

  /// What replace() or move_point() did.
  struct Change {
    std::vector<std::uint32_t> made;  ///< slots of the tets that are new or have another shape
    std::vector<std::uint32_t> gone;  ///< slots of the tets that were replaced
    std::vector<Tet> gone_corners;
    std::uint32_t moved = kNone;  ///< the vertex that moved, if any
    Point from = Point::Zero();
  };
  struct Mark {
    std::size_t changes, points;
  };
  /// A state in the history that undo_to() can return to. Changes are recorded from the first mark until
  /// forget_changes(); relabel() is not recorded.
  Mark mark();
  std::span<const Change> changes_since(const Mark& mark) const {
    return std::span(changes_).subspan(mark.changes);
  }
  /// Takes back all changes since the mark and drops the points added since.
  void undo_to(const Mark& mark);
  void forget_changes();

  /// Adds a point that no tet uses yet.
  std::uint32_t add_point(const Point& at);
  /// Forgets the point added last, which no tet uses.
  void drop_point();
  /// Moves a vertex; `star` are its tets. False, and nothing happens, unless all of them stay positive by the
  /// exact predicate. Without a mark, threads may move vertices that are on no interface and have no tet in
  /// common.
  bool move_point(std::uint32_t vertex, const Point& to, std::span<const std::uint32_t> star);

 private:
  struct Cell {
    Tet corners;
    std::array<Facet, 4> across;
    double quality;
    std::uint32_t mark;  ///< of the last replacement that it belonged to
    Label label;
  };
  /// A side that waits for the tet on its other side, which will have the same corners (ascending).
  struct Waiting {
    std::array<std::uint32_t, 3> corners;
    Facet facet;  ///< kNone: the outside
  };
  void connect();
  /// Connects a side with the one that waits for it, or makes it wait.
  void meet(const Waiting& side);
  void wait_outside(std::span<const std::uint32_t> gone);
  std::uint32_t take_place();
  bool is_positive(const Tet& t) const;
  void add_volume(Label label, double mm3);

  std::vector<Point> points_;
  std::vector<std::uint8_t> on_interface_;
  std::vector<std::uint32_t> tet_at_;  ///< one tet of each vertex; kNone for points that are gone
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> free_, made_;
  std::vector<Waiting> waiting_;
  std::vector<Triangle> faces_;
  std::vector<Sides> face_sides_;
  std::vector<double> volumes_mm3_;  ///< by label; those of background stay 0
  std::uint32_t mark_ = 0;
  bool keeps_changes_ = false;
  std::vector<Change> changes_;
};

}  // namespace voxtet::tetra
