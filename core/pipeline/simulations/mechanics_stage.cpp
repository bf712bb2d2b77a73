#include "pipeline/simulations/mechanics_stage.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "base/digest.h"
#include "physics/beat/beat_record.h"
#include "physics/beat/heart_fields.h"
#include "physics/beat/make_heart.h"
#include "physics/beat/wall_directions.h"
#include "physics/ventricles/ventricular_fibres.h"
#include "pipeline/results/stage_results.h"
#include "pipeline/simulations/mechanics_checkpoint.h"
#include "pipeline/version/engine_version.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

using nlohmann::json;

/// What the model reads of the heart, kept for as long as it beats.
struct HeartInputs {
  beat::Anatomy anatomy() const {
    return {mesh,
            surfaces,
            fibres,
            directions.across,
            directions.right,
            fine_fibres.fibre.empty() ? nullptr : &fine_fibres,
            activation_ms,
            duration_ms};
  }

  const TetMesh& mesh;
  const HeartSurfaces& surfaces;
  const Fibres& fibres;
  beat::WallDirections directions;
  Fibres fine_fibres;
  std::vector<float> activation_ms, duration_ms;
};

class MechanicsTask : public StageTask {
 public:
  MechanicsTask(HeartInputs inputs, beat::MadeHeart made, beat::HeartSteps steps, const Recipe& recipe)
      : inputs_(std::move(inputs)),
        made_(std::move(made)),
        steps_(std::move(steps)),
        params_(*recipe.physics->mechanics),
        made_from_(made_from(recipe)),
        record_(params_, made_.heart->circulation->state_names(), steps_.now()) {}

  Result<bool> step(RunContext& ctx) override {
    if (record_.is_over()) return true;
    const double before_ms = 1000 * steps_.now().time_s;
    before_ = steps_.now();
    const Result<bool> stepped = steps_.advance();
    if (!stepped) return stepped.error();
    if (!*stepped) return false;
    record_.add(before_, steps_.now());
    const double now_ms = 1000 * steps_.now().time_s;
    const bool over = record_.is_over();
    const bool due = now_ms >= next_frame_ms_ - kRounding;
    if (due) emit(ctx);
    // Kept at times that do not depend on when somebody asks, so that a run that goes on is the same run.
    if (std::floor(now_ms / kKeepMs + kRounding) > std::floor(before_ms / kKeepMs + kRounding)) keep();
    // The frame at an end between two frames is one that a longer run does not have.
    if (over && !due) emit(ctx);
    return over;
  }

  double fraction() const override {
    const double whole = params_.fill_ms + params_.period_ms * params_.beats;
    return (1000 * steps_.now().time_s + params_.fill_ms) / whole;
  }

  void finish(StageOutput& out) override {
    MechanicsResult result;
    result.times_ms = times_ms_;
    result.last = last_;
    const beat::BeatMeasures& measures = record_.measures();
    result.trace_times_ms = measures.times_ms;
    result.traces = measures.traces;
    result.beats = measures.beats;
    result.change_percent = measures.change_percent();
    result.has_cycle = record_.has_cycle();
    result.steps = steps_.steps();
    result.newton_iterations = steps_.newton_iterations();
    Sha256 digest = digest_;
    for (const Trace& trace : result.traces) digest.update_values(trace.values.data(), trace.values.size());
    result.digest = digest.hex();
    out.put(std::move(result));
  }

  Result<Bytes> checkpoint() override { return kept_; }

  Status resume(const Bytes& bytes) override {
    Result<MechanicsCheckpoint> read = read_mechanics_checkpoint(bytes);
    if (!read) return read.error();
    MechanicsCheckpoint& all = *read;
    for (const auto& [key, value] : made_from_.items())
      if (!all.made_from.contains(key) || all.made_from[key] != value)
        return usage_error(kMechanicsStage, "state: was made from another " + key);
    beat::BeatMeasures measures = record_.measures();
    if (all.measures.traces.size() != measures.traces.size())
      return usage_error(kMechanicsStage, "state: found another number of traces");
    if (Status restored = steps_.restore(std::move(all.state)); !restored) return restored.error();
    for (std::size_t i = 0; i < measures.traces.size(); ++i)
      measures.traces[i].values = std::move(all.measures.traces[i].values);
    all.measures.traces = std::move(measures.traces);
    record_.restore(std::move(all.measures), std::move(all.under_way));
    times_ms_ = std::move(all.times_ms);
    next_frame_ms_ = all.next_frame_ms;
    traced_ = static_cast<std::size_t>(all.traced);
    digest_ = all.digest;
    last_ = {1000 * steps_.now().time_s, beat::heart_fields(inputs_.anatomy(), made_, steps_.now()), {}, {}};
    kept_ = bytes;
    return std::monostate{};
  }

 private:
  static constexpr double kRounding = 1e-6;
  static constexpr double kKeepMs = 100;

  /// All that a run of this recipe depends on, but how long it goes on.
  json made_from(const Recipe& recipe) const {
    json physics = recipe_to_json(recipe)["physics"];
    json out{{"engine", engine_version()}, {"physics", physics_version()}, {"mesh", digest_of(inputs_.mesh)}};
    for (const char* length : {"beats", "cycle_percent"}) physics["mechanics"].erase(length);
    for (const char* group : {"mechanics", "anatomy", "fibres"})
      out["physics." + std::string(group)] = physics[group];
    if (params_.contraction.by != ActivationBy::kSynchronous)
      for (const char* group : {"tissue", "stimuli", "monodomain"})
        out["physics." + std::string(group)] = physics[group];
    return out;
  }

