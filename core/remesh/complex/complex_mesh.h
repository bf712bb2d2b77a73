// A labelled triangle complex for editing: triangles can be added and removed, and stars are kept up to date.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geometry/elements/triangle_measures.h"
#include "types/surface_mesh.h"

namespace voxtet::remesh {

inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
using PairId = std::uint32_t;  ///< which two labels a triangle separates: an entry of ComplexMesh::sides()
using Corners = TriangleCorners;

/// The manifold of highest order that a vertex is on (Dey, Edelsbrunner, Guha and Nekhayev, "Topology
/// preserving edge contraction", 1999).
enum class Stratum : std::uint8_t {
  kSurface,  ///< its triangles form one disc
  kCurve,    ///< its triangles form half-discs that share one curve through it
  kCorner,   ///< anything else
};

struct Facet {
  Triangle corners;
  PairId pair = 0;
};

/// Flat arrays. A triangle slot is dead when its first corner is kNone, a vertex when its star is empty.
class ComplexMesh {
 public:
  explicit ComplexMesh(const SurfaceMesh& surface) : ComplexMesh(surface, surface.sides) {}
  /// `sides`: every pair of labels that may occur, in any order; it contains those of the surface.
  ComplexMesh(const SurfaceMesh& surface, std::vector<Sides> sides);

  std::size_t vertex_count() const { return points_.size(); }
  std::size_t slot_count() const { return triangles_.size(); }
  bool alive(std::uint32_t t) const { return triangles_[t][0] != kNone; }
  const Triangle& triangle(std::uint32_t t) const { return triangles_[t]; }
  PairId pair(std::uint32_t t) const { return pairs_[t]; }
  const std::vector<Sides>& sides() const { return sides_; }
  const Eigen::Vector3d& point(std::uint32_t v) const { return points_[v]; }
  Corners corners(const Triangle& t) const { return {points_[t[0]], points_[t[1]], points_[t[2]]}; }
  Stratum stratum(std::uint32_t v) const { return strata_[v]; }
  /// Triangles of a vertex, in an order that depends on the edits alone.
  std::span<const std::uint32_t> star(std::uint32_t v) const {
    return {pool_.data() + rows_[v].first, rows_[v].count};
  }
  std::uint32_t edge_degree(std::uint32_t a, std::uint32_t b) const;
  /// True unless the edge has exactly two triangles.
  bool is_curve(std::uint32_t a, std::uint32_t b) const {
    return strata_[a] != Stratum::kSurface && strata_[b] != Stratum::kSurface && edge_degree(a, b) != 2;
  }

  void set_point(std::uint32_t v, const Eigen::Vector3d& p) { points_[v] = p; }
  std::uint32_t add_vertex(const Eigen::Vector3d& p, Stratum stratum);
  /// Takes the last vertex back; it must have no triangles.
  void drop_last_vertex();
  /// Puts another facet into the slot.
  void replace(std::uint32_t t, const Facet& facet);
  void remove(std::uint32_t t);
  /// Returns the slot.
  std::uint32_t add(const Facet& facet);

  /// Everything that is alive, renumbered in order.
  SurfaceMesh to_surface() const;

 private:
  struct Row {
    std::uint32_t first = 0;
    std::uint16_t count = 0, capacity_log2 = 0;
  };
  std::uint32_t take_block(std::uint16_t capacity_log2);
  void attach(std::uint32_t v, std::uint32_t t);
  void detach(std::uint32_t v, std::uint32_t t);
  void classify();
  /// An edge at the current vertex, with the number of its triangles.
  struct Spoke {
    std::uint32_t end, degree;
  };
  /// `spokes` is work memory.
  Stratum stratum_of(std::uint32_t v, std::vector<Spoke>& spokes) const;
  bool is_one_fan(std::uint32_t v) const;
  bool is_book(std::uint32_t v, std::uint32_t from, std::uint32_t to) const;
  std::uint32_t walk_sheet(std::uint32_t v, std::uint32_t t, std::uint32_t over, std::uint32_t stop_a,
                           std::uint32_t stop_b, std::uint32_t& end) const;

  std::vector<Eigen::Vector3d> points_;
  std::vector<Stratum> strata_;
  std::vector<Triangle> triangles_;
  std::vector<PairId> pairs_;
  std::vector<Sides> sides_;
  std::vector<Row> rows_;
  std::vector<std::uint32_t> pool_;                         ///< blocks of powers of two
  std::array<std::vector<std::uint32_t>, 17> free_blocks_;  ///< by log2 of their capacity
  std::vector<std::uint32_t> free_slots_;
};

inline bool has_corner(const Triangle& t, std::uint32_t v) {
  return t[0] == v || t[1] == v || t[2] == v;
}
/// The corner that is neither a nor b.
inline std::uint32_t third_corner(const Triangle& t, std::uint32_t a, std::uint32_t b) {
  for (const std::uint32_t v : t)
    if (v != a && v != b) return v;
  return kNone;
}

}  // namespace voxtet::remesh
