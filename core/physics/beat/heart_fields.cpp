#include "physics/beat/heart_fields.h"

#include <limits>
#include <utility>

#include "physics/fem/element.h"

namespace voxtet::beat {

std::vector<Field> heart_fields(const Anatomy& anatomy, const MadeHeart& made, const HeartMotion& motion) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  const TetMesh& mesh = anatomy.mesh;
  Field displacement{"displacement_mm", "Displacement", "mm", On::kPoints, Scale::kSequential, 3, {}};
  displacement.values.assign(3 * mesh.points.size(), 0);
  std::vector<Eigen::Vector3d> moved(mesh.points.size(), Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < made.points.size(); ++i) {
    moved[made.points[i]] = motion.u.segment<3>(3 * static_cast<Eigen::Index>(i));
    for (int d = 0; d < 3; ++d)
      displacement.values[3 * made.points[i] + static_cast<std::size_t>(d)] =
          static_cast<float>(moved[made.points[i]][d]);
  }
  Field strain{"fibre_strain_percent", "Fibre strain", "%", On::kTets, Scale::kDiverging, 1, {}};
  Field thickening{"thickening_percent", "Wall thickening", "%", On::kTets, Scale::kDiverging, 1, {}};
  Field active{"active_stress_kpa", "Active stress", "kPa", On::kTets, Scale::kSequential, 1, {}};
  for (Field* field : {&strain, &thickening, &active}) field->values.assign(mesh.tets.size(), kNone);
  const std::vector<double> tension = made.heart->tension_kpa(motion.time_s);
  for (std::size_t i = 0; i < made.tets.size(); ++i) {
    const std::uint32_t t = made.tets[i];
    const auto gradient = fem::element_of(mesh, t).gradient;
    Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
    for (std::size_t a = 0; a < 4; ++a) f += moved[mesh.tets[t][a]] * gradient[a].transpose();
    const auto longer_percent = [&](const Eigen::Vector3d& direction) {
      return static_cast<float>(100 * ((f * direction).norm() - 1));
    };
    strain.values[t] = longer_percent(anatomy.fibres.fibre[t]);
    thickening.values[t] = longer_percent(anatomy.across[t]);
    active.values[t] = static_cast<float>(tension[i]);
  }
  return {std::move(displacement), std::move(strain), std::move(thickening), std::move(active)};
}

}  // namespace voxtet::beat
