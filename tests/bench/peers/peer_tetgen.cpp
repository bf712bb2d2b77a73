// TetGen with the switches of VARIANT: `paper` pYAq1.414, `angles` pYAq1.414/14o/145.
#include "bench/peers/fill_peer.h"
#include "tetra/backends/tetgen_backend.h"
#include "tetra/fill/hole_seeds.h"
#include "tetra/mesh/edge_groups.h"

using namespace voxtet;

namespace {

Result<peers::Filled> fill(const peers::FillTask& task, const std::string& variant) {
  TetgenOptions options;
  options.radius_edge = 1.414;
  options.min_dihedral_deg = variant == "paper" ? 0 : 14;
  options.max_dihedral_deg = variant == "paper" ? 0 : 145;
  const EdgeGroups edges(task.surface);
  Result<FilledParts> mesh =
      run_tetgen(task.surface, find_hole_seeds(task.surface, edges), task.sizing, options, {});
  if (!mesh) return mesh.error();
  return peers::Filled{std::move(mesh->points), std::move(mesh->tets)};
}

}  // namespace

int main(int argc, char** argv) {
  return peers::fill_main(argc, argv, fill);
}
