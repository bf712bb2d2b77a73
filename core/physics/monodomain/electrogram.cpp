#include "physics/monodomain/electrogram.h"

#include <algorithm>
#include <cmath>

#include "physics/fem/element.h"
#include "physics/monodomain/membrane_voltage.h"

namespace voxtet {
namespace {

constexpr double kConductivityPerDiffusivity = 140 * 0.01;  // S/m for mm^2/ms
constexpr double kBathConductivity = 1;                     // S/m
constexpr double kElectrodeRadius = 0.5;                    // mm

}  // namespace

Eigen::VectorXd electrogram_weights(const ConductingMesh& tissue, const Eigen::Vector3d& at_mm) {
  const TetMesh& mesh = tissue.mesh;
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(mesh.points.size()));
  const double factor = -kVoltageRangeMv * kConductivityPerDiffusivity / (4 * EIGEN_PI * kBathConductivity);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const fem::Element element = fem::element_of(mesh, t);
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
    for (const std::uint32_t point : mesh.tets[t]) centroid += mesh.points[point] / 4;
    const Eigen::Vector3d away = centroid - at_mm;
    const double r2 = std::max(away.squaredNorm(), kElectrodeRadius * kElectrodeRadius);
    const Eigen::Vector3d grad_of_inverse = -away / (r2 * std::sqrt(r2));
    const Eigen::Vector3d seen = factor * element.volume * (tissue.diffusivity[t] * grad_of_inverse);
    for (std::size_t c = 0; c < 4; ++c) weights[mesh.tets[t][c]] += seen.dot(element.gradient[c]);
  }
  return weights;
}

}  // namespace voxtet
