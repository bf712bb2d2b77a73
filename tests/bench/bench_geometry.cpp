// What exact signs cost: of points in general position, and where only exact arithmetic knows.
#include <benchmark/benchmark.h>

#include <array>
#include <cstddef>
#include <vector>

#include "geometry/elements/orientation.h"
#include "geometry/intersect/self_intersections.h"
#include "support/label_bodies.h"
#include "support/test_random.h"
#include "surface/extract/extract_surface.h"

namespace voxtet {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// Coordinates of `values` values, a tenth apart.
Points lattice_points(int values) {
  test::TestRandom random(1);
  Points points(4096);
  for (Eigen::Vector3d& p : points)
    for (int d = 0; d < 3; ++d) p[d] = 0.3 + 0.1 * random.below(values);
  return points;
}

void BM_Orientation(benchmark::State& state) {
  const Points points = lattice_points(static_cast<int>(state.range(0)));
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(orientation(points[i], points[i + 1], points[i + 2], points[i + 3]));
    i = (i + 1) % (points.size() - 3);
  }
}
BENCHMARK(BM_Orientation)->ArgName("values")->Arg(2)->Arg(3)->Arg(1 << 20);

/// The faces of the surface lie in many common planes before it is smoothed.
void BM_SelfIntersectionsOfRawSurface(benchmark::State& state) {
  RunContext ctx;
  const SurfaceMesh surface = extract_surface(test::heart_volume(69, 50, 62), {}, ctx).value();
  for (auto _ : state) benchmark::DoNotOptimize(find_self_intersections(surface));
  state.counters["triangles"] = static_cast<double>(surface.triangles.size());
}
BENCHMARK(BM_SelfIntersectionsOfRawSurface)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace voxtet
