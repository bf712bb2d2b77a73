#include "physics/ventricles/ventricular_potentials.h"

#include <utility>

#include "physics/ventricles/wall_system.h"
#include "types/stage_names.h"

namespace voxtet {

Result<VentricularPotentials> ventricular_potentials(const TetMesh& mesh, const HeartSurfaces& surfaces,
                                                     const RunContext& ctx) {
  using enum HeartSurface;
  const auto system = wall_system(mesh, surfaces);
  if (!system) return system.error();
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(mesh.points.size()));

  VentricularPotentials potentials;
  PointValues along = values_on(*system, {{kBase, 1}});
  along[surfaces.apex] = 0;
  struct Solve {
    Eigen::VectorXd& to;
    PointValues held;
  };
  std::vector<Solve> solves{
      {potentials.lv,
       values_on(*system, {{kEpicardium, 0}, {kLvEndocardium, 1}, {kRvSeptum, 0}, {kRvEndocardium, 0}})},
      {potentials.base, std::move(along)}};
  if (surfaces.right) {
    solves.push_back(
        {potentials.rv,
         values_on(*system, {{kEpicardium, 0}, {kLvEndocardium, 0}, {kRvSeptum, 1}, {kRvEndocardium, 1}})});
    // The mean is 1/2 at the line where the free wall and the septum meet.
    solves.push_back({potentials.free_wall,
                      (values_on(*system, {{kLvEndocardium, 0}, {kRvSeptum, 0}, {kRvEndocardium, 1}}) +
                       values_on(*system, {{kLvEndocardium, 0}, {kRvEndocardium, 1}, {kRvSeptum, 0}})) /
                          2});
  }
  for (std::size_t i = 0; i < solves.size(); ++i) {
    ctx.progress(kFibresStage, static_cast<double>(i) / static_cast<double>(solves.size()));
    auto solved = solve_on_wall(*system, solves[i].held, nothing, ctx);
    if (!solved) return solved.error();
    solves[i].to = *std::move(solved);
  }
  // Outside of the wall these are NaN too.
  if (!surfaces.right) potentials.rv = potentials.free_wall = 0 * potentials.lv;
  potentials.epi = Eigen::VectorXd::Ones(nothing.size()) - potentials.lv - potentials.rv;
  return potentials;
}

bool is_right(const TetMesh& mesh, const VentricularPotentials& potentials, std::size_t tet) {
  return mean_on(mesh, potentials.free_wall, tet) > 0.5;
}

}  // namespace voxtet
