// A heart that beats: an elastic body in motion, coupled with the blood in its cavities.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "physics/cavities/enclosure.h"
#include "physics/circulation/lumped_circulation.h"
#include "physics/fem/fixed_order.h"
#include "physics/mechanics/elements/body.h"
#include "physics/mechanics/solve/tangent_solver.h"
#include "types/result.h"

namespace voxtet::beat {

/// What moves, and what makes it move. Lengths in mm, forces in mN = kPa mm^2.
struct Heart {
  mechanics::Body body;
  /// Of the pattern of Body::empty_tangent(): consistent mass (kg), springs (mN/mm) and dampers (mN s/mm)
  /// outside of the body. They act on the displacements.
  fem::SparseMatrix mass, springs, dampers;
  std::vector<Enclosure> cavities;
  /// Active stress of each tetrahedron along its fibre at a time, kPa; null: none.
  std::function<std::vector<double>(double time_s)> tension_kpa;
  /// Pressures in the cavities where they are given and not found: all times where there is no circulation,
  /// else those before 0, while the heart is filled.
  std::function<Eigen::VectorXd(double time_s)> given_kpa;
  std::unique_ptr<const LumpedCirculation> circulation;  ///< of as many cavities; null: none
};

struct HeartMotion {
  double time_s = 0;
  Eigen::VectorXd u, velocity, acceleration;  ///< of the unknowns of Body; mm, mm/s, mm/s^2
  Eigen::VectorXd cavity_kpa, cavity_ml;
  Eigen::VectorXd circulation;  ///< its states
};

struct HeartStepParams {
  double step_s = 5e-3;
  int most_iterations = 12;  ///< of Newton's method in a step, before it is halved
  int most_halvings = 7;
  /// Of forces out of balance over the largest that there was, and of volumes that do not add up over the
  /// cavity's.
  double tolerance = 1e-5;
};

/// Newmark's method in time (gamma 0.6, beta 0.3025: it damps what is faster than a step), backward Euler for
/// the circulation; each step is solved by Newton's method for displacements and pressures together, with the
/// exact tangent. Where Newton's method finds no solution the step is halved; after easy ones it is doubled
/// again. All steps are the longest one, halved so often, and end at multiples of their length, so that
/// multiples of the longest one are always among the times.
///
/// Newmark, "A method of computation for structural dynamics", Journal of the Engineering Mechanics Division
/// 85 (1959).
class HeartSteps {
 public:
  /// `start`: displacements, velocities and accelerations may be empty, 0; the states of the circulation are
  /// needed. `start.time_s` is a multiple of the step. Returns kInternal for lists of the wrong length, and
  /// the errors of Body::add_forces.
  static Result<HeartSteps> start(std::shared_ptr<const Heart> heart, HeartMotion start,
                                  const HeartStepParams& params);

  /// One iteration of Newton's method; true when a step is complete. Returns kMeshing, with time and place,
  /// where the shortest step has no solution; the state stays that of the step before.
  Result<bool> advance();

  /// All that the steps that follow depend on. Solvers start afresh when it is taken, so that a run that is
  /// given it goes on with the same bytes as the one that it is of.
  struct State {
    HeartMotion motion;
    std::int64_t tick = 0, length = 0;  ///< in the shortest steps
    double force_scale = 0;
    std::int32_t steps = 0, iterations = 0;
  };
  State take_state();
  /// Returns kUsage for the state of another body.
  Status restore(State state);

  const HeartMotion& now() const { return now_; }  ///< after the last complete step
  double step_s() const { return step_s(length_); }
  int steps() const { return steps_; }
  int newton_iterations() const { return iterations_; }
  int linear_iterations() const { return solver_.iterations(); }
  int factorisations() const { return solver_.factorisations(); }

 private:
  HeartSteps() = default;

  /// The end of the step as it is tried, and what is wrong with it.
  struct Trial {
    HeartMotion motion;
    Eigen::VectorXd force;               ///< out of balance, mN
    Eigen::VectorXd excess_ml;           ///< what a cavity has too much; empty where pressures are given
    Eigen::MatrixXd inflow_by_pressure;  ///< ml/s/kPa
    double scale = 0;                    ///< of the forces, mN
    double error = 0;                    ///< the largest of both, over what is tolerated
  };
  struct Newmark {
    double by_u_velocity, by_u_acceleration;
  };

  double step_s(std::int64_t length) const;
  double time_s(std::int64_t tick) const;
  Newmark newmark() const;
  bool coupled() const;
  void begin_step();
  /// Makes velocities, volumes, states and errors of what is tried from its u and pressures. With `tangent`,
  /// also the derivative of the force by u, into tangent_.
  Status complete(Trial& trial, bool tangent);
  Result<bool> iterate();
  void accept();

  std::shared_ptr<const Heart> heart_;
  HeartStepParams params_;
  HeartMotion now_;
  std::int64_t tick_ = 0, length_ = 1;  ///< of the shortest step's length
  std::optional<Trial> trial_;
  std::vector<double> tension_;  ///< at the end of the step
  double force_scale_ = 0;       ///< in the last step
  int tried_ = 0, steps_ = 0, iterations_ = 0;
  fem::SparseMatrix tangent_;
  mechanics::TangentSolver solver_;
};

}  // namespace voxtet::beat
