// Wall thickness and gradation on a heart of 256 voxels' length.
#include <benchmark/benchmark.h>

#include "support/large_heart.h"

namespace voxtet {
namespace {

const test::LargeHeart& heart() {
  static const test::LargeHeart heart;
  return heart;
}

void BM_WallThickness(benchmark::State& state) {
  RunContext ctx;
  ctx.threads = static_cast<int>(state.range(0));
  heart();
  for (auto _ : state) benchmark::DoNotOptimize(heart().wall(ctx));
  state.counters["triangles"] = static_cast<double>(heart().surface.triangles.size());
  state.counters["wall_voxels"] =
      static_cast<double>(std::count_if(heart().meshed.labels.begin(), heart().meshed.labels.end(),
                                        [](Label label) { return label != kBackground; }));
}
BENCHMARK(BM_WallThickness)->ArgName("threads")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

void BM_Gradation(benchmark::State& state) {
  const std::vector<float> target = heart().target_sizes();
  RunContext ctx;
  for (auto _ : state) {
    state.PauseTiming();
    std::vector<float> sizes = target;
    state.ResumeTiming();
    heart().limit(sizes, ctx);
    benchmark::DoNotOptimize(sizes.data());
  }
}
BENCHMARK(BM_Gradation)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace voxtet
