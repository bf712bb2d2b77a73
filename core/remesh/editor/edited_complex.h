// A labelled complex that is edited, the reference that it stays near, and what is known of both.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "remesh/complex/complex_mesh.h"
#include "remesh/complex/edit.h"
#include "remesh/complex/gabriel_balls.h"
#include "remesh/complex/triangle_hash.h"
#include "remesh/envelope/correspondence.h"
#include "remesh/envelope/reference_surface.h"
#include "remesh/envelope/reverse_envelope.h"
#include "types/sizing_field.h"

namespace voxtet::remesh {

struct EditLimits {
  double reach_mm = 0.5;  ///< envelope, both directions
  double nearer_mm = 0;   ///< the envelope for Demand::kNearer, if this is wider
  double lattice_mm = 1;  ///< spacing of the points at which new facets are compared with the reference
  /// If positive: where a facet may be farther than this between the lattice points, it is examined on a
  /// closer lattice.
  double sure_mm = 0;
  double angle_cosine = 0.95;    ///< largest cosine of planar angles
  double crease_cosine = 0.5;    ///< largest cosine of the dihedral angle inside a surface
  double junction_cosine = 0.9;  ///< largest cosine of the dihedral angle where curves run
  double turn_cosine = 0.5;      ///< least cosine of a facet's turn against the reference, and in one edit
  double gap_share = 0;          ///< least distance of sheets that face each other, in target edge lengths
  /// The complex is already adapted. Where it is beyond its envelope it must not go farther. Where sheets are
  /// nearer than the gap, edges may not grow faster than the gap.
  bool adapted = false;
  /// Facets that can be Delaunay stay so, except under Demand::kNearer. Then tetrahedra between sheets that
  /// are near each other need no additional points.
  bool keeps_delaunay = false;
  bool verify = false;
};

/// Where a triangle is farthest from the reference, or a sample hosted by it or its curve edges is farthest
/// from it.
struct Deviation {
  double distance2 = 0;                               ///< negative: not known
  Eigen::Vector3d toward = Eigen::Vector3d::Zero();   ///< from the triangle to the reference
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();  ///< barycentric weights of the place on the triangle
};
/// Squared distance if nothing of the reference is known to be near.
inline constexpr double kNowhere = 1e300;

/// Nothing here changes the complex: threads may ask at once while nobody does.
class EditedComplex {
 public:
  /// Both complexes have the same table of sides.
  EditedComplex(ComplexMesh mesh, const ComplexMesh& reference, const Correspondence& correspondence,
                const SizingField& sizing);

  EditLimits limits;

  const ComplexMesh& mesh() const { return mesh_; }
  const ReferenceSurface& reference() const { return reference_; }
  const ReverseEnvelope& samples() const { return samples_; }
  const TriangleHash& hash() const { return *hash_; }
  const Eigen::Vector3d& normal(std::uint32_t t) const { return normals_[t]; }
  /// Of a triangle, before other vertices are considered.
  const GabrielBalls& balls(std::uint32_t t) const { return balls_[t]; }
  /// Target edge length at a vertex.
  double size(std::uint32_t v) const { return std::max(floor_, sizes_[v]); }
  bool on_curves(std::uint32_t u, std::uint32_t w) const {
    return mesh_.stratum(u) != Stratum::kSurface && mesh_.stratum(w) != Stratum::kSurface;
  }
  /// Cosine of the sharpest dihedral angle allowed at an edge.
  double fold_limit(std::uint32_t u, std::uint32_t w) const {
    return on_curves(u, w) ? limits.junction_cosine : limits.crease_cosine;
  }
  /// Length of an edge in target edge lengths.
  double metric_length(std::uint32_t a, std::uint32_t b) const {
    return (mesh_.point(a) - mesh_.point(b)).norm() * 0.5 * (1 / size(a) + 1 / size(b));
  }
  /// A vertex of the reference near v, on one of v's sheets or curves; kNone if there is none.
  std::uint32_t hint(std::uint32_t v) const { return hints_[v]; }

  /// Of different triangles on different threads after make_room_for_deviations().
  Deviation farthest(std::uint32_t t) const;
  void make_room_for_deviations() const;
  /// Whether the triangle lies inside a sheet that is not folded there and hosts samples for most of its
  /// area, none farther than `reach_mm`.
  bool well_sampled(std::uint32_t t, double reach_mm) const;

  /// What is known of the distance of a triangle's points; null if nothing is.
  const Deviation* known_deviation(std::uint32_t t) const {
    const bool known = deviations_lattice_mm_ == limits.lattice_mm && t < deviations_.size() &&
                       deviations_[t].distance2 >= 0;
    return known ? &deviations_[t] : nullptr;
  }
  /// The distance of a triangle's points, found anew.
  Deviation find_deviation(std::uint32_t t, const Corners& p) const;
  /// How far a facet with corners at `p` is from the reference; it does not matter how far exactly beyond
  /// `most2` or within it. `moved`: the corner that is to be looked at itself, or kNone.
  double distance2_of(const Facet& facet, const Corners& p, std::uint32_t moved, double most2) const;

 protected:
  inline static const Deviation kUnknown{-1, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};

  ComplexMesh mesh_;
  ReferenceSurface reference_;
  ReverseEnvelope samples_;
  std::optional<TriangleHash> hash_;
  const SizingField& sizing_;
  double floor_ = 0;
  std::vector<double> sizes_;
  std::vector<std::uint32_t> hints_;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<GabrielBalls> balls_;
  /// By slot: deviations of the present triangles, found with this lattice spacing. Remembered, because the
  /// same triangles are to be replaced again and again.
  mutable std::vector<Deviation> deviations_;
  mutable double deviations_lattice_mm_ = 0;

 private:
  std::vector<std::uint32_t> samples_of(std::uint32_t t) const;
  bool is_folded(std::uint32_t t) const;
  void look_between_samples(std::uint32_t t, const Corners& p, Deviation& worst) const;
  void look_from(const Eigen::Vector3d& at, std::uint32_t t, const Corners& p, Deviation& worst) const;
  std::uint32_t nearest_hint(const Facet& facet, const Corners& p) const;
  Deviation farthest_point(const Facet& facet, const Corners& p, std::uint32_t moved, double lattice_mm,
                           double content2, std::uint32_t hint, double enough2 = 0,
                           std::span<const std::uint32_t> more_hints = {}) const;
};

}  // namespace voxtet::remesh
