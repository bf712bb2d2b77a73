// Heat that spreads from a label: a small example of a result that changes with time.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "physics/fem/fixed_order.h"
#include "types/field.h"
#include "types/result.h"
#include "types/tet_mesh.h"

namespace voxtet {

struct DiffusionParams {
  Label from = 1;  ///< its tetrahedra's points are held at 1, all others start at 0
  double diffusivity_mm2_per_ms = 1;
  double end_ms = 100;
  double step_ms = 1;   ///< shortened if needed, so that `end_ms` is a whole number of steps
  double frame_ms = 5;  ///< time between frames
};

/// The equation du/dt = D div grad u with no flow through the outer surface, on linear elements with
/// consistent mass, by backward Euler (Quarteroni and Valli, "Numerical Approximation of Partial Differential
/// Equations", 1994, chapter 11): second order in the edge length h, first in the step. With steps shorter
/// than about h^2 / D, u falls some hundredths below 0 for a while near `from`; this comes from the
/// consistent mass (Thomee, "Galerkin Finite Element Methods for Parabolic Problems", 2006, chapter 15). The
/// caller advances the computation step by step, and may stop at any time.
class Diffusion {
 public:
  /// Time 0. Returns kUsage, naming the field (physics.diffusion.from), for a parameter out of its range, a
  /// label that no tetrahedron has, and more than a million steps; errors of assemble_stiffness(). The mesh
  /// is not needed afterwards.
  static Result<Diffusion> start(const TetMesh& mesh, const DiffusionParams& params);

  bool done() const { return step_ == steps_; }
  double fraction() const { return static_cast<double>(step_) / steps_; }  ///< 0 to 1
  double time_ms() const { return step_ms_ * step_; }
  /// Whether temperature() is a frame to show: at 0, at the first step that reaches each multiple of
  /// `frame_ms`, and at the end.
  bool frame_due() const;

  /// Advances by one step; may only be called when not done(). Returns errors of solve_pcg(), after which the
  /// state is that of the step before.
  Status step();

  /// u at the points, without unit.
  Field temperature() const;

 private:
  Diffusion() = default;

  int step_ = 0, steps_ = 0;
  double step_ms_ = 0, frame_ms_ = 0;
  std::vector<bool> held_;                ///< by point
  fem::SparseMatrix step_stiffness_;      ///< step times D times stiffness, mm^3
  fem::SparseMatrix system_;              ///< mass + step_stiffness_ with points held, mm^3
  Eigen::VectorXd temperature_, change_;  ///< now, and by the last step
};

}  // namespace voxtet
