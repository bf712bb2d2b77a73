#include "pipeline/simulations/monodomain_stage.h"

#include <algorithm>

#include "pipeline/results/stage_results.h"
#include "pipeline/simulations/monodomain_checkpoint.h"
#include "pipeline/version/engine_version.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

using nlohmann::json;

/// Time between two values of a trace, ms.
constexpr double kTraceInterval = 1;
/// Points whose steps take some milliseconds.
constexpr std::size_t kShortPart = 30'000;

/// What the tissue is made of, as a digest.
std::string digest_of_tissue(const Tissue& tissue) {
  Sha256 sha;
  sha.update_values(tissue.kind.data(), tissue.kind.size());
  sha.update_values(tissue.share.data(), tissue.share.size());
  for (const Eigen::Vector3d& fibre : tissue.fibre) sha.update_values(fibre.data(), 3);
  return sha.hex();
}

/// All that a run of this recipe has seen until `time_ms`, but the electrodes' names.
json seen_by(const Recipe& recipe, double time_ms) {
  json physics = recipe_to_json(recipe)["physics"];
  json seen = {{"physics.monodomain", std::move(physics["monodomain"])},
               {"physics.tissue", std::move(physics["tissue"])},
               {"physics.stimuli", json::array()}};
  seen["physics.monodomain"].erase("end_ms");
  for (json& stimulus : physics["stimuli"])
    if (stimulus["start_ms"].get<double>() < time_ms) seen["physics.stimuli"].push_back(std::move(stimulus));
  return seen;
}

class MonodomainTask : public StageTask {
 public:
  MonodomainTask(Monodomain heart, const TetMesh& mesh, const Tissue& tissue, Recipe recipe)
      : heart_(std::move(heart)), mesh_(mesh), tissue_(tissue), recipe_(std::move(recipe)) {
    const std::vector<Electrode>& electrodes = recipe_.physics->monodomain->electrodes;
    for (std::size_t e = 0; e < electrodes.size(); ++e)
      result_.traces.push_back(
          {"electrode_" + std::to_string(e),
           electrodes[e].name.empty() ? "Electrode " + std::to_string(e + 1) : electrodes[e].name,
           "mV",
           {}});
  }

  Result<bool> step(RunContext& ctx) override {
    emit_due(ctx);
    for (std::size_t worked = 0; worked < kShortPart && !heart_.done(); worked += heart_.points().size()) {
      const Result<bool> stepped = heart_.advance();
      if (!stepped) return stepped.error();
      if (!*stepped) continue;
      trace();
      emit_due(ctx);
    }
    return heart_.done();
  }
  double fraction() const override { return heart_.fraction(); }

  void finish(StageOutput& out) override {
    Trajectory result = result_;
    result.fields = heart_.activation_fields();
    Sha256 digest = digest_;
    for (const Field& field : result.fields) digest.update_values(field.values.data(), field.values.size());
    for (const Trace& trace : result.traces) digest.update_values(trace.values.data(), trace.values.size());
    result.digest = digest.hex();
    out.put(std::move(result));
  }

  Result<Stimulus> stimulate(Stimulus stimulus) override {
    stimulus.start_ms += heart_.time_ms() + (heart_.between_steps() ? 0 : heart_.step_ms());
    if (Status given = heart_.stimulate(stimulus); !given) return given.error();
    recipe_.physics->stimuli.push_back(stimulus);
    return stimulus;
  }

  Result<Bytes> checkpoint() override {
    while (!heart_.between_steps())
      if (const Result<bool> stepped = heart_.advance(); !stepped) return stepped.error();
    MonodomainCheckpoint all{
        made_from(heart_.time_ms()), heart_.state(), result_.times_ms, result_.trace_times_ms, {}, digest_};
    if (heart_.done() && result_.times_ms.size() > before_last_.frames) {
      // The frame at the end may be one that a later end would not have.
      all.times_ms.resize(before_last_.frames);
      all.digest = before_last_.digest;
    }
    for (const Trace& trace : result_.traces) all.traces.push_back(trace.values);
    return write_checkpoint(all);
  }

