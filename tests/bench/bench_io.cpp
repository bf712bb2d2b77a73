// Speed and size of every mesh format, in memory, for a cube of 512 thousand tetrahedra and three labels.
#include <benchmark/benchmark.h>

#include <numeric>

#include "io/mesh/write_mesh.h"
#include "support/labelled_mesh.h"

namespace voxtet {
namespace {

void BM_WriteMesh(benchmark::State& state, MeshFormat format) {
  static const TetMesh mesh = test::kuhn_cube(44);
  std::size_t bytes = 0;
  for (auto _ : state) {
    const std::vector<OutputFile> files = write_tet_mesh(mesh, format, {}).value();
    bytes = std::accumulate(files.begin(), files.end(), std::size_t{0},
                            [](std::size_t sum, const OutputFile& file) { return sum + file.bytes.size(); });
    benchmark::DoNotOptimize(files.data());
  }
  state.counters["MB"] = static_cast<double>(bytes) / 1e6;
  state.counters["tets/s"] = benchmark::Counter(static_cast<double>(mesh.tets.size()),
                                                benchmark::Counter::kIsIterationInvariantRate);
}
#define VOXTET_FORMAT(name, format) \
  BENCHMARK_CAPTURE(BM_WriteMesh, name, MeshFormat::format)->Unit(benchmark::kMillisecond)
VOXTET_FORMAT(vtu, kVtu);
VOXTET_FORMAT(msh, kMsh);
VOXTET_FORMAT(medit, kMedit);
VOXTET_FORMAT(carp, kCarp);
VOXTET_FORMAT(inp, kAbaqus);
VOXTET_FORMAT(feb, kFebio);
VOXTET_FORMAT(xdmf, kXdmf);
VOXTET_FORMAT(stl, kStl);
VOXTET_FORMAT(ply, kPly);

}  // namespace
}  // namespace voxtet
