// The reverse envelope: every vertex of the reference has a triangle of the adapted surface near it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "remesh/complex/complex_mesh.h"
#include "remesh/complex/edit.h"
#include "remesh/envelope/correspondence.h"
#include "remesh/envelope/reference_surface.h"

namespace voxtet::remesh {

/// Corners and unit normals of the triangles of edit.removed or of edit.added.
struct FacetShapes {
  const std::vector<Corners>& corners;
  const std::vector<Eigen::Vector3d>& normals;
};

/// New hosts of the samples of an edit.
struct Rehosting {
  struct Move {
    std::uint32_t sample;
    std::uint32_t host;  ///< index into edit.added or edit.curves_added, or kBeside + triangle
  };
  static constexpr std::uint32_t kBeside = 0x80000000U;
  std::vector<Move> surface, curves;
};

/// Every sample has a host near it: samples on surfaces a triangle, samples on curves a curve edge; corners
/// have none (they stay). An edit moves the samples of what it removes to what it adds, or to triangles
/// beside it.
class ReverseEnvelope {
 public:
  ReverseEnvelope(const ComplexMesh& mesh, const ReferenceSurface& reference,
                  const Correspondence& correspondence);

  /// Finds new hosts for the samples of the edit's triangles. They must be within `reach_mm`, or no farther
  /// than before; the cosine between the normals of host and sample must be at least `least_cosine`, or more
  /// than before. Returns kNo, kReverse or kNormal. Writes to `rehosting.surface`.
  Refusal try_surface(const ComplexMesh& mesh, const Edit& edit, double reach_mm, double least_cosine,
                      const FacetShapes& removed, const FacetShapes& added, Rehosting& rehosting) const;
  /// The same for the samples of the edit's curve edges, to `rehosting.curves`. Returns kNo or kCurve.
  Refusal try_curves(const ComplexMesh& mesh, const Edit& edit, double reach_mm, Rehosting& rehosting) const;
  /// Carries out what two tries found. `slots`: the triangle that each added facet became.
  void commit(const Edit& edit, const Rehosting& rehosting, const std::vector<std::uint32_t>& slots);

  template <class Visit>
  void for_samples(std::uint32_t t, Visit&& visit) const {
    if (t >= heads_.size()) return;
    for (std::uint32_t s = heads_[t]; s != kNone; s = next_[s]) visit(s);
  }

  template <class Visit>
  void for_curve_samples(std::uint32_t a, std::uint32_t b, Visit&& visit) const {
    for (const auto& [end, other] : {std::array{a, b}, std::array{b, a}}) {
      if (end >= curve_heads_.size()) continue;
      for (std::uint32_t s = curve_heads_[end]; s != kNone; s = next_[s])
        if (curve_other_[s] == other) visit(s);
    }
  }

 private:
  struct Found {
    double distance2;
    std::uint32_t host;
  };
  static Found best_added(const Edit& edit, const std::vector<Corners>& added, PairId pair,
                          const Eigen::Vector3d& p);
  Found best_beside(const ComplexMesh& mesh, const Edit& edit, PairId pair, const Eigen::Vector3d& p,
                    Found best) const;

  const ReferenceSurface& reference_;
  double near_mm_ = 0;                      ///< mean spacing of the samples
  std::vector<std::uint32_t> heads_;        ///< by triangle
  std::vector<std::uint32_t> next_;         ///< by sample
  std::vector<std::uint32_t> curve_heads_;  ///< by vertex: samples of curve edges that have it as first end
  std::vector<std::uint32_t> curve_other_;  ///< by sample: the second end
};

}  // namespace voxtet::remesh
