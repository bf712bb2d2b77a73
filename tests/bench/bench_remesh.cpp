// The adapted surface of a heart-like volume of four labels, at three edge lengths.
#include <benchmark/benchmark.h>

#include "remesh/adapt/adapt_complex.h"
#include "remesh/field/label_field.h"
#include "remesh/remesh_surface.h"
#include "support/label_bodies.h"
#include "support/label_surface.h"
#include "support/test_surfaces.h"

namespace voxtet {
namespace {

const LabelVolume& heart() {
  static const LabelVolume volume = test::heart_volume(138, 100, 124);
  return volume;
}

const SurfaceMesh& heart_surface() {
  static const SurfaceMesh surface = test::label_surface(heart());
  return surface;
}

void BM_BuildLabelField(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(remesh::LabelField(heart(), heart_surface()).size());
  state.counters["voxels/s"] = benchmark::Counter(static_cast<double>(heart().voxel_count()),
                                                  benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(BM_BuildLabelField)->Unit(benchmark::kMillisecond);

void BM_RemeshSurface(benchmark::State& state) {
  const SizingField sizing = test::uniform_sizing(0.1 * static_cast<double>(state.range(0)));
  RunContext ctx;
  std::size_t triangles = 0;
  for (auto _ : state) {
    const SurfaceMesh surface = remesh_surface(heart(), heart_surface(), sizing, {}, ctx).value();
    triangles = surface.triangles.size();
    benchmark::DoNotOptimize(surface.points.data());
  }
  state.counters["triangles"] = static_cast<double>(triangles);
  state.counters["triangles/s"] =
      benchmark::Counter(static_cast<double>(triangles), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(BM_RemeshSurface)
    ->ArgName("edge_tenths_mm")
    ->Arg(15)
    ->Arg(20)
    ->Arg(30)
    ->Unit(benchmark::kMillisecond);

void BM_AdaptComplex(benchmark::State& state) {
  const SizingField sizing = test::uniform_sizing(0.1 * static_cast<double>(state.range(0)));
  RunContext ctx;
  const SurfaceMesh& reference = heart_surface();
  std::size_t triangles = 0;
  for (auto _ : state) {
    const SurfaceMesh surface = remesh::adapt_complex(reference, sizing, {}, ctx).value();
    triangles = surface.triangles.size();
    benchmark::DoNotOptimize(surface.points.data());
  }
  state.counters["triangles"] = static_cast<double>(triangles);
  state.counters["input/s"] = benchmark::Counter(static_cast<double>(reference.triangles.size()),
                                                 benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(BM_AdaptComplex)->ArgName("edge_tenths_mm")->Arg(20)->Arg(30)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace voxtet
