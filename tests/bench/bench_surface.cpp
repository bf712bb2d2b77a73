// Throughput of surface extraction and smoothing on a heart-like volume of four labels.
#include <benchmark/benchmark.h>

#include "support/label_bodies.h"
#include "surface/extract/extract_surface.h"
#include "surface/smooth/smooth_surface.h"

namespace voxtet {
namespace {

const LabelVolume& heart() {
  static const LabelVolume volume = test::heart_volume(138, 100, 124);
  return volume;
}

void BM_ExtractSurface(benchmark::State& state) {
  RunContext ctx;
  ExtractParams params;
  params.method = static_cast<ExtractMethod>(state.range(0));
  std::size_t triangles = 0;
  for (auto _ : state) {
    const SurfaceMesh surface = extract_surface(heart(), params, ctx).value();
    triangles = surface.triangles.size();
    benchmark::DoNotOptimize(surface.points.data());
  }
  const auto rate = benchmark::Counter::kIsIterationInvariantRate;
  state.counters["voxels/s"] = benchmark::Counter(static_cast<double>(heart().voxel_count()), rate);
  state.counters["triangles/s"] = benchmark::Counter(static_cast<double>(triangles), rate);
  state.counters["triangles"] = static_cast<double>(triangles);
}
BENCHMARK(BM_ExtractSurface)
    ->ArgName("method")
    ->Arg(static_cast<int>(ExtractMethod::kMarchingCubes))
    ->Arg(static_cast<int>(ExtractMethod::kMarchingTets))
    ->Unit(benchmark::kMillisecond);

void BM_SmoothSurface(benchmark::State& state) {
  RunContext ctx;
  ExtractParams extract;
  extract.method = static_cast<ExtractMethod>(state.range(0));
  const SurfaceMesh surface = extract_surface(heart(), extract, ctx).value();
  for (auto _ : state)
    benchmark::DoNotOptimize(smooth_surface(surface, heart(), {}, ctx).value().points.data());
  state.counters["triangles"] = static_cast<double>(surface.triangles.size());
}
BENCHMARK(BM_SmoothSurface)
    ->ArgName("method")
    ->Arg(static_cast<int>(ExtractMethod::kMarchingCubes))
    ->Arg(static_cast<int>(ExtractMethod::kMarchingTets))
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace voxtet
