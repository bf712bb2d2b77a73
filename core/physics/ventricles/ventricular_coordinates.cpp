#include "physics/ventricles/ventricular_coordinates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "geometry/elements/surface_measures.h"
#include "physics/fem/element.h"
#include "physics/ventricles/wall_depth.h"
#include "physics/ventricles/wall_frame.h"
#include "physics/ventricles/wall_system.h"

namespace voxtet {
namespace {

/// Weighted by area. At least one face of this kind.
Eigen::Vector3d centroid_of(const TetMesh& mesh, const HeartSurfaces& surfaces, HeartSurface surface) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (surfaces.faces[f] != surface) continue;
    const auto& [i, j, k] = mesh.faces[f];
    const Eigen::Vector3d &a = mesh.points[i], &b = mesh.points[j], &c = mesh.points[k];
    const double own = triangle_area_mm2(a, b, c);
    sum += own / 3 * (a + b + c);
    area += own;
  }
  return sum / area;
}

/// For each point the integral of X . grad phi_i, where X is the gradient of u divided by its norm: the load
/// with which K a = load gives the a whose gradient is nearest to X.
Eigen::VectorXd load_of_directions(const TetMesh& mesh, const std::vector<bool>& wall,
                                   const Eigen::VectorXd& u) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(u.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (!wall[t]) continue;
    const fem::Element element = fem::element_of(mesh, t);
    const Eigen::Vector3d gradient = gradient_on(mesh, u, t);
    const double length = gradient.norm();
    if (length == 0) continue;
    for (std::size_t i = 0; i < 4; ++i)
      load[mesh.tets[t][i]] += element.volume * gradient.dot(element.gradient[i]) / length;
  }
  return load;
}

Result<std::vector<float>> apicobasal(const TetMesh& mesh, const HeartSurfaces& surfaces,
                                      const VentricularPotentials& potentials, const RunContext& ctx) {
  const auto system = wall_system(mesh, surfaces);
  if (!system) return system.error();
  const Eigen::VectorXd load = load_of_directions(mesh, surfaces.wall, potentials.base);
  const PointValues on_base = values_on(*system, {{HeartSurface::kBase, 0}});
  PointValues at_apex = values_on(*system, {});
  at_apex[surfaces.apex] = 0;
  const auto from_apex = solve_on_wall(*system, at_apex, load, ctx);
  if (!from_apex) return from_apex.error();
  const auto to_base = solve_on_wall(*system, on_base, -load, ctx);
  if (!to_base) return to_base.error();

  std::vector<float> values;
  for (Eigen::Index i = 0; i < load.size(); ++i) {
    const double a = (*from_apex)[i], b = (*to_base)[i];
    // Lengths that are negative by the error of the elements; NaN stays NaN.
    values.push_back(static_cast<float>(a <= 0 ? 0 : b <= 0 ? 1 : a / (a + b)));
  }
  return values;
}

/// The angle about the long axis.
struct LongAxis {
  Eigen::Vector3d apex, zero, quarter;  ///< directions of the angles 0 and pi / 2

  LongAxis(const TetMesh& mesh, const HeartSurfaces& surfaces) : apex(mesh.points[surfaces.apex]) {
    constexpr double kNearlyAlong = 0.99;
    const Eigen::Vector3d axis = unit_along(centroid_of(mesh, surfaces, HeartSurface::kLvEndocardium) - apex);
    const Eigen::Vector3d towards =
        surfaces.right ? Eigen::Vector3d(centroid_of(mesh, surfaces, HeartSurface::kRvSeptum) - apex)
        : std::abs(axis.x()) < kNearlyAlong ? Eigen::Vector3d::UnitX()
                                            : Eigen::Vector3d::UnitY();
    zero = unit_across(towards, axis);
    quarter = axis.cross(zero);
  }
  double angle(const Eigen::Vector3d& point) const {
    return std::atan2(quarter.dot(point - apex), zero.dot(point - apex));
  }
};

}  // namespace

Result<std::vector<Field>> ventricular_coordinates(const TetMesh& mesh, const HeartSurfaces& surfaces,
                                                   const VentricularPotentials& potentials,
                                                   const RunContext& ctx) {
  auto along = apicobasal(mesh, surfaces, potentials, ctx);
  if (!along) return along.error();
  const WallDepth depth(mesh, surfaces);
  const LongAxis axis(mesh, surfaces);
  const std::vector<float> none(mesh.points.size(), std::numeric_limits<float>::quiet_NaN());
  std::vector<float> transmural = none, rotational = none, ventricle = none;
  parallel_for(ctx.threads, mesh.points.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const double free_wall = potentials.free_wall[static_cast<Eigen::Index>(i)];
      if (std::isnan(free_wall)) continue;
      const bool right = free_wall > 0.5;
      transmural[i] = static_cast<float>(depth.at(mesh.points[i], right));
      rotational[i] = static_cast<float>(axis.angle(mesh.points[i]));
      ventricle[i] = right ? 1 : 0;
    }
  });
  return std::vector<Field>{
      {"transmural", "Depth in the wall", "1", On::kPoints, Scale::kSequential, 1, std::move(transmural)},
      {"apicobasal", "From apex to base", "1", On::kPoints, Scale::kSequential, 1, *std::move(along)},
      {"rotational", "Angle about the long axis", "rad", On::kPoints, Scale::kDiverging, 1,
       std::move(rotational)},
      {"ventricle", "Ventricle (0 left, 1 right)", "1", On::kPoints, Scale::kWhole, 1, std::move(ventricle)}};
}

}  // namespace voxtet
