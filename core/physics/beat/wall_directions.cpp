#include "physics/beat/wall_directions.h"

#include "physics/ventricles/wall_frame.h"
#include "physics/ventricles/wall_system.h"

namespace voxtet::beat {

WallDirections wall_directions(const TetMesh& mesh, const HeartSurfaces& surfaces,
                               const VentricularPotentials& potentials) {
  WallDirections out{std::vector<bool>(mesh.tets.size(), false),
                     std::vector<Eigen::Vector3d>(mesh.tets.size(), Eigen::Vector3d::Zero())};
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (!surfaces.wall[t]) continue;
    out.right[t] = is_right(mesh, potentials, t);
    out.across[t] = unit_along(-gradient_on(mesh, out.right[t] ? potentials.rv : potentials.lv, t));
  }
  return out;
}

}  // namespace voxtet::beat
