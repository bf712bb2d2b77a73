// The surface that the adapted one has to stay near. Closest points are found by walking, without a search
// tree.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "remesh/complex/complex_mesh.h"

namespace voxtet::remesh {

/// A copy of the complex before the first edit; vertices and triangles keep their indices. Its vertices are
/// the samples at which distances are measured: those on a surface have a normal and a share of its area.
class ReferenceSurface {
 public:
  explicit ReferenceSurface(const ComplexMesh& mesh);

  std::size_t size() const { return points_.size(); }
  const Eigen::Vector3d& point(std::uint32_t r) const { return points_[r]; }
  const Eigen::Vector3d& normal(std::uint32_t r) const { return normals_[r]; }
  double area(std::uint32_t r) const { return areas_[r]; }
  /// Squared distance below which a walk ends at the first star.
  double near2() const { return near2_; }
  Stratum stratum(std::uint32_t r) const { return strata_[r]; }
  bool beside(std::uint32_t r, PairId pair) const {
    if (only_pair_[r] != kNone) return only_pair_[r] == pair;
    return std::any_of(star(r).begin(), star(r).end(), [&](std::uint32_t t) { return pairs_[t] == pair; });
  }
  /// Visits the vertices that share a triangle of the pair with r; on junction curves some more than once.
  template <class Visit>
  void for_neighbours(std::uint32_t r, PairId pair, Visit&& visit) const {
    if (only_pair_[r] != kNone) {
      if (only_pair_[r] == pair)
        for (std::uint32_t k = ring_first_[r]; k < ring_first_[r + 1]; ++k) visit(rings_[k]);
      return;
    }
    for (const std::uint32_t t : star(r))
      if (pairs_[t] == pair)
        for (const std::uint32_t v : triangles_[t])
          if (v != r) visit(v);
  }

  /// A near point on the sheets of `pair`, found by walking downhill from vertex `hint`, which must have a
  /// triangle of the pair; `hint` becomes the vertex reached. The walk stays on the sheet where it starts, so
  /// it never jumps across a thin wall. The distance found is an upper bound of the true one. The walk ends
  /// once the squared distance is below `enough2`.
  Eigen::Vector3d walk(const Eigen::Vector3d& p, PairId pair, std::uint32_t& hint, double enough2 = 0) const;
  /// The same along the curve of `hint`. If `hint` is a corner, the curve has only one edge: p itself is
  /// returned.
  Eigen::Vector3d walk_curve(const Eigen::Vector3d& p, std::uint32_t& hint) const;

 private:
  struct Foot {
    Eigen::Vector3d on;
    double distance2;
    std::uint32_t triangle;
  };
  /// Walks from vertex `at` to neighbours nearer to p while there are any; returns the squared distance
  /// reached.
  template <class VisitNeighbours>
  double walk_downhill(const Eigen::Vector3d& p, std::uint32_t& at, VisitNeighbours&& visit_neighbours) const;
  void add_ring(std::uint32_t r);
  void try_star(const Eigen::Vector3d& p, PairId pair, std::uint32_t r, double enough2, Foot& best) const;
  std::span<const std::uint32_t> star(std::uint32_t r) const {
    return {stars_.data() + first_[r], first_[r + 1] - first_[r]};
  }

  std::vector<Eigen::Vector3d> points_, normals_;
  std::vector<double> areas_;
  double near2_ = 0;
  std::vector<Stratum> strata_;
  std::vector<Triangle> triangles_;
  std::vector<PairId> pairs_;
  std::vector<std::uint32_t> first_, stars_;
  std::vector<PairId> only_pair_;                  ///< by vertex; kNone where there are several
  std::vector<std::uint32_t> ring_first_, rings_;  ///< neighbours of the vertices that have one pair only
  std::vector<std::array<std::uint32_t, 2>> curve_;
};

/// Closest point of a segment.
Eigen::Vector3d closest_on_segment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                   const Eigen::Vector3d& b);

}  // namespace voxtet::remesh
