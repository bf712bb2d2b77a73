#include "physics/monodomain/monodomain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "physics/fem/assemble.h"
#include "physics/fem/largest_eigenvalue.h"
#include "physics/monodomain/membrane_voltage.h"
#include "physics/tissue/stimulated_points.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

constexpr float kNotConducting = std::numeric_limits<float>::quiet_NaN();
constexpr double kMostMonodomainSteps = 1e7;
/// A voltage below it, as a part of its range, is rest: the wave's front falls off by e in a third of a
/// millimetre, and what is so far ahead of it does not drive it.
constexpr double kRest = 1e-8;
/// Iterations of the solver between two looks at the clock.
constexpr int kIterationsAtOnce = 4;
/// Of the change by one diffusion step, whose own error is far larger.
constexpr fem::PcgParams kSolver{.relative_tolerance = 1e-5, .max_iterations = 1000};

Error field_error(const std::string& field, double found, const std::string& expected) {
  std::ostringstream text;
  text << "physics." << field << ": found " << found << ", expected " << expected;
  return usage_error(kMonodomainStage, text.str());
}

std::optional<Error> check(const MonodomainParams& params) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
  if (!positive(params.end_ms))
    return field_error("monodomain.end_ms", params.end_ms, "a finite number > 0 ms");
  if (!positive(params.frame_ms))
    return field_error("monodomain.frame_ms", params.frame_ms, "a finite number > 0 ms");
  if (!(positive(params.step_ms) && params.step_ms <= 0.5))
    return field_error("monodomain.step_ms", params.step_ms, "a number > 0 and at most 0.5 ms");
  if (params.end_ms / params.step_ms > kMostMonodomainSteps)
    return field_error("monodomain.step_ms", params.step_ms, "at least a ten-millionth of end_ms");
  if (!(params.consistent_mass >= 0 && params.consistent_mass <= 1))
    return field_error("monodomain.consistent_mass", params.consistent_mass, "a number from 0 to 1");
  return std::nullopt;
}

}  // namespace

Result<Monodomain> Monodomain::start(const TetMesh& mesh, const Tissue& tissue,
                                     const std::vector<Stimulus>& stimuli, const MonodomainParams& params,
                                     int threads) {
  if (auto error = check(params)) return *std::move(error);
  Result<ConductingMesh> conducting = conducting_mesh(
      mesh, tissue, params.correct_speed ? std::optional(consistent_mass_of(params)) : std::nullopt);
  if (!conducting) return conducting.error();
  Monodomain out;
  out.params_ = params;
  out.threads_ = threads;
  out.mesh_points_ = mesh.points.size();
  out.tissue_ = std::move(conducting).value();
  out.steps_ = fem::TimeSteps(params.end_ms, params.step_ms, params.frame_ms);
  for (const TissueKind& kind : tissue.kinds) out.cells_.emplace_back(kind.cell, out.step_ms());
  for (std::size_t s = 0; s < stimuli.size(); ++s)
    if (Status added = out.add_current(stimuli[s], "physics.stimuli[" + std::to_string(s) + "]"); !added)
      return added.error();
  const auto count = static_cast<Eigen::Index>(out.points().size());
  out.v_ = Eigen::VectorXd::Zero(count);
  out.w_ = Eigen::VectorXd::Ones(count);
  out.next_ = out.change_ = out.earlier_ = out.v_;
  for (const Electrode& electrode : params.electrodes)
    out.electrode_weights_.push_back(electrogram_weights(out.tissue_, electrode.at_mm));
  return out;
}

Status Monodomain::add_current(const Stimulus& stimulus, const std::string& field) {
  auto points = stimulated_points(tissue_.mesh.points, {}, stimulus, field);
  if (!points) return points.error();
  currents_.push_back(
      {std::move(points).value(), start_times_ms(stimulus), stimulus.duration_ms, stimulus.strength_per_ms});
  flows_.push_back(false);
  return std::monostate{};
}

Status Monodomain::stimulate(const Stimulus& stimulus) {
  return add_current(stimulus, "stimulus");
}

MonodomainState Monodomain::state() const {
  const auto list = [](const Eigen::VectorXd& values) {
    return std::vector<double>(values.begin(), values.end());
  };
  return {steps_.step(), step_ms(),      list(v_),           list(w_),
          list(change_), list(earlier_), log_.activations(), log_.repolarisations()};
}