  Status resume(const Bytes& bytes) override {
    Result<MonodomainCheckpoint> read = read_checkpoint(bytes);
    if (!read) return read.error();
    MonodomainCheckpoint& all = *read;
    const double time_ms = all.state.steps * all.state.step_ms;
    const json expected = made_from(time_ms);
    for (const auto& [key, value] : expected.items())
      if (!all.made_from.contains(key) || all.made_from[key] != value)
        return usage_error(kMonodomainStage, "state: was made from another " + key + ", found " +
                                                 all.made_from.value(key, json()).dump() + ", expected " +
                                                 value.dump());
    if (all.traces.size() != result_.traces.size())
      return usage_error(kMonodomainStage, "state: found another number of electrodes");
    if (Status restored = heart_.restore(all.state); !restored) return restored.error();
    result_.times_ms = std::move(all.times_ms);
    result_.trace_times_ms = std::move(all.trace_times_ms);
    for (std::size_t e = 0; e < all.traces.size(); ++e) result_.traces[e].values = std::move(all.traces[e]);
    traced_ = static_cast<std::size_t>(time_ms / kTraceInterval + 1e-9);
    digest_ = all.digest;
    return std::monostate{};
  }

 private:
  json made_from(double time_ms) const {
    json all = seen_by(recipe_, time_ms);
    all["engine"] = engine_version();
    all["mesh"] = digest_of(mesh_);
    all["tissue"] = digest_of_tissue(tissue_);
    return all;
  }

  /// The frame of this time, if one is due and was not given yet.
  void emit_due(RunContext& ctx) {
    const double now = heart_.time_ms();
    if (!heart_.frame_due() || (!result_.times_ms.empty() && result_.times_ms.back() >= now)) return;
    before_last_ = {result_.times_ms.size(), digest_};
    result_.last = {now, {heart_.voltage()}};
    result_.times_ms.push_back(now);
    const std::vector<float>& values = result_.last.fields[0].values;
    digest_.update_values(values.data(), values.size());
    ctx.snapshot(result_.last);
  }

  void trace() {
    if (result_.traces.empty() || heart_.time_ms() < kTraceInterval * static_cast<double>(traced_ + 1) - 1e-9)
      return;
    traced_ = static_cast<std::size_t>(heart_.time_ms() / kTraceInterval + 1e-9);
    result_.trace_times_ms.push_back(heart_.time_ms());
    const std::vector<double> potentials = heart_.potentials_mv();
    for (std::size_t e = 0; e < potentials.size(); ++e)
      result_.traces[e].values.push_back(static_cast<float>(potentials[e]));
  }

  Monodomain heart_;
  const TetMesh& mesh_;
  const Tissue& tissue_;
  Recipe recipe_;  ///< with the stimuli that came while it ran
  Trajectory result_;
  Sha256 digest_;
  /// As it was before the last frame.
  struct {
    std::size_t frames = 0;
    Sha256 digest;
  } before_last_;
  std::size_t traced_ = 0;
};

}  // namespace

Result<std::unique_ptr<StageTask>> start_monodomain(const StageInputs& in, const Recipe& recipe) {
  if (!recipe.physics || !recipe.physics->monodomain)
    return usage_error(kMonodomainStage,
                       "physics.monodomain: found none, expected when and how long to simulate");
  const MonodomainParams& params = *recipe.physics->monodomain;
  const TetMesh& mesh = in.get<TetMesh>(Stage::kOptimise);
  const Tissue& tissue = in.get<TissueResult>(Stage::kTissue).tissue;
  Result<Monodomain> heart = Monodomain::start(mesh, tissue, recipe.physics->stimuli, params);
  if (!heart) return heart.error();
  return std::unique_ptr<StageTask>(
      std::make_unique<MonodomainTask>(std::move(heart).value(), mesh, tissue, recipe));
}

}  // namespace voxtet
