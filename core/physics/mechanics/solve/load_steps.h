// A body in balance with loads that grow in steps.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "physics/fem/fixed_order.h"
#include "physics/mechanics/elements/body.h"
#include "physics/mechanics/loads/surface.h"
#include "physics/mechanics/solve/tangent_solver.h"
#include "types/result.h"

namespace voxtet::mechanics {

/// A pressure that stays at right angles to a surface however it is deformed, and pushes against its normals.
struct Pressure {
  Surface surface;
  double kpa = 0;
};

/// Springs, of the same stiffness at all loads: see Surface::add_springs.
struct Springs {
  Surface surface;
  double normal_kpa_per_mm = 0, tangential_kpa_per_mm = 0;
};

/// What acts on a body at full load.
struct Loads {
  std::vector<Pressure> pressures;
  std::vector<Springs> springs;
  std::vector<double> tension_kpa;  ///< active stress, by tetrahedron; empty: none
};

struct NewtonParams {
  int steps = 10;            ///< in which the load grows, at first
  int most_iterations = 15;  ///< of a step, before it is halved
  int most_halvings = 8;     ///< of the length of a step
  double tolerance = 1e-7;   ///< of the force out of balance, over the largest that there was so far
};

/// Newton's method on the exact tangent, with a line search: a step along its direction is halved while it
/// inverts a tetrahedron or leaves more force along that direction than there was. Where it finds no balance,
/// the step of the load is halved too; after one that took few iterations the next is twice as long again.
/// Between two steps of the load it is a value that its caller may leave.
class LoadSteps {
 public:
  /// `held`: of each unknown of Body, whether it keeps what it has in `start`; empty `start`: 0. Returns
  /// kInternal for lists of the wrong length. The body must outlive it.
  static Result<LoadSteps> start(const Body& body, Loads loads, std::vector<bool> held,
                                 const NewtonParams& params, Eigen::VectorXd start = {});

  /// The next step of the load; true when all of it is on. Returns kMeshing, naming the load, when the
  /// shortest step has no balance, with the reason of the last attempt; state is then that of the step
  /// before.
  Result<bool> advance();

  double load() const { return load_; }                       ///< 0 to 1
  const Eigen::VectorXd& displacement() const { return u_; }  ///< all unknowns of Body
  int iterations() const { return iterations_; }              ///< of Newton's method, so far
  int factorisations() const { return solver_.factorisations(); }

 private:
  LoadSteps() = default;
  /// The force that is out of balance, 0 on held unknowns, and the size of its parts.
  struct Imbalance {
    Eigen::VectorXd force;
    double scale = 0;
  };
  /// With `tangent`, also its derivative by u, into tangent_.
  Result<Imbalance> imbalance(const Eigen::VectorXd& u, double load, bool tangent);
  void foretell(Eigen::VectorXd& u, double load);
  /// Moves u to where the load is balanced, and returns how many iterations it took.
  Result<int> balance(Eigen::VectorXd& u, double load);
  /// What a force does along a change. Pressures count the other way, for their energy is greatest in
  /// balance: of Newton's change it is then always negative if displacements are stable.
  double work(const Eigen::VectorXd& force, const Eigen::VectorXd& change) const;
  Status search_line(Eigen::VectorXd& u, const Eigen::VectorXd& change, double load, double at_first);

  const Body* body_ = nullptr;
  Loads loads_;
  std::vector<bool> held_;
  NewtonParams params_;
  double load_ = 0, step_ = 1;
  double scale_ = 0;  ///< the largest force so far
  int iterations_ = 0;
  Eigen::VectorXd u_, rate_;  ///< displacement, and its change in the last step over that of the load
  fem::SparseMatrix tangent_, springs_;  ///< springs_ is empty where there are none
  TangentSolver solver_;
};

}  // namespace voxtet::mechanics
