// Whether an edit of a complex is allowed.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "remesh/complex/edit.h"
#include "remesh/complex/triangle_hash.h"
#include "remesh/editor/edited_complex.h"
#include "remesh/envelope/reverse_envelope.h"

namespace voxtet::remesh {

/// EditLimits::turn_cosine for the removal of slivers, whose normals say little.
inline constexpr double kTurnCosineOfSlivers = -0.3;

enum class Demand : std::uint8_t {
  kAllowed,      ///< every limit holds, or what breaks it is no worse than before
  kBetterAngle,  ///< and the smallest planar angle grows; normals count for less
  kBetterFold,   ///< and the sharpest angle between facets grows; normals count for less
  kNearer,       ///< and everything is within nearer_mm
};

/// What a check found, enough to carry the edit out. Vectors keep their memory from check to check.
struct EditFindings {
  Refusal refusal = Refusal::kNo;
  std::vector<Corners> old_corners, new_corners;          ///< of the facets removed and added
  std::vector<Eigen::Vector3d> old_normals, new_normals;  ///< unit length
  Rehosting rehosting;
  /// Of removed triangles, found on the way.
  std::vector<std::pair<std::uint32_t, Deviation>> deviations;
  /// The check looked at no triangle, and at no vertex of a triangle, whose box does not meet this one.
  FloatBox zone;
};

/// Checks edits of one complex, one after the other. Changes nothing but its own work memory: while nobody
/// edits the complex, several of these may check edits of it on several threads.
class EditCheck {
 public:
  explicit EditCheck(const EditedComplex& complex) : complex_(complex), limits_(complex.limits) {}

  /// If the edit is refused, the findings hold no more than the reason, deviations and the zone.
  void check(const Edit& edit, Demand demand, EditFindings& found);

 private:
  Refusal find_refusal();
  Refusal check_shapes();
  Refusal check_envelope();
  double distance2_of_removed(std::size_t i);
  void find_near();
  Refusal check_contacts();
  Refusal check_delaunay();
  void gather_near_vertices();
  bool all_have_balls() const;
  bool has_ball(const Triangle& corners, GabrielBalls balls) const;
  double least_target() const;
  Refusal check_pair(const Facet& facet, std::size_t i, const Triangle& other, const Corners& corners,
                     const Eigen::Vector3d& normal, PairId pair, bool boxes_meet) const;
  bool closes_tetrahedron(std::uint32_t u, std::uint32_t w, std::uint32_t x, std::uint32_t y) const;
  bool fold_allowed(std::uint32_t u, std::uint32_t w, double cosine) const;
  double old_fold(bool junction) const;
  bool gap_allowed(std::size_t i, const Corners& corners, const Eigen::Vector3d& normal,
                   bool same_pair) const;
  bool is_removed(std::uint32_t t) const { return t < removed_in_.size() && removed_in_[t] == number_; }

  const EditedComplex& complex_;
  const EditLimits& limits_;

  // Of the current check.
  const Edit* edit_ = nullptr;
  EditFindings* found_ = nullptr;
  Demand demand_ = Demand::kAllowed;
  double gap_mm_ = 0, gap_growth_ = 1, reach_mm_ = 0;
  std::vector<FloatBox> new_boxes_, wide_boxes_;
  std::vector<std::uint32_t> near_, near_vertices_;
  std::vector<Eigen::Vector3d> near_points_;

  std::uint32_t number_ = 0;               ///< of the current check
  std::vector<std::uint32_t> removed_in_;  ///< by triangle: the last check of an edit that would remove it
  std::vector<std::uint32_t> met_in_;      ///< by vertex: the last check in which it was near
  TriangleHash::Search search_;
};

/// Describes the facets that an edit removes.
void look_at_removed(const EditedComplex& complex, const Edit& edit, EditFindings& found);

}  // namespace voxtet::remesh
