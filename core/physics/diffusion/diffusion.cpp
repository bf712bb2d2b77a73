#include "physics/diffusion/diffusion.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "physics/fem/assemble.h"
#include "physics/fem/hold_points.h"
#include "physics/fem/solve_pcg.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

constexpr double kMostDiffusionSteps = 1e6;
/// Points that an iteration goes through in some milliseconds.
constexpr std::size_t kShortDiffusion = 150'000;

Error field_error(const std::string& field, const std::string& found, const std::string& expected) {
  return usage_error(kDiffusionStage,
                     "physics.diffusion." + field + ": found " + found + ", expected " + expected);
}

std::string as_text(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::optional<Error> check_positive(const char* field, double value, const char* unit) {
  if (std::isfinite(value) && value > 0) return std::nullopt;
  return field_error(field, as_text(value), std::string("a finite number > 0 ") + unit);
}

std::optional<Error> check(const TetMesh& mesh, const DiffusionParams& params) {
  if (auto error = check_positive("diffusivity_mm2_per_ms", params.diffusivity_mm2_per_ms, "mm^2/ms"))
    return error;
  if (auto error = check_positive("end_ms", params.end_ms, "ms")) return error;
  if (auto error = check_positive("step_ms", params.step_ms, "ms")) return error;
  if (auto error = check_positive("frame_ms", params.frame_ms, "ms")) return error;
  if (params.end_ms / params.step_ms > kMostDiffusionSteps)
    return field_error("step_ms", as_text(params.step_ms) + " ms",
                       "at least a millionth of end_ms, " + as_text(params.end_ms) + " ms");
  const std::set<Label> held(mesh.labels.begin(), mesh.labels.end());
  if (held.contains(params.from)) return std::nullopt;
  std::string list;
  for (const Label label : held) list += (list.empty() ? "" : ", ") + std::to_string(label);
  return field_error("from", std::to_string(params.from), "a label of the mesh: " + list);
}

std::vector<bool> points_of(const TetMesh& mesh, Label label) {
  std::vector<bool> marked(mesh.points.size(), false);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    if (mesh.labels[t] == label)
      for (const std::uint32_t point : mesh.tets[t]) marked[point] = true;
  return marked;
}

}  // namespace

Result<Diffusion> Diffusion::start(std::shared_ptr<const TetMesh> mesh, const DiffusionParams& params) {
  if (auto error = check(*mesh, params)) return *std::move(error);
  Diffusion diffusion;
  diffusion.steps_ = fem::TimeSteps(params.end_ms, params.step_ms, params.frame_ms);
  diffusion.step_diffusivity_ = diffusion.steps_.step_ms() * params.diffusivity_mm2_per_ms;

  diffusion.held_ = points_of(*mesh, params.from);
  const auto count = static_cast<Eigen::Index>(mesh->points.size());
  diffusion.temperature_ = Eigen::VectorXd::Zero(count);
  diffusion.change_ = Eigen::VectorXd::Zero(count);
  for (Eigen::Index i = 0; i < count; ++i)
    if (diffusion.held_[static_cast<std::size_t>(i)]) diffusion.temperature_[i] = 1;
  diffusion.mesh_ = std::move(mesh);
  return diffusion;
}

/// One of three parts of about the same length: the matrices' pattern, the mass, the stiffness.
Status Diffusion::prepare() {
  if (step_stiffness_.rows() == 0) {
    step_stiffness_ = fem::empty_matrix(*mesh_);
    return std::monostate{};
  }
  if (system_.rows() == 0) {
    system_ = step_stiffness_;
    return fem::add_mass(*mesh_, system_);
  }
  const std::vector<double> coefficient(mesh_->tets.size(), step_diffusivity_);
  if (Status added = fem::add_stiffness(*mesh_, coefficient, step_stiffness_); !added) return added;
  for (Eigen::Index at = 0; at < system_.nonZeros(); ++at)
    system_.valuePtr()[at] += step_stiffness_.valuePtr()[at];
  fem::hold_points(system_, held_);
  mesh_.reset();
  return std::monostate{};
}

Status Diffusion::start_solve() {
  // (M + dt K) (u_new - u) = -dt K u, where u_new - u is 0 at held points.
  Eigen::VectorXd load;
  fem::multiply(step_stiffness_, temperature_, load);
  for (Eigen::Index i = 0; i < load.size(); ++i) load[i] = held_[static_cast<std::size_t>(i)] ? 0 : -load[i];
  auto started = fem::PcgSolve::start(system_, load, change_, {});
  if (!started) return started.error();
  solve_ = *std::move(started);
  return std::monostate{};
}

Result<bool> Diffusion::advance(int iterations) {
  if (mesh_) {
    if (Status prepared = prepare(); !prepared) return prepared.error();
    return false;
  }
  if (!solve_)
    if (Status started = start_solve(); !started) return started.error();
  Result<bool> solved = solve_->iterate(system_, iterations);
  if (solved && !*solved) return false;
  if (solved) {
    change_ = solve_->x();
    for (Eigen::Index i = 0; i < change_.size(); ++i) temperature_[i] += change_[i];
    steps_.next();
  }
  solve_.reset();
  return solved;
}

int Diffusion::short_part() const {
  return static_cast<int>(std::max<std::size_t>(1, kShortDiffusion / held_.size()));
}

Field Diffusion::temperature() const {
  Field field{"temperature", "Temperature", "1", On::kPoints, Scale::kSequential, 1, {}};
  field.values.reserve(held_.size());
  for (const double value : temperature_) field.values.push_back(static_cast<float>(value));
  return field;
}

}  // namespace voxtet
