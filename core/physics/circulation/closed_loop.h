// The closed loop of systemic and pulmonary circulation with both atria, to which two ventricles belong.
// Regazzoni, Salvador, Africa, Fedele, Dede' and Quarteroni, "A cardiac electromechanical model coupled with
// a lumped-parameter model for closed-loop blood circulation", Journal of Computational Physics 457 (2022).
#pragma once

#include "physics/circulation/elastance.h"
#include "physics/circulation/lumped_circulation.h"
#include "physics/circulation/valve.h"

namespace voxtet {

/// Arteries or veins: C dp/dt = Q_in - Q, L dQ/dt = p - p_next - R Q.
struct Vessels {
  double resistance_kpa_s_per_ml;
  double compliance_ml_per_kpa;
  double inertance_kpa_s2_per_ml;
};

struct ClosedLoopParams {
  double period_s;
  Elastance left_atrium, right_atrium;
  Valve mitral, aortic, tricuspid, pulmonary;
  Vessels systemic_arteries, systemic_veins, pulmonary_arteries, pulmonary_veins;
};

/// Indices of the closed loop's states. Cavity 0 is the left ventricle, 1 the right one.
namespace loop {
enum State {
  kLeftAtrium,        ///< ml
  kRightAtrium,       ///< ml
  kSystemicArteries,  ///< kPa, to kPulmonaryVeins
  kSystemicVeins,
  kPulmonaryArteries,
  kPulmonaryVeins,
  kSystemicArterialFlow,  ///< ml/s, to kPulmonaryVenousFlow
  kSystemicVenousFlow,
  kPulmonaryArterialFlow,
  kPulmonaryVenousFlow,
  kStates
};
}  // namespace loop

class ClosedLoop : public LumpedCirculation {
 public:
  explicit ClosedLoop(const ClosedLoopParams& params) : params_(params) {}

  std::vector<std::string_view> state_names() const override;
  int cavities() const override { return 2; }
  CirculationRates rates(double time_s, const Eigen::VectorXd& states,
                         const Eigen::VectorXd& cavity_kpa) const override;

  const ClosedLoopParams& params() const { return params_; }
  /// Blood in the vessels and atria, ml; with what is in the ventricles it does not change.
  double blood_ml(const Eigen::VectorXd& states) const;

 private:
  ClosedLoopParams params_;
};

/// A loop, the ventricles that it was made for where no mesh is, and the state in which a beat begins.
struct ClosedLoopHeart {
  ClosedLoopParams loop;
  Elastance left_ventricle, right_ventricle;
  Eigen::VectorXd states;  ///< of the loop
  Eigen::Vector2d ventricles_ml;
};

/// The parameters of Regazzoni et al. as the program "circulation" (ComputationalPhysiology) has them, and
/// the state to which its beats return, at 75 beats a minute.
ClosedLoopHeart regazzoni_heart();

}  // namespace voxtet
