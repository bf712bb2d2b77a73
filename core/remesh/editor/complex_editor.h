// Edits of a labelled complex as transactions: checked, then done or refused.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "remesh/complex/complex_mesh.h"
#include "remesh/complex/edit.h"
#include "remesh/complex/gabriel_balls.h"
#include "remesh/complex/intersection_verifier.h"
#include "remesh/complex/triangle_hash.h"
#include "remesh/envelope/correspondence.h"
#include "remesh/envelope/reference_surface.h"
#include "remesh/envelope/reverse_envelope.h"
#include "types/sizing_field.h"

namespace voxtet::remesh {

/// EditLimits::turn_cosine for the removal of slivers, whose normals say little.
inline constexpr double kTurnCosineOfSlivers = -0.3;

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

enum class Demand : std::uint8_t {
  kAllowed,      ///< every limit holds, or what breaks it is no worse than before
  kBetterAngle,  ///< and the smallest planar angle grows; normals count for less
  kBetterFold,   ///< and the sharpest angle between facets grows; normals count for less
  kNearer,       ///< and everything is within nearer_mm
};

/// Holds the complex, the reference, and the places of the triangles. After every accepted edit the complex
/// is free of self-intersections and within the envelope, if it was so before.
class ComplexEditor {
 public:
  /// Both complexes have the same table of sides.
  ComplexEditor(ComplexMesh mesh, const ComplexMesh& reference, const Correspondence& correspondence,
                const SizingField& sizing);

  EditLimits limits;

  const ComplexMesh& mesh() const { return mesh_; }
  const ReferenceSurface& reference() const { return reference_; }
  const ReverseEnvelope& samples() const { return samples_; }
  const Eigen::Vector3d& normal(std::uint32_t t) const { return normals_[t]; }
  /// Target edge length at a vertex.
  double size(std::uint32_t v) const { return std::max(floor_, sizes_[v]); }
  /// Makes every target edge length as large as the largest.
  void set_coarsest(bool on) { floor_ = on ? *std::max_element(sizes_.begin(), sizes_.end()) : 0; }
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
  /// New cells for the search for near triangles.
  void set_cell(double cell_mm) { hash_.emplace(mesh_, cell_mm); }

  std::uint32_t add_vertex(const Eigen::Vector3d& p, Stratum stratum, std::uint32_t hint);
  void drop_last_vertex();
  /// `hint` replaces that of the moved vertex.
  bool attempt(const Edit& edit, Demand demand, std::uint32_t hint = kNone);
  /// Changes attempted so far.
  std::uint32_t attempts() const { return attempt_; }
  /// The last attempt that changed triangles of v, or ended a trial that did; 0 if none. Edits that were
  /// taken back do not count.
  std::uint32_t changed_at(std::uint32_t v) const { return v < changed_at_.size() ? changed_at_[v] : 0; }
  /// The same of edits that were taken back, too: these may leave samples of the reference elsewhere.
  std::uint32_t touched_at(std::uint32_t v) const { return v < touched_at_.size() ? touched_at_[v] : 0; }
  /// From here on edits can be taken back, until keep_trial() or undo_trial().
  void begin_trial();
  void keep_trial();
  /// Takes back all edits accepted since begin_trial(); vertices that were added stay, without triangles.
  void undo_trial();
  /// Cosine of the smallest planar angle of the triangles that the trial replaced.
  double trial_cosine_before() const { return trial_cosine_; }
  /// Triangles that the trial made, each at least once.
  template <class Visit>
  void for_trial_triangles(Visit&& visit) const {
    for (const Accepted& step : trial_)
      for (const std::uint32_t t : step.back.removed)
        if (mesh_.alive(t)) visit(t);
  }
  /// Squared distance if nothing of the reference is known to be near.
  static constexpr double kNowhere = 1e300;
  /// Where a triangle is farthest from the reference, or a sample hosted by it or its curve edges is farthest
  /// from it.
  struct Deviation {
    double distance2 = 0;
    Eigen::Vector3d toward = Eigen::Vector3d::Zero();   ///< from the triangle to the reference
    Eigen::Vector3d weights = Eigen::Vector3d::Zero();  ///< barycentric weights of the place on the triangle
  };
  /// Of different triangles on different threads after make_room_for_deviations(), while nothing changes.
  Deviation farthest(std::uint32_t t) const;
  void make_room_for_deviations() const;
  /// Whether the triangle lies inside a sheet that is not folded there and hosts samples for most of its
  /// area, none farther than `reach_mm`.
  bool well_sampled(std::uint32_t t, double reach_mm) const;
  /// Counts a refusal that was found before the edit was described in full.
  bool refuse(Refusal refusal) {
    ++refusals_[static_cast<std::size_t>(refusal)];
    return false;
  }
  std::uint64_t refusals(Refusal refusal) const { return refusals_[static_cast<std::size_t>(refusal)]; }
  std::uint64_t violations() const { return violations_; }

