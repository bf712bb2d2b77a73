#include "pipeline/stages/mechanics_stage.h"

#include <cmath>
#include <utility>

#include "base/digest.h"
#include "physics/beat/beat_record.h"
#include "physics/beat/heart_fields.h"
#include "physics/beat/make_heart.h"
#include "physics/beat/wall_directions.h"
#include "pipeline/results/stage_results.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

/// What the model reads of the heart, kept for as long as it beats.
struct HeartInputs {
  beat::Anatomy anatomy() const {
    return {mesh, surfaces, fibres, directions.across, directions.right, activation_ms, duration_ms};
  }

  const TetMesh& mesh;
  const HeartSurfaces& surfaces;
  const Fibres& fibres;
  beat::WallDirections directions;
  std::vector<float> activation_ms, duration_ms;
};

class MechanicsTask : public StageTask {
 public:
  MechanicsTask(HeartInputs inputs, beat::MadeHeart made, beat::HeartSteps steps, const BeatParams& params)
      : inputs_(std::move(inputs)),
        made_(std::move(made)),
        steps_(std::move(steps)),
        params_(params),
        record_(params, made_.heart->circulation->state_names(), steps_.now()) {}

  Result<bool> step(RunContext& ctx) override {
    const Result<bool> stepped = steps_.advance();
    if (!stepped) return stepped.error();
    if (!*stepped) return false;
    record_.add(steps_.now());
    const bool over = record_.is_over();
    if (1000 * steps_.now().time_s >= next_frame_ms_ - kRounding || over) emit(ctx);
    return over;
  }

  double fraction() const override {
    const double whole = params_.fill_ms + params_.period_ms * params_.beats;
    return (1000 * steps_.now().time_s + params_.fill_ms) / whole;
  }

  void finish(StageOutput& out) override {
    result_.beats = record_.beats();
    result_.change_percent = record_.change_percent();
    result_.has_cycle = record_.has_cycle();
    result_.steps = steps_.steps();
    result_.newton_iterations = steps_.newton_iterations();
    result_.trace_times_ms = record_.times_ms();
    result_.traces = record_.traces();
    for (const Trace& trace : result_.traces) digest_.update_values(trace.values.data(), trace.values.size());
    result_.digest = digest_.hex();
    out.put(std::move(result_));
  }

 private:
  static constexpr double kRounding = 1e-6;

  void emit(RunContext& ctx) {
    result_.last = {1000 * steps_.now().time_s, beat::heart_fields(inputs_.anatomy(), made_, steps_.now())};
    result_.times_ms.push_back(result_.last.time_ms);
    const auto since = static_cast<std::ptrdiff_t>(traced_);
    result_.last.trace_times_ms.assign(record_.times_ms().begin() + since, record_.times_ms().end());
    for (const Trace& trace : record_.traces())
      result_.last.traces.push_back(
          {trace.name, trace.title, trace.unit, {trace.values.begin() + since, trace.values.end()}});
    traced_ = record_.times_ms().size();
    for (const Field& field : result_.last.fields)
      digest_.update_values(field.values.data(), field.values.size());
    next_frame_ms_ = params_.frame_ms * std::floor(result_.last.time_ms / params_.frame_ms + 1 + kRounding);
    ctx.snapshot(result_.last);
  }

  HeartInputs inputs_;
  beat::MadeHeart made_;
  beat::HeartSteps steps_;
  BeatParams params_;
  beat::BeatRecord record_;
  double next_frame_ms_ = 0;
  std::size_t traced_ = 0;  ///< of the record's times those that frames have had
  MechanicsResult result_;
  Sha256 digest_;
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
                     {},     {}};
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
      std::move(inputs), std::move(made).value(), std::move(steps).value(), params));
}

}  // namespace voxtet
