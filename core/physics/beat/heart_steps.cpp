#include "physics/beat/heart_steps.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>

namespace voxtet::beat {
namespace {

constexpr double kGamma = 0.6, kBeta = 0.3025;
/// Of the linear equations within Newton's method.
constexpr double kLinearTolerance = 1e-3;
constexpr int kLineHalvings = 5;
/// A change is taken back by half where the error grows by more than this.
constexpr double kMostGrowth = 4;
/// A step that took no more iterations is followed by one of twice the length.
constexpr int kEasy = 5;
constexpr double kMm3PerMl = 1000;

Eigen::VectorXd volumes_ml(const Heart& heart, const Eigen::VectorXd& u) {
  const Eigen::VectorXd x = heart.body.nodes().places_after(u);
  Eigen::VectorXd ml(static_cast<Eigen::Index>(heart.cavities.size()));
  for (std::size_t c = 0; c < heart.cavities.size(); ++c)
    ml[static_cast<Eigen::Index>(c)] = heart.cavities[c].volume_mm3(x) / kMm3PerMl;
  return ml;
}

/// Adds a matrix of the same pattern.
void add(double factor, const fem::SparseMatrix& what, fem::SparseMatrix& to) {
  for (Eigen::Index i = 0; i < to.nonZeros(); ++i) to.valuePtr()[i] += factor * what.valuePtr()[i];
}

std::string in_ms(double time_s) {
  std::ostringstream text;
  text << 1000 * time_s << " ms";
  return text.str();
}

}  // namespace

Result<HeartSteps> HeartSteps::start(std::shared_ptr<const Heart> heart, HeartMotion start,
                                     const HeartStepParams& params) {
  const Eigen::Index unknowns = heart->body.unknowns();
  for (Eigen::VectorXd* list : {&start.u, &start.velocity, &start.acceleration}) {
    if (list->size() == 0) *list = Eigen::VectorXd::Zero(unknowns);
    if (list->size() != unknowns) return mechanics::wrong_length("displacements", list->size(), unknowns);
  }
  const auto cavities = static_cast<Eigen::Index>(heart->cavities.size());
  if (heart->circulation) {
    const auto states = static_cast<Eigen::Index>(heart->circulation->state_names().size());
    if (start.circulation.size() != states)
      return mechanics::wrong_length("states of the circulation", start.circulation.size(), states);
    if (heart->circulation->cavities() != cavities)
      return mechanics::wrong_length("cavities", cavities, heart->circulation->cavities());
  }
  if (start.cavity_kpa.size() == 0) start.cavity_kpa = Eigen::VectorXd::Zero(cavities);
  if (start.cavity_kpa.size() != cavities)
    return mechanics::wrong_length("cavity_kpa", start.cavity_kpa.size(), cavities);
  start.cavity_ml = volumes_ml(*heart, start.u);
  HeartSteps out;
  out.length_ = std::int64_t{1} << static_cast<unsigned>(params.most_halvings);
  out.tick_ = std::llround(start.time_s / params.step_s) * out.length_;
  out.params_ = params;
  out.tangent_ = heart->body.empty_tangent();
  out.heart_ = std::move(heart);
  out.now_ = std::move(start);
  return out;
}

double HeartSteps::step_s(std::int64_t length) const {
  return std::ldexp(params_.step_s * static_cast<double>(length), -params_.most_halvings);
}

double HeartSteps::time_s(std::int64_t tick) const {
  return std::ldexp(params_.step_s * static_cast<double>(tick), -params_.most_halvings);
}

HeartSteps::Newmark HeartSteps::newmark() const {
  const double step = step_s();
  return {kGamma / (kBeta * step), 1 / (kBeta * step * step)};
}

bool HeartSteps::coupled() const {
  return heart_->circulation && tick_ + length_ > 0;
}

void HeartSteps::begin_step() {
  const double end = time_s(tick_ + length_), step = step_s();
  if (heart_->tension_kpa) tension_ = heart_->tension_kpa(end);
  trial_ = Trial{};
  trial_->motion.time_s = end;
  trial_->motion.cavity_kpa = coupled() ? now_.cavity_kpa : heart_->given_kpa(end);
  // As it would move by itself, unless that inverts elements.
  trial_->motion.u = now_.u + step * now_.velocity + step * step / 2 * now_.acceleration;
  if (!complete(*trial_, false)) trial_->motion.u = now_.u;
  tried_ = 0;
}

Status HeartSteps::complete(Trial& trial, bool tangent) {
  const Heart& heart = *heart_;
  HeartMotion& motion = trial.motion;
  const double step = step_s();
  const auto [by_velocity, by_acceleration] = newmark();
  motion.acceleration = by_acceleration * (motion.u - now_.u - step * now_.velocity) -
                        (1 / (2 * kBeta) - 1) * now_.acceleration;
  motion.velocity = now_.velocity + step * ((1 - kGamma) * now_.acceleration + kGamma * motion.acceleration);
  // Pressures within the muscle have no inertia.
  const Eigen::Index pressures = heart.body.unknowns() - heart.body.displacements();
  motion.velocity.tail(pressures).setZero();
  motion.acceleration.tail(pressures).setZero();
  if (tangent) std::fill_n(tangent_.valuePtr(), tangent_.nonZeros(), 0.0);
  trial.force = Eigen::VectorXd::Zero(motion.u.size());
  const mechanics::StrainRate rate{now_.u, step};
  if (Status added =
          heart.body.add_forces(motion.u, tension_, trial.force, tangent ? &tangent_ : nullptr, &rate);
      !added)
    return added;
  double scale = std::max(force_scale_, trial.force.norm());
  Eigen::VectorXd outside;
  for (const auto& [matrix, values] :
       {std::pair{&heart.springs, &motion.u}, std::pair{&heart.dampers, &motion.velocity},
        std::pair{&heart.mass, &motion.acceleration}}) {
    fem::multiply(*matrix, *values, outside);
    trial.force += outside;
  }
  if (tangent) {
    add(1, heart.springs, tangent_);
    add(by_velocity, heart.dampers, tangent_);
    add(by_acceleration, heart.mass, tangent_);
  }
  const Eigen::VectorXd x = heart.body.nodes().places_after(motion.u);
  for (std::size_t c = 0; c < heart.cavities.size(); ++c)
    heart.cavities[c].add_gradient(x, -motion.cavity_kpa[static_cast<Eigen::Index>(c)], trial.force);
  trial.scale = scale;
  trial.error = scale > 0 ? trial.force.norm() / scale : 0;
  motion.cavity_ml = volumes_ml(heart, motion.u);
  motion.circulation = now_.circulation;
  trial.excess_ml = {};
  if (coupled()) {
    Result<CirculationStep> blood =
        step_circulation(*heart.circulation, now_.circulation, motion.time_s, step, motion.cavity_kpa);
    if (!blood) return blood.error();
    motion.circulation = std::move(blood->states);
    trial.inflow_by_pressure = std::move(blood->inflow_by_pressure);
    trial.excess_ml = motion.cavity_ml - now_.cavity_ml - step * blood->inflow_ml_per_s;
    for (Eigen::Index c = 0; c < trial.excess_ml.size(); ++c)
      trial.error = std::max(trial.error, std::abs(trial.excess_ml[c] / now_.cavity_ml[c]));
  }
  trial.error /= params_.tolerance;
  if (!std::isfinite(trial.error))
    return Error{ErrorCode::kMeshing, kMechanicsStage, "a force is not finite", {}};
  return std::monostate{};
}

/// True when the step's equations hold.
Result<bool> HeartSteps::iterate() {
  Trial& trial = *trial_;
  if (Status done = complete(trial, true); !done) return done.error();
  if (trial.error <= 1) return true;
  if (tried_++ == params_.most_iterations) {
    std::ostringstream text;
    text << "after " << params_.most_iterations << " iterations " << trial.error * params_.tolerance
         << " of forces or volumes is out of balance, expected at most " << params_.tolerance;
    return Error{ErrorCode::kMeshing, kMechanicsStage, text.str(), {}};
  }
  ++iterations_;
  const Heart& heart = *heart_;
  const Eigen::VectorXd x = heart.body.nodes().places_after(trial.motion.u);
  const Eigen::VectorXd kpa = trial.motion.cavity_kpa;
  mechanics::BorderedSystem system(tangent_);
  system.add_more = [&](const Eigen::VectorXd& moves, Eigen::VectorXd& change) {
    for (std::size_t c = 0; c < heart.cavities.size(); ++c)
      heart.cavities[c].add_gradient_change(x, moves, -kpa[static_cast<Eigen::Index>(c)], change);
  };
  mechanics::BorderedVector right{-trial.force, {}};
  if (coupled()) {
    for (const Enclosure& cavity : heart.cavities) {
      system.border.emplace_back(Eigen::VectorXd::Zero(trial.force.size()));
      cavity.add_gradient(x, -1, system.border.back());
    }
    system.corner = kMm3PerMl * step_s() * trial.inflow_by_pressure;
    right.y = kMm3PerMl * trial.excess_ml;
  }
  const auto change = solver_.solve(system, right, kLinearTolerance);
  if (!change) return change.error();
  Error last;
  double part = 1;
  for (int i = 0; i <= kLineHalvings; ++i, part /= 2) {
    Trial next = trial;
    next.motion.u += part * change->x;
    if (coupled()) next.motion.cavity_kpa += part * change->y;
    if (Status done = complete(next, false); !done) {
      last = done.error();
      continue;
    }
    if (next.force.norm() > kMostGrowth * trial.force.norm() && next.error > trial.error && i < kLineHalvings)
      continue;
    trial = std::move(next);
    return trial.error <= 1;
  }
  return last;
}

void HeartSteps::accept() {
  force_scale_ = trial_->scale;
  now_ = std::move(trial_->motion);
  trial_.reset();
  tick_ += length_;
  ++steps_;
  const std::int64_t longest = std::int64_t{1} << static_cast<unsigned>(params_.most_halvings);
  if (tried_ <= kEasy && length_ < longest && tick_ % (2 * length_) == 0) length_ *= 2;
}

HeartSteps::State HeartSteps::take_state() {
  trial_.reset();
  solver_.forget();
  return {now_, tick_, length_, force_scale_, steps_, iterations_};
}

Status HeartSteps::restore(State state) {
  const HeartMotion& motion = state.motion;
  for (const auto& [found, expected] :
       {std::pair{&motion.u, &now_.u}, std::pair{&motion.velocity, &now_.u},
        std::pair{&motion.acceleration, &now_.u}, std::pair{&motion.cavity_kpa, &now_.cavity_kpa},
        std::pair{&motion.cavity_ml, &now_.cavity_ml}, std::pair{&motion.circulation, &now_.circulation}})
    if (found->size() != expected->size() || state.length < 1)
      return usage_error(kMechanicsStage, "state: found that of another heart, of " +
                                              std::to_string(found->size()) + " numbers, expected " +
                                              std::to_string(expected->size()));
  trial_.reset();
  solver_.forget();
  now_ = std::move(state.motion);
  tick_ = state.tick;
  length_ = state.length;
  force_scale_ = state.force_scale;
  steps_ = state.steps;
  iterations_ = state.iterations;
  return std::monostate{};
}

Result<bool> HeartSteps::advance() {
  if (!trial_) begin_step();
  const Result<bool> solved = iterate();
  if (solved) {
    if (*solved) accept();
    return *solved;
  }
  trial_.reset();
  if (solved.error().code == ErrorCode::kMeshing && length_ > 1) {
    length_ /= 2;
    return false;
  }
  Error error = solved.error();
  error.message =
      "no step from " + in_ms(now_.time_s) + " to " + in_ms(time_s(tick_ + length_)) + ": " + error.message;
  return error;
}

}  // namespace voxtet::beat
