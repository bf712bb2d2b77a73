// Nanoseconds a tetrahedron of solve_eikonal on a shell (radii 20 and 30 mm) with fibres around it.
#include <benchmark/benchmark.h>

#include <Eigen/Geometry>

#include "physics/eikonal/solve_eikonal.h"
#include "support/test_surfaces.h"
#include "support/uniform_tissue.h"
#include "tetra/fill/fill_tets.h"

namespace voxtet {
namespace {

/// Edges of so many tenths of a millimetre.
TetMesh shell(std::int64_t tenths) {
  SurfaceMesh surface = test::sphere({0, 0, 0}, 30, 5, 1, 0);
  test::append(surface, test::sphere({0, 0, 0}, 20, 5, 0, 1));
  RunContext ctx;
  return fill_tets(surface, test::uniform_sizing(static_cast<double>(tenths) / 10), {}, ctx).value();
}

Tissue tissue_around(const TetMesh& mesh) {
  Tissue tissue = test::uniform_tissue(mesh, 0.5, 0.2, Eigen::Vector3d::UnitZ());
  tissue.fibre.clear();
  for (const Tet& tet : mesh.tets)
    tissue.fibre.push_back(Eigen::Vector3d::UnitZ().cross(test::centroid(mesh, tet)).normalized());
  return tissue;
}

void solve_shell(benchmark::State& state) {
  const TetMesh mesh = shell(state.range(0));
  const Tissue tissue = tissue_around(mesh);
  const EikonalSource source{0, 0};
  RunContext ctx;
  std::size_t tets = 0;
  for (auto _ : state) {
    const auto times = solve_eikonal(mesh, tissue, {&source, 1}, ctx);
    if (!times) return state.SkipWithError(times.error().message.c_str());
    tets += mesh.tets.size();
  }
  state.counters["tets"] = static_cast<double>(mesh.tets.size());
  state.counters["s/tet"] = benchmark::Counter(static_cast<double>(tets),
                                               benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(solve_shell)->Arg(10)->Arg(20)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace voxtet
