#include "pipeline/stages/monodomain_stage.h"

#include <algorithm>

#include "base/digest.h"
#include "physics/monodomain/monodomain.h"
#include "pipeline/results/stage_results.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

/// Time between two values of a trace, ms.
constexpr double kTraceInterval = 1;
/// Points whose steps take some milliseconds.
constexpr std::size_t kShortPart = 30'000;

class MonodomainTask : public StageTask {
 public:
  MonodomainTask(Monodomain heart, const std::vector<Electrode>& electrodes) : heart_(std::move(heart)) {
    for (std::size_t e = 0; e < electrodes.size(); ++e)
      result_.traces.push_back(
          {"electrode_" + std::to_string(e),
           electrodes[e].name.empty() ? "Electrode " + std::to_string(e + 1) : electrodes[e].name,
           "mV",
           {}});
  }

  Result<bool> step(RunContext& ctx) override {
    if (result_.times_ms.empty()) emit(ctx);
    for (std::size_t worked = 0; worked < kShortPart && !heart_.done(); worked += heart_.points().size()) {
      const Result<bool> stepped = heart_.advance();
      if (!stepped) return stepped.error();
      if (!*stepped) continue;
      trace();
      if (heart_.frame_due()) emit(ctx);
    }
    return heart_.done();
  }
  double fraction() const override { return heart_.fraction(); }

  void finish(StageOutput& out) override {
    result_.fields = heart_.activation_fields();
    for (const Field& field : result_.fields) digest_.update_values(field.values.data(), field.values.size());
    for (const Trace& trace : result_.traces) digest_.update_values(trace.values.data(), trace.values.size());
    result_.digest = digest_.hex();
    out.put(std::move(result_));
  }

 private:
  void emit(RunContext& ctx) {
    result_.last = {heart_.time_ms(), {heart_.voltage()}};
    result_.times_ms.push_back(heart_.time_ms());
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
  Trajectory result_;
  Sha256 digest_;
  std::size_t traced_ = 0;
};

}  // namespace

Result<std::unique_ptr<StageTask>> start_monodomain(const StageInputs& in, const Recipe& recipe) {
  if (!recipe.physics || !recipe.physics->monodomain)
    return usage_error(kMonodomainStage,
                       "physics.monodomain: found none, expected when and how long to simulate");
  const MonodomainParams& params = *recipe.physics->monodomain;
  Result<Monodomain> heart =
      Monodomain::start(in.get<TetMesh>(Stage::kOptimise), in.get<TissueResult>(Stage::kTissue).tissue,
                        recipe.physics->stimuli, params);
  if (!heart) return heart.error();
  return std::unique_ptr<StageTask>(
      std::make_unique<MonodomainTask>(std::move(heart).value(), params.electrodes));
}

}  // namespace voxtet
