// Heat that spreads from a label: a small example of a result that changes with time.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "physics/fem/fixed_order.h"
#include "physics/fem/solve_pcg.h"
#include "physics/fem/time_steps.h"
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
/// caller advances the computation in short parts, and may leave it at any time.
class Diffusion {
 public:
  /// Time 0. Returns kUsage, naming the field (physics.diffusion.from), for a parameter out of its range, a
  /// label that no tetrahedron has, and more than a million steps. The mesh is held until its matrices are
  /// made.
  static Result<Diffusion> start(std::shared_ptr<const TetMesh> mesh, const DiffusionParams& params);

  bool done() const { return steps_.done(); }
  double fraction() const { return steps_.fraction(); }  ///< 0 to 1
  double time_ms() const { return steps_.time_ms(); }
  /// Whether temperature() is a frame to show.
  bool frame_due() const { return steps_.frame_due(); }

  /// Works on the next step with at most so many iterations of its solver, in the first calls on its
  /// matrices; true when the step is complete, and with it time_ms() and temperature() are the new ones.
  /// However it is cut, its bytes are the same. May only be called when not done(). Returns errors of
  /// PcgSolve, after which the state is that of the step before, and of add_stiffness().
  Result<bool> advance(int iterations);

  /// Iterations that take some milliseconds: the fewer, the larger the mesh; at least one.
  int short_part() const;

  /// u at the points, without unit.
  Field temperature() const;

 private:
  Diffusion() = default;
  Status prepare();
  Status start_solve();

  std::shared_ptr<const TetMesh> mesh_;  ///< null when the matrices are made
  double step_diffusivity_ = 0;          ///< step times D, mm^2
  fem::TimeSteps steps_;
  std::vector<bool> held_;                ///< by point
  fem::SparseMatrix step_stiffness_;      ///< step times D times stiffness, mm^3
  fem::SparseMatrix system_;              ///< mass + step_stiffness_ with points held, mm^3
  Eigen::VectorXd temperature_, change_;  ///< now, and by the last step
  std::optional<fem::PcgSolve> solve_;    ///< of the change by the step under way
};

}  // namespace voxtet
