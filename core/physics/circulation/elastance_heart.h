// A circulation driven by ventricles that are elastances, where there is no mesh; coupled just as a mesh is.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "physics/circulation/closed_loop.h"
#include "physics/circulation/elastance.h"
#include "physics/circulation/lumped_circulation.h"
#include "physics/circulation/ventricle_beat.h"
#include "types/result.h"

namespace voxtet {

struct HeartState {
  double time_s = 0;
  Eigen::VectorXd circulation;  ///< its states
  Eigen::VectorXd cavity_ml;    ///< an entry for each cavity
  Eigen::VectorXd cavity_kpa;   ///< the pressures that belong to them
};

/// One step of backward Euler for heart and circulation together: Newton's method for the pressures of all
/// cavities at its end. `chambers` has an entry for each of them. Returns kInternal where it does not
/// converge.
Result<HeartState> step_heart(const LumpedCirculation& circulation, const std::vector<Elastance>& chambers,
                              double period_s, const HeartState& state, double step_s);

struct HeartBeat {
  HeartState end;
  std::vector<VentricleBeat> cavities;
};

/// A whole beat in so many steps.
Result<HeartBeat> beat_heart(const LumpedCirculation& circulation, const std::vector<Elastance>& chambers,
                             double period_s, const HeartState& state, int steps);

/// The start of a heart's beat.
HeartState start_of(const ClosedLoopHeart& heart);

}  // namespace voxtet