  void keep() {
    kept_ = write_checkpoint({made_from_, steps_.take_state(), record_.measures(), record_.under_way(),
                              times_ms_, next_frame_ms_, traced_, digest_});
  }

  void emit(RunContext& ctx) {
    const beat::BeatMeasures& measures = record_.measures();
    const auto since = static_cast<std::ptrdiff_t>(traced_);
    last_ = {1000 * steps_.now().time_s,
             beat::heart_fields(inputs_.anatomy(), made_, steps_.now()),
             {measures.times_ms.begin() + since, measures.times_ms.end()},
             {}};
    for (const Trace& trace : measures.traces)
      last_.traces.push_back(
          {trace.name, trace.title, trace.unit, {trace.values.begin() + since, trace.values.end()}});
    traced_ = measures.times_ms.size();
    times_ms_.push_back(last_.time_ms);
    for (const Field& field : last_.fields) digest_.update_values(field.values.data(), field.values.size());
    next_frame_ms_ = params_.frame_ms * std::floor(last_.time_ms / params_.frame_ms + 1 + kRounding);
    ctx.snapshot(last_);
  }

  HeartInputs inputs_;
  beat::MadeHeart made_;
  beat::HeartSteps steps_;
  BeatParams params_;
  json made_from_;
  beat::BeatRecord record_;
  beat::HeartMotion before_;
  Snapshot last_;
  std::vector<double> times_ms_;  ///< of the frames
  double next_frame_ms_ = 0;
  std::size_t traced_ = 0;  ///< of the record's times those that frames have had
  Sha256 digest_;           ///< over the frames
  Bytes kept_;              ///< the last checkpoint
};

const Field& needed(const std::vector<Field>& fields, const char* name) {
  return *find_field(fields, name);
}

}  // namespace

bool mechanics_wants(Stage input, const Recipe& recipe) {
  const ContractionParams contraction = recipe.physics && recipe.physics->mechanics
                                            ? recipe.physics->mechanics->contraction
                                            : ContractionParams{};
  if (input == Stage::kEikonal) return contraction.by == ActivationBy::kEikonal;
  if (input == Stage::kMonodomain) return contraction.by == ActivationBy::kMonodomain;
  return true;
}

Result<std::unique_ptr<StageTask>> start_mechanics(const StageInputs& in, const Recipe& recipe) {
  if (!recipe.physics || !recipe.physics->mechanics)
    return usage_error(kMechanicsStage, "physics.mechanics: found none, expected how the heart beats");
  const BeatParams& params = *recipe.physics->mechanics;
  const AnatomyResult& anatomy = in.get<AnatomyResult>(Stage::kAnatomy);
  if (!anatomy.surfaces)
    return usage_error(
        kMechanicsStage,
        "physics.mechanics: found no physics.anatomy beside it, expected one: it says where the "
        "cavities are");
  const Fibres& fibres = in.get<FibresResult>(Stage::kFibres).fibres;
  if (fibres.fibre.empty() || fibres.sheet.empty())
    return usage_error(
        kMechanicsStage,
        "physics.mechanics: found no fibres, expected physics.fibres, or fibres and sheets of the "
        "mesh");
  const TetMesh& mesh = in.get<TetMesh>(Stage::kOptimise);
  HeartInputs inputs{mesh,   *anatomy.surfaces,
                     fibres, beat::wall_directions(mesh, *anatomy.surfaces, anatomy.potentials),
                     {},     {},
                     {}};
  if (params.fine_fibres) {
    if (!recipe.physics->fibres)
      return usage_error(
          kMechanicsStage,
          "physics.mechanics.fine_fibres: found no physics.fibres, expected a rule that gives fibres "
          "at any place");
    std::array<CornerShares, 4> places{};
    for (std::size_t s = 0; s < places.size(); ++s) places[s] = mechanics::Nodes::shares_of(places.size(), s);
    Result<Fibres> fine =
        tet_fibres(mesh, inputs.surfaces, anatomy.potentials, *recipe.physics->fibres, RunContext{}, places);
    if (!fine) return fine.error();
    inputs.fine_fibres = std::move(fine).value();
  }
  if (params.contraction.by == ActivationBy::kEikonal)
    inputs.activation_ms = needed(in.get<EikonalResult>(Stage::kEikonal).fields, "eikonal_ms").values;
  if (params.contraction.by == ActivationBy::kMonodomain) {
    const Trajectory& wave = in.get<Trajectory>(Stage::kMonodomain);
    inputs.activation_ms = needed(wave.fields, "activation_ms").values;
    inputs.duration_ms = needed(wave.fields, "apd_ms").values;
  }
  Result<beat::MadeHeart> made = beat::make_heart(inputs.anatomy(), params);
  if (!made) return made.error();
  beat::HeartStepParams step;
  step.step_s = params.step_ms / 1000;
  Result<beat::HeartSteps> steps = beat::HeartSteps::start(made->heart, made->start, step);
  if (!steps) return steps.error();
  return std::unique_ptr<StageTask>(std::make_unique<MechanicsTask>(
      std::move(inputs), std::move(made).value(), std::move(steps).value(), recipe));
}

}  // namespace voxtet
