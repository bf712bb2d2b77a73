// Wall thickness and gradation on a heart of 256 voxels' length.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "phantom/make_phantom.h"
#include "sizing/limit_gradation.h"
#include "sizing/measure_wall.h"
#include "surface/extract_surface.h"
#include "surface/smooth_surface.h"

namespace voxtet {
namespace {

/// 256 x 215 x 219 voxels, three million of them in the wall.
const LabelVolume& heart() {
  static const LabelVolume volume = [] {
    PhantomParams params;
    params.spacing_mm.setConstant(0.36);
    return make_phantom(params).value();
  }();
  return volume;
}

void BM_WallThickness(benchmark::State& state) {
  RunContext ctx;
  ctx.threads = static_cast<int>(state.range(0));
  LabelVolume meshed = heart();
  std::replace_if(
      meshed.labels.begin(), meshed.labels.end(), [](Label label) { return label > 2; }, kBackground);
  const SurfaceMesh surface =
      smooth_surface(extract_surface(meshed, {}, ctx).value(), meshed, {}, ctx).value();
  for (auto _ : state)
    benchmark::DoNotOptimize(
        measure_wall({heart(), meshed, surface}, {{1, 2}, {3, 4}}, "sizing.thickness[0]", ctx));
  state.counters["triangles"] = static_cast<double>(surface.triangles.size());
  state.counters["wall_voxels"] = static_cast<double>(std::count_if(
      meshed.labels.begin(), meshed.labels.end(), [](Label label) { return label != kBackground; }));
}
BENCHMARK(BM_WallThickness)->ArgName("threads")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

/// The field of a heart whose right ventricle wants half the size.
void BM_Gradation(benchmark::State& state) {
  constexpr int kSize = 256;
  std::vector<float> wished(static_cast<std::size_t>(kSize) * kSize * kSize, 50.F);
  for (int k = 0; k < heart().size[2]; ++k)
    for (int j = 0; j < heart().size[1]; ++j)
      for (int i = 0; i < std::min(heart().size[0], kSize); ++i)
        if (const Label label = heart().at(i, j, k); label == 1 || label == 2)
          wished[static_cast<std::size_t>(i + kSize * (j + kSize * k))] = label == 1 ? 2.F : 1.F;
  RunContext ctx;
  for (auto _ : state) {
    state.PauseTiming();
    std::vector<float> sizes = wished;
    state.ResumeTiming();
    limit_gradation({kSize, kSize, kSize}, heart().linear(), 0.3, sizes, ctx);
    benchmark::DoNotOptimize(sizes.data());
  }
}
BENCHMARK(BM_Gradation)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace voxtet
