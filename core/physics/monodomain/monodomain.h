// The monodomain model: how excitation spreads through tissue.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "physics/fem/fixed_order.h"
#include "physics/fem/solve_pcg.h"
#include "physics/fem/time_steps.h"
#include "physics/monodomain/activation_log.h"
#include "physics/monodomain/cell.h"
#include "physics/monodomain/conducting_mesh.h"
#include "physics/monodomain/electrogram.h"
#include "physics/monodomain/excited_blocks.h"
#include "types/field.h"
#include "types/result.h"
#include "types/stimulus.h"
#include "types/tet_mesh.h"
#include "types/tissue.h"

namespace voxtet {

enum class Integration {
  kExplicit,      ///< forward Euler with lumped mass: a quick look; slow on coarse meshes by some percent
  kSemiImplicit,  ///< backward Euler with half-lumped mass: for results
};

struct MonodomainParams {
  Integration integration = Integration::kSemiImplicit;
  double end_ms = 400;
  double step_ms = 0.05;  ///< shortened if needed, so that `end_ms` is a whole number of steps
  double frame_ms = 5;    ///< time between frames
  /// Semi-implicit: the share of the consistent mass; the rest is lumped. At 0.5 the wave's speed on
  /// unstructured tetrahedra is right within 1 % up to edges of 1.8 mm, in tissue of 0.5 mm/ms (Pathmanathan,
  /// Bernabeu, Niederer, Gavaghan and Kay, Int. J. Numer. Meth. Biomed. Eng. 28, 2012, on mass lumping).
  double consistent_mass = 0.5;
  /// Raises or lowers each tetrahedron's diffusivity so that the wave has its speed on this mesh too, by what
  /// was measured on others (base/wave_speed_error.h).
  bool correct_speed = false;
  std::vector<Electrode> electrodes{};
};

/// The share of the consistent mass that a simulation has.
inline double consistent_mass_of(const MonodomainParams& params) {
  return params.integration == Integration::kExplicit ? 0 : params.consistent_mass;
}

/// Between two steps: all that a run needs to go on as if it had never stopped. Values are of the conducting
/// points.
struct MonodomainState {
  int steps = 0;  ///< that are done
  double step_ms = 0;
  std::vector<double> v, w;
  std::vector<double> change, earlier;  ///< semi-implicit: by the diffusion of the last two steps
  std::vector<ActivationLog::Crossing> activations, repolarisations;
};

/// dv/dt = div(D grad v) + reaction + stimulus, no flow through the tissue's surface, on linear elements; the
/// reaction (cell.h) and the diffusion take turns (Godunov splitting). The caller advances it in short parts,
/// and may leave it at any time. `threads` never changes a result.
class Monodomain {
 public:
  /// Time 0, all tissue at rest. Errors: kUsage, naming the field, for parameters out of range and a stimulus
  /// that no conducting point lies in; those of conducting_mesh().
  static Result<Monodomain> start(const TetMesh& mesh, const Tissue& tissue,
                                  const std::vector<Stimulus>& stimuli, const MonodomainParams& params,
                                  int threads = 1);

  bool done() const { return steps_.done(); }
  double fraction() const { return steps_.fraction(); }
  double time_ms() const { return steps_.time_ms(); }
  double step_ms() const { return steps_.step_ms(); }
  /// Whether now is a frame to show.
  bool frame_due() const { return steps_.frame_due(); }

  /// A short part of the work: a step, or some iterations of its solver, in the first calls on its matrices.
  /// True when a step is complete. However it is cut, its bytes are the same. May only be called when not
  /// done(). Errors: kUsage for an explicit step that is too long to be stable on this mesh; those of fem.
  Result<bool> advance();

  /// Of each point of the whole mesh; NaN where nothing conducts.
  Field voltage() const;
  /// A beat has two fields of its own: 3 MB at 400,000 points.
  static constexpr std::size_t kMostBeats = 20;
  /// `activation_ms`, `repolarisation_ms` and `apd_ms` of the first beat, `last_activation_ms` and
  /// `activations`, how often; then `activation_2_ms`, `repolarisation_2_ms`, `activation_3_ms` ... of each
  /// point's next beats, up to the greatest of `activations`, at most kMostBeats. NaN where there was none.
  std::vector<Field> activation_fields() const;
  const ActivationLog& log() const { return log_; }
  /// Potentials of the electrodes (mV) now, in the order of the parameters.
  std::vector<double> potentials_mv() const;
  /// v of the conducting points, as numbered by points().
  const Eigen::VectorXd& v() const { return v_; }
  const std::vector<std::uint32_t>& points() const { return tissue_.points; }

  /// One more stimulus, whose `start_ms` is a time of the run; one that is over does nothing. Errors as in
  /// start().
  Status stimulate(const Stimulus& stimulus);

  /// Whether no step is under way.
  bool between_steps() const { return !reacted_; }
  /// Needs between_steps().
  MonodomainState state() const;
  /// Goes on from a state of a run on the same mesh and tissue, with the same parameters but for its end; to
  /// be called before the first step. The result is that of one run. Errors: kUsage for a state of other
  /// points or another step, or one that is later than the end.
  Status restore(const MonodomainState& state);

  /// The longest explicit step that is stable, in ms; known once the matrices are made.
  double most_explicit_step_ms() const { return most_step_ms_; }

 private:
  /// Points into which a current flows during some times.
  struct Current {
    std::vector<std::uint32_t> points;
    std::vector<double> starts_ms;
    double duration_ms = 0, strength_per_ms = 0;
  };

  Monodomain() = default;
  Status prepare();
  Status add_current(const Stimulus& stimulus, const std::string& field);
  void set_currents();
  void find_reach();
  void react();
  void diffuse_explicitly();
  Result<bool> diffuse_implicitly();
  void complete_step();
  std::vector<float> on_mesh(const std::vector<float>& of_points, float elsewhere) const;

  MonodomainParams params_;
  int threads_ = 1;
  std::size_t mesh_points_ = 0;
  ConductingMesh tissue_;  ///< its tetrahedra until the matrices are made
  std::vector<CellStep> cells_;
  std::vector<Current> currents_;
  std::vector<double> current_;  ///< of each point now, 1/ms; empty: none anywhere
  std::vector<bool> flows_;      ///< of each of currents_, now

  int prepared_ = 0;  ///< parts of prepare() that are done
  fem::TimeSteps steps_;
  double most_step_ms_ = 0;
  fem::SparseMatrix stiffness_;   ///< K, mm^3/ms; explicit: step M_L^-1 K
  fem::SparseMatrix system_;      ///< semi-implicit: M + step K, mm^3
  Eigen::VectorXd lumped_;        ///< M_L, mm^3
  Eigen::VectorXd v_, w_, next_;  ///< next_: v at the end of the step under way
  Eigen::VectorXd change_;        ///< semi-implicit: by the diffusion of the last step
  Eigen::VectorXd load_;          ///< semi-implicit
  Eigen::VectorXd earlier_;       ///< semi-implicit: by that of the step before it
  bool reacted_ = false;          ///< the reaction of the step under way is done, in next_
  bool solving_ = false;
  ExcitedBlocks excited_;
  std::optional<fem::PcgSolve> solve_;
  std::vector<Eigen::VectorXd> electrode_weights_;
  ActivationLog log_;
};

}  // namespace voxtet
