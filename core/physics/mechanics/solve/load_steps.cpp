#include "physics/mechanics/solve/load_steps.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>

#include "physics/fem/hold_points.h"

namespace voxtet::mechanics {
namespace {

constexpr int kLineHalvings = 10;
/// A step that took no more iterations is followed by one of twice the length.
constexpr int kFewIterations = 5;
/// Of the linear equations in Newton's method.
constexpr double kLinearTolerance = 1e-8;

std::string percent(double part) {
  std::ostringstream text;
  text << 100 * part << " %";
  return text.str();
}

}  // namespace

Result<LoadSteps> LoadSteps::start(const Body& body, Loads loads, std::vector<bool> held,
                                   const NewtonParams& params, Eigen::VectorXd start) {
  if (held.size() != static_cast<std::size_t>(body.unknowns()))
    return wrong_length("held", held.size(), body.unknowns());
  if (start.size() == 0) start = Eigen::VectorXd::Zero(body.unknowns());
  if (start.size() != body.unknowns()) return wrong_length("start", start.size(), body.unknowns());
  if (params.steps < 1)
    return usage_error(kMechanicsStage,
                       "steps: found " + std::to_string(params.steps) + ", expected at least 1");
  LoadSteps out;
  out.body_ = &body;
  out.loads_ = std::move(loads);
  out.held_ = std::move(held);
  out.params_ = params;
  out.step_ = 1.0 / params.steps;
  out.u_ = std::move(start);
  out.tangent_ = body.empty_tangent();
  if (!out.loads_.springs.empty()) out.springs_ = out.tangent_;
  for (const Springs& springs : out.loads_.springs)
    springs.surface.add_springs(body.nodes(), springs.normal_kpa_per_mm, springs.tangential_kpa_per_mm,
                                out.springs_);
  return out;
}

Result<LoadSteps::Imbalance> LoadSteps::imbalance(const Eigen::VectorXd& u, double load, bool tangent) {
  Imbalance out{Eigen::VectorXd::Zero(u.size())};
  if (tangent) std::fill_n(tangent_.valuePtr(), tangent_.nonZeros(), 0.0);
  std::vector<double> tension = loads_.tension_kpa;
  for (double& kpa : tension) kpa *= load;
  if (Status added = body_->add_forces(u, tension, out.force, tangent ? &tangent_ : nullptr); !added)
    return added.error();
  if (springs_.rows() > 0) {
    Eigen::VectorXd pull;
    fem::multiply(springs_, u, pull);
    out.force += pull;
    if (tangent)
      for (Eigen::Index i = 0; i < tangent_.nonZeros(); ++i) tangent_.valuePtr()[i] += springs_.valuePtr()[i];
  }
  out.scale = out.force.norm();
  const Eigen::VectorXd x = body_->nodes().places_after(u);
  for (const Pressure& pressure : loads_.pressures) {
    pressure.surface.add_area_vectors(x, load * pressure.kpa, out.force);
    if (tangent) pressure.surface.add_area_tangent(x, load * pressure.kpa, tangent_);
  }
  out.scale = std::max(out.scale, out.force.norm());
  for (std::size_t i = 0; i < held_.size(); ++i)
    if (held_[i]) out.force[static_cast<Eigen::Index>(i)] = 0;
  if (tangent) fem::hold_points(tangent_, held_);
  return out;
}

double LoadSteps::work(const Eigen::VectorXd& force, const Eigen::VectorXd& change) const {
  double sum = 0;
  for (Eigen::Index i = 0; i < force.size(); ++i)
    sum += (i < body_->displacements() ? force[i] : -force[i]) * change[i];
  return sum;
}

Status LoadSteps::search_line(Eigen::VectorXd& u, const Eigen::VectorXd& change, double load,
                              double at_first) {
  std::string reason;
  ErrorPlace where;
  double part = 1;
  for (int i = 0; i <= kLineHalvings; ++i, part /= 2) {
    const Eigen::VectorXd tried = u + part * change;
    const Result<Imbalance> there = imbalance(tried, load, false);
    if (!there) {
      reason = there.error().message;
      where = there.error().where;
    } else if (std::abs(work(there->force, change)) <= std::abs(at_first)) {
      u = tried;
      return std::monostate{};
    } else {
      reason = "no step along Newton's direction leaves less force";
      where = {};
    }
  }
  return Error{ErrorCode::kMeshing, kMechanicsStage, reason, where};
}

Result<int> LoadSteps::balance(Eigen::VectorXd& u, double load) {
  double left = 0;
  for (int iteration = 0; iteration < params_.most_iterations; ++iteration) {
    const Result<Imbalance> now = imbalance(u, load, true);
    if (!now) return now.error();
    scale_ = std::max(scale_, now->scale);
    left = scale_ > 0 ? now->force.norm() / scale_ : 0;
    if (left <= params_.tolerance) return iteration;
    ++iterations_;
    const Result<Eigen::VectorXd> change = solver_.solve(tangent_, -now->force, kLinearTolerance);
    if (!change) return change.error();
    if (Status found = search_line(u, *change, load, work(now->force, *change)); !found) return found.error();
  }
  std::ostringstream text;
  text << "after " << params_.most_iterations << " iterations " << left
       << " of the force is out of balance, expected at most " << params_.tolerance;
  return Error{ErrorCode::kMeshing, kMechanicsStage, text.str(), {}};
}

/// Moves u onwards as in the step before, as far as that leaves less force along the way; else it stays.
void LoadSteps::foretell(Eigen::VectorXd& u, double load) {
  const Eigen::VectorXd change = (load - load_) * rate_;
  if (const Result<Imbalance> now = imbalance(u, load, false))
    search_line(u, change, load, work(now->force, change));
}

Result<bool> LoadSteps::advance() {
  const double shortest = std::ldexp(1.0 / params_.steps, -params_.most_halvings);
  while (true) {
    // The last step ends at 1 exactly, and leaves no sliver before it.
    const double load = load_ + step_ * (1 + 1e-9) >= 1 ? 1 : load_ + step_;
    Eigen::VectorXd u = u_;
    if (rate_.size() > 0) foretell(u, load);
    const Result<int> took = balance(u, load);
    if (took) {
      rate_ = (u - u_) / (load - load_);
      u_ = std::move(u);
      load_ = load;
      if (*took <= kFewIterations) step_ = std::min(2 * step_, 1.0 / params_.steps);
      return load_ == 1;
    }
    const bool may_be_shorter = took.error().code == ErrorCode::kMeshing && step_ / 2 >= shortest;
    if (!may_be_shorter) {
      Error error = took.error();
      error.message = "no balance with " + percent(load) + " of the load, after one with " + percent(load_) +
                      ": " + error.message;
      return error;
    }
    step_ /= 2;
  }
}

}  // namespace voxtet::mechanics
