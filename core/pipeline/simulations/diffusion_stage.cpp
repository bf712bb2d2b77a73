#include "pipeline/simulations/diffusion_stage.h"

#include "base/digest.h"
#include "physics/diffusion/diffusion.h"
#include "pipeline/results/stage_results.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

class DiffusionTask : public StageTask {
 public:
  explicit DiffusionTask(Diffusion diffusion) : diffusion_(std::move(diffusion)) {}

  Result<bool> step(RunContext& ctx) override {
    if (result_.times_ms.empty()) emit(ctx);
    const Result<bool> stepped = diffusion_.advance(diffusion_.short_part());
    if (!stepped) return stepped.error();
    if (*stepped && diffusion_.frame_due()) emit(ctx);
    return diffusion_.done();
  }
  double fraction() const override { return diffusion_.fraction(); }
  void finish(StageOutput& out) override {
    result_.digest = frames_.hex();
    out.put(std::move(result_));
  }

 private:
  void emit(RunContext& ctx) {
    result_.last = {diffusion_.time_ms(), {diffusion_.temperature()}};
    result_.times_ms.push_back(diffusion_.time_ms());
    const std::vector<float>& values = result_.last.fields[0].values;
    frames_.update_values(values.data(), values.size());
    ctx.snapshot(result_.last);
  }

  Diffusion diffusion_;
  Trajectory result_;
  Sha256 frames_;
};

}  // namespace

Result<std::unique_ptr<StageTask>> start_diffusion(const StageInputs& in, const Recipe& recipe) {
  if (!recipe.physics || !recipe.physics->diffusion)
    return usage_error(kDiffusionStage, "physics.diffusion: found none, expected what is to spread");
  Result<Diffusion> diffusion =
      Diffusion::start(in.share<TetMesh>(Stage::kOptimise), *recipe.physics->diffusion);
  if (!diffusion) return diffusion.error();
  return std::unique_ptr<StageTask>(std::make_unique<DiffusionTask>(std::move(diffusion).value()));
}

}  // namespace voxtet
