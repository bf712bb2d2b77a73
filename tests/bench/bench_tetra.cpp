// Tetrahedra a second of fill_tets on a shell (radii 20 and 30 mm, 40960 triangles) and what its checks cost.
#include <benchmark/benchmark.h>

#include "geometry/intersect/self_intersections.h"
#include "support/test_surfaces.h"
#include "tetra/fill/fill_tets.h"

namespace voxtet {
namespace {

SurfaceMesh shell() {
  SurfaceMesh surface = test::sphere({0, 0, 0}, 30, 5, 1, 0);
  test::append(surface, test::sphere({0, 0, 0}, 20, 5, 0, 1));
  return surface;
}

void fill_shell(benchmark::State& state) {
  const SurfaceMesh surface = shell();
  const SizingField sizing = test::uniform_sizing(static_cast<double>(state.range(0)) / 10);
  RunContext ctx;
  std::size_t tets = 0;
  for (auto _ : state) {
    const auto mesh = fill_tets(surface, sizing, {}, ctx);
    if (!mesh) return state.SkipWithError(mesh.error().message.c_str());
    tets += mesh->tets.size();
  }
  state.counters["tets/s"] = benchmark::Counter(static_cast<double>(tets), benchmark::Counter::kIsRate);
}
BENCHMARK(fill_shell)->Arg(10)->Arg(20)->Unit(benchmark::kMillisecond);

void search_self_intersections(benchmark::State& state) {
  const SurfaceMesh surface = shell();
  for (auto _ : state) benchmark::DoNotOptimize(find_self_intersections(surface));
}
BENCHMARK(search_self_intersections)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace voxtet
