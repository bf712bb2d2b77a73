// Split, collapse, flip and relocate: each describes an Edit and lets the editor decide.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "remesh/editor/complex_editor.h"
#include "remesh/editor/planned_edits.h"
#include "remesh/motion/tangential_relaxation.h"

namespace voxtet::remesh {

/// Botsch and Kobbelt, "A remeshing approach to multiresolution modeling", 2004, on a non-manifold complex.
class LocalOperations {
 public:
  explicit LocalOperations(ComplexEditor& editor)
      : offsets(editor.mesh().sides().size(), 0), editor_(editor) {}

  double shape_weight = 0.7;
  std::vector<double> offsets;  ///< by pair of labels: normal offset of its sheets from the reference, mm
  std::array<std::uint64_t, 4> accepted{};  ///< splits, collapses, flips, relocations

  /// Puts a new vertex in the middle of the edge, on the reference.
  bool split(std::uint32_t a, std::uint32_t b, Demand demand = Demand::kAllowed);
  /// Moves a to b, or both to their middle if a may move there. No edge becomes longer than `longest` target
  /// lengths, or than it was before.
  bool collapse(std::uint32_t a, std::uint32_t b, double longest, Demand demand = Demand::kAllowed);
  bool flip(std::uint32_t a, std::uint32_t b, Demand demand);
  /// `plan`: what plan_relocation() found, if it still holds.
  bool relocate(std::uint32_t v, const PlannedEdit* plan = nullptr);
  /// What relocate(v) would do now.
  void plan_relocation(std::uint32_t v, EditCheck& check, PlannedEdit& plan) const;
  /// Moves v by a vector, without projecting it onto the reference.
  bool shift(std::uint32_t v, const Eigen::Vector3d& by, Demand demand);
  /// Moves v to help the poorest triangles first, in smaller and smaller steps until the demand is met.
  bool open(std::uint32_t v, Demand demand);

  /// By how much a flip of the edge would bring the valences nearer to six; vertices on curves do not count.
  int valence_gain(std::uint32_t a, std::uint32_t b) const;
  /// Neighbours of v, each once.
  const std::vector<std::uint32_t>& neighbours(std::uint32_t v);

 private:
  bool collapse_onto(std::uint32_t a, std::uint32_t b, double longest, Demand demand);
  bool merge(std::uint32_t a, std::uint32_t b, double longest, Demand demand);
  void describe_collapse(std::uint32_t a, std::uint32_t b);
  bool link_allows(std::uint32_t a, std::uint32_t b);
  bool link_edges_apart(std::uint32_t a, std::uint32_t b) const;
  bool split_at(std::uint32_t a, std::uint32_t b, const Eigen::Vector3d& p, std::uint32_t hint, bool curve,
                Demand demand);
  void describe_move(std::uint32_t v, const Eigen::Vector3d& to, Edit& edit) const;
  bool attempt_move(Demand demand, std::uint32_t hint);
  std::uint32_t other_curve_end(std::uint32_t v, std::uint32_t not_this) const;
  bool move(std::uint32_t v, Demand demand, double step);
  bool plan_move(std::uint32_t v, Demand demand, double step, Edit& edit, std::uint32_t& hint) const;
  Eigen::Vector3d surface_target(std::uint32_t v, Demand demand, double step, std::uint32_t& hint) const;
  double target_area(const Triangle& t) const;
  Eigen::Vector3d curve_target(std::uint32_t v, std::uint32_t p, std::uint32_t q, double step,
                               std::uint32_t& hint) const;
  Eigen::Vector3d fit_height(std::uint32_t v, const Eigen::Vector3d& at, const Eigen::Vector3d& normal,
                             std::uint32_t& hint) const;
  bool mark(std::uint32_t v) { return marks_[v] != round_ ? (marks_[v] = round_, true) : false; }

  ComplexEditor& editor_;
  Edit edit_;
  std::vector<std::uint32_t> marks_;
  std::uint32_t round_ = 0;
  std::vector<std::uint32_t> around_;
};

}  // namespace voxtet::remesh