Status Monodomain::restore(const MonodomainState& state) {
  const std::size_t count = points().size();
  if (state.v.size() != count || state.w.size() != count || state.change.size() != count ||
      state.earlier.size() != count)
    return usage_error(kMonodomainStage, "state: found " + std::to_string(state.v.size()) +
                                             " points, expected the " + std::to_string(count) +
                                             " that conduct");
  if (!(std::abs(state.step_ms - step_ms()) <= 1e-12 * step_ms()))
    return usage_error(kMonodomainStage, "state: found a step of " + std::to_string(state.step_ms) +
                                             " ms, expected " + std::to_string(step_ms()) + " ms");
  if (state.steps < 0 || state.steps > steps_.count())
    return field_error(
        "monodomain.end_ms", params_.end_ms,
        "at least the " + std::to_string(state.steps * step_ms()) + " ms that the state has reached");
  const auto vector = [](const std::vector<double>& values) {
    return Eigen::VectorXd(
        Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
  };
  steps_.go_to(state.steps);
  v_ = vector(state.v), w_ = vector(state.w);
  change_ = vector(state.change), earlier_ = vector(state.earlier);
  log_ = ActivationLog(state.activations, state.repolarisations);
  return std::monostate{};
}

/// Parts of about the same length.
Status Monodomain::prepare() {
  const TetMesh& mesh = tissue_.mesh;
  switch (prepared_++) {
    case 0: stiffness_ = fem::empty_matrix(mesh); return std::monostate{};
    case 1: {
      Result<Eigen::VectorXd> lumped = fem::assemble_lumped_mass(mesh);
      if (!lumped) return lumped.error();
      lumped_ = std::move(lumped).value();
      system_ = stiffness_;
      return params_.integration == Integration::kSemiImplicit ? fem::add_mass(mesh, system_)
                                                               : Status(std::monostate{});
    }
    case 2:
      return fem::add_stiffness(mesh, std::span<const Eigen::Matrix3d>(tissue_.diffusivity), stiffness_);
    default: break;
  }
  double* const system = system_.valuePtr();
  double* const stiffness = stiffness_.valuePtr();
  if (params_.integration == Integration::kSemiImplicit) {
    const double consistent = params_.consistent_mass;
    for (Eigen::Index at = 0; at < system_.nonZeros(); ++at)
      system[at] = consistent * system[at] + step_ms() * stiffness[at];
    for (Eigen::Index i = 0; i < lumped_.size(); ++i) system_.coeffRef(i, i) += (1 - consistent) * lumped_[i];
  } else {
    most_step_ms_ = 2 / fem::largest_eigenvalue_bound(stiffness_, lumped_);
    if (step_ms() > most_step_ms_)
      return field_error("monodomain.step_ms", step_ms(),
                         "at most " + std::to_string(most_step_ms_) +
                             " ms, above which integration explicit is not stable on this mesh");
    for (Eigen::Index i = 0; i < lumped_.size(); ++i)
      for (int at = stiffness_.outerIndexPtr()[i]; at < stiffness_.outerIndexPtr()[i + 1]; ++at)
        stiffness[at] *= step_ms() / lumped_[i];
    system_ = {};
  }
  excited_ = ExcitedBlocks(stiffness_);
  load_ = Eigen::VectorXd::Zero(v_.size());
  if (params_.integration == Integration::kSemiImplicit) {
    auto solve = fem::PcgSolve::start(system_, load_, load_, kSolver);
    if (!solve) return solve.error();
    solve_ = *std::move(solve);
  }
  tissue_.mesh.tets = {};
  tissue_.diffusivity = {};
  return std::monostate{};
}

/// The currents that flow during the step under way, by its middle.
void Monodomain::set_currents() {
  const double now = time_ms() + step_ms() / 2;
  bool changed = false;
  for (std::size_t c = 0; c < currents_.size(); ++c) {
    const auto& starts = currents_[c].starts_ms;
    const bool flows = std::any_of(starts.begin(), starts.end(), [&](double start) {
      return now >= start && now < start + currents_[c].duration_ms;
    });
    changed = changed || flows != flows_[c];
    flows_[c] = flows;
  }
  if (!changed) return;
  current_.clear();
  for (std::size_t c = 0; c < currents_.size(); ++c) {
    if (!flows_[c]) continue;
    current_.resize(points().size(), 0);
    for (const std::uint32_t point : currents_[c].points) current_[point] += currents_[c].strength_per_ms;
  }
}

/// What is out of reach is 0 in all vectors of voltages.
void Monodomain::find_reach() {
  excited_.update(v_, w_, current_);
  for (const auto [first, last] : excited_.left())
    for (Eigen::VectorXd* values : {&next_, &change_, &earlier_})
      values->segment(first, last - first).setZero();
}

/// From v_ to next_, and w_ in its place.
void Monodomain::react() {
  set_currents();
  find_reach();
  const std::uint16_t* const kind = tissue_.kind.data();
  const CellStep* const cells = cells_.data();
  const double* const current = current_.empty() ? nullptr : current_.data();
  const double* const v = v_.data();
  double* const next = next_.data();
  double* const w = w_.data();
  for (const fem::RowRanges* ranges : {&excited_.rows(), &excited_.recovering()})
    parallel_for(threads_, ranges->size(), [=](std::size_t from, std::size_t to) {
      constexpr std::array<double, ExcitedBlocks::kPoints> kNone{};
      for (std::size_t r = from; r < to; ++r) {
        const auto [first, last] = (*ranges)[r];
        std::copy(v + first, v + last, next + first);
        for (int i = first, end = i; i < last; i = end) {
          while (end < last && kind[end] == kind[i]) ++end;
          cells[kind[i]].react_all(next + i, w + i, current ? current + i : kNone.data(), end - i);
        }
      }
    });
}

void Monodomain::diffuse_explicitly() {
  const double* const before = next_.data();
  double* const after = change_.data();
  const fem::RowRanges& rows = excited_.rows();
  parallel_for(threads_, rows.size(), [=, this, &rows](std::size_t from, std::size_t to) {
    for (std::size_t r = from; r < to; ++r)
      for (int i = rows[r].first; i < rows[r].last; ++i)
        after[i] = before[i] - fem::row_product(stiffness_, i, before);
  });
  next_.swap(change_);
}

/// (M + step K) (v_new - v) = - step K v.
Result<bool> Monodomain::diffuse_implicitly() {
  if (!solving_) {
    const double* const v = next_.data();
    for (const auto [first, last] : excited_.rows())
      for (int i = first; i < last; ++i) {
        load_[i] = -step_ms() * fem::row_product(stiffness_, i, v);
        earlier_[i] = 2 * change_[i] - earlier_[i];  // a guess, by what the last two steps did
      }
    solve_->start_again(system_, load_, std::move(earlier_), excited_.rows());
    solving_ = true;
  }
  Result<bool> solved = solve_->iterate(system_, kIterationsAtOnce);
  if (!solved || !*solved) return solved;
  earlier_ = std::exchange(change_, solve_->take_x());
  for (const auto [first, last] : excited_.rows())
    for (int i = first; i < last; ++i) next_[i] += change_[i];
  solving_ = false;
  return true;
}

void Monodomain::complete_step() {
  for (const auto [first, last] : excited_.rows())
    for (int i = first; i < last; ++i)
      if (std::abs(next_[i]) < kRest) next_[i] = 0;
  log_.record(time_ms(), step_ms(), v_, next_, excited_.rows());
  v_.swap(next_);
  steps_.next();
  reacted_ = false;
}

Result<bool> Monodomain::advance() {
  if (prepared_ < 4) {
    if (Status prepared = prepare(); !prepared) return prepared.error();
    return false;
  }
  if (!reacted_) react();
  reacted_ = true;
  if (params_.integration == Integration::kExplicit) {
    diffuse_explicitly();
  } else {
    Result<bool> diffused = diffuse_implicitly();
    if (!diffused || !*diffused) return diffused;
  }
  complete_step();
  return true;
}

std::vector<float> Monodomain::on_mesh(const std::vector<float>& of_points, float elsewhere) const {
  std::vector<float> values(mesh_points_, elsewhere);
  for (std::size_t i = 0; i < of_points.size(); ++i) values[points()[i]] = of_points[i];
  return values;
}

Field Monodomain::voltage() const {
  std::vector<float> values(points().size());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<float>(membrane_mv(v_[static_cast<Eigen::Index>(i)]));
  return {"voltage_mV",
          "Membrane voltage",
          "mV",
          On::kPoints,
          Scale::kSequential,
          1,
          on_mesh(values, kNotConducting)};
}

std::vector<Field> Monodomain::activation_fields() const {
  const std::size_t count = points().size();
  const std::vector<ActivationLog::Beat> beats = log_.beats(count, kMostBeats);
  const auto& [activated, repolarised] = beats[0];
  std::vector<float> duration(count);
  for (std::size_t i = 0; i < count; ++i) duration[i] = repolarised[i] - activated[i];
  const auto field = [&](std::string name, std::string title, const char* unit, Scale scale,
                         const std::vector<float>& values) {
    return Field{
        std::move(name), std::move(title), unit, On::kPoints, scale, 1, on_mesh(values, kNotConducting)};
  };
  std::vector<Field> fields{
      field("activation_ms", "Activation time", "ms", Scale::kSequential, activated),
      field("repolarisation_ms", "Repolarisation time", "ms", Scale::kSequential, repolarised),
      field("apd_ms", "Action potential duration", "ms", Scale::kSequential, duration),
      field("last_activation_ms", "Last activation", "ms", Scale::kSequential, log_.last_activation(count)),
      field("activations", "Number of activations", "1", Scale::kWhole, log_.activation_counts(count))};
  for (std::size_t k = 1; k < beats.size(); ++k) {
    const std::string beat = std::to_string(k + 1);
    fields.push_back(field("activation_" + beat + "_ms", "Activation time (beat " + beat + ")", "ms",
                           Scale::kSequential, beats[k].activated_ms));
    fields.push_back(field("repolarisation_" + beat + "_ms", "Repolarisation time (beat " + beat + ")", "ms",
                           Scale::kSequential, beats[k].repolarised_ms));
  }
  return fields;
}

std::vector<double> Monodomain::potentials_mv() const {
  std::vector<double> potentials;
  for (const Eigen::VectorXd& weights : electrode_weights_) potentials.push_back(fem::dot(weights, v_));
  return potentials;
}

}  // namespace voxtet