 private:
  inline static const Deviation kUnknown{-1, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};

  void look_at_old(const Edit& edit);
  Refusal check(const Edit& edit, const Eigen::Vector3d& before);
  Refusal check_shapes(const Edit& edit);
  Refusal check_envelope(const Edit& edit) const;
  const Deviation& farthest_point_of(std::uint32_t t, const Corners& p) const;
  std::vector<std::uint32_t> samples_of(std::uint32_t t) const;
  bool is_folded(std::uint32_t t) const;
  void look_between_samples(std::uint32_t t, const Corners& p, Deviation& worst) const;
  void look_from(const Eigen::Vector3d& at, std::uint32_t t, const Corners& p, Deviation& worst) const;
  std::uint32_t nearest_hint(const Facet& facet, const Corners& p) const;
  Deviation farthest_point(const Facet& facet, const Corners& p, std::uint32_t moved, double lattice_mm,
                           double content2, std::uint32_t hint, double enough2 = 0,
                           std::span<const std::uint32_t> more_hints = {}) const;
  void find_near(const Edit& edit);
  Refusal check_contacts(const Edit& edit);
  Refusal check_delaunay(const Edit& edit, const Eigen::Vector3d& before);
  void gather_near_vertices(const Edit& edit);
  bool all_have_balls(const Edit& edit) const;
  bool has_ball(const Triangle& corners, GabrielBalls balls) const;
  double least_target(const Edit& edit) const;
  Refusal check_pair(const Facet& facet, std::size_t i, const Triangle& other, const Corners& corners,
                     const Eigen::Vector3d& normal, PairId pair, bool boxes_meet);
  bool closes_tetrahedron(std::uint32_t u, std::uint32_t w, std::uint32_t x, std::uint32_t y) const;
  bool on_curves(std::uint32_t u, std::uint32_t w) const {
    return mesh_.stratum(u) != Stratum::kSurface && mesh_.stratum(w) != Stratum::kSurface;
  }
  bool fold_allowed(std::uint32_t u, std::uint32_t w, double cosine);
  double old_fold(bool junction) const;
  bool gap_allowed(std::size_t i, const Corners& corners, const Eigen::Vector3d& normal, bool same_pair);
  bool is_removed(std::uint32_t t) const { return t < removed_in_.size() && removed_in_[t] == attempt_; }
  void remember(const Edit& edit, const Eigen::Vector3d& before);
  void commit(const Edit& edit, bool backwards);
  void place(const Edit& edit, std::size_t i);
  void note_changed(const std::vector<std::uint32_t>& triangles);
  void note_touched(const std::vector<std::uint32_t>& triangles);

  ComplexMesh mesh_;
  ReferenceSurface reference_;
  ReverseEnvelope samples_;
  std::optional<TriangleHash> hash_;
  const SizingField& sizing_;
  double floor_ = 0;
  std::vector<double> sizes_;
  std::vector<std::uint32_t> hints_, changed_at_, touched_at_;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<GabrielBalls> balls_;  ///< by slot, before other vertices are considered
  std::array<std::uint64_t, kRefusalCount> refusals_{};
  std::optional<IntersectionVerifier> verifier_;
  std::uint64_t violations_ = 0;
  /// By slot: deviations of the present triangles, found with this lattice spacing; distance2 < 0 if not
  /// known.
  mutable std::vector<Deviation> deviations_;
  mutable double deviations_lattice_mm_ = 0;

  // State of the current edit.
  const Edit* edit_ = nullptr;
  Demand demand_ = Demand::kAllowed;
  std::uint32_t attempt_ = 0;
  std::vector<std::uint32_t> removed_in_;  ///< by triangle: the attempt that would remove it
  std::vector<Corners> old_corners_, new_corners_;
  std::vector<Eigen::Vector3d> old_normals_, new_normals_;
  std::vector<FloatBox> new_boxes_, wide_boxes_;
  double gap_mm_ = 0, gap_growth_ = 1, reach_mm_ = 0;
  std::vector<std::uint32_t> near_, slots_, near_vertices_;
  std::vector<std::uint32_t> met_in_;  ///< by vertex: the last attempt in which it was near
  std::vector<Eigen::Vector3d> near_points_;

  /// Everything needed to take an accepted edit back.
  struct Accepted {
    Edit back;
    std::vector<Deviation> deviations;  ///< of the triangles that it adds, if known
    double size = 0;                    ///< target edge length of the moved vertex
    std::uint32_t hint = kNone;
  };
  std::vector<Accepted> trial_;
  double trial_cosine_ = -1;
  std::uint32_t trial_number_ = 0;
  std::vector<std::uint32_t> placed_in_;  ///< by triangle: the trial that put it there
  bool trying_ = false;
};

}  // namespace voxtet::remesh
