#include "physics/ventricles/ventricular_fibres.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <vector>

#include "base/parallel.h"
#include "physics/fem/element.h"
#include "physics/ventricles/bislerp.h"
#include "physics/ventricles/wall_depth.h"
#include "physics/ventricles/wall_frame.h"
#include "physics/ventricles/wall_system.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

using Gradients = std::vector<Eigen::Vector3d>;

/// At the points: means over the tetrahedra of the wall around them, by volume.
Gradients gradients_at_points(const TetMesh& mesh, const std::vector<bool>& wall, const Eigen::VectorXd& u) {
  Gradients sum(mesh.points.size(), Eigen::Vector3d::Zero());
  std::vector<double> volume(mesh.points.size(), 0);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (!wall[t]) continue;
    const double own = fem::element_of(mesh, t).volume;
    const Eigen::Vector3d gradient = gradient_on(mesh, u, t);
    for (const std::uint32_t point : mesh.tets[t]) {
      sum[point] += own * gradient;
      volume[point] += own;
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (volume[i] > 0) sum[i] /= volume[i];
  return sum;
}

FibreAngles mixed(const FibreAngles& a, const FibreAngles& b, double t) {
  const auto mix = [t](double x, double y) { return (1 - t) * x + t * y; };
  return {mix(a.alpha_endo, b.alpha_endo), mix(a.alpha_epi, b.alpha_epi), mix(a.beta_endo, b.beta_endo),
          mix(a.beta_epi, b.beta_epi)};
}

/// The rules, at places in tetrahedra that are given by the shares of their corners.
class Rules {
 public:
  Rules(const TetMesh& mesh, const HeartSurfaces& surfaces, const VentricularPotentials& potentials,
        const FibreParams& params)
      : mesh_(mesh),
        potentials_(potentials),
        params_(params),
        depth_(mesh, surfaces),
        lv_(gradients_at_points(mesh, surfaces.wall, potentials.lv)),
        rv_(gradients_at_points(mesh, surfaces.wall, potentials.rv)),
        base_(gradients_at_points(mesh, surfaces.wall, potentials.base)) {}

  /// Columns fibre, sheet normal, sheet.
  Eigen::Matrix3d at(std::size_t tet, const CornerShares& shares) const {
    return params_.rule == FibreRule::kBayer ? bayer(tet, shares) : linear(tet, shares);
  }

 private:
  Eigen::Vector3d mean(const Gradients& gradients, std::size_t tet, const CornerShares& shares) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < 4; ++i) sum += shares[i] * gradients[mesh_.tets[tet][i]];
    return sum;
  }

  double mean(const Eigen::VectorXd& values, std::size_t tet, const CornerShares& shares) const {
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += shares[i] * values[mesh_.tets[tet][i]];
    return sum;
  }

  /// How much a place in the wall of one ventricle is of the septum: 0 to 1.
  double septal_share(std::size_t tet, const CornerShares& shares, bool right) const {
    const double far = std::max(0.0, mean(right ? potentials_.lv : potentials_.rv, tet, shares));
    const double epi = std::max(0.0, mean(potentials_.epi, tet, shares));
    return far > 0 ? far / (far + epi) : 0;
  }

  Eigen::Matrix3d linear(std::size_t tet, const CornerShares& shares) const {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < 4; ++i) place += shares[i] * mesh_.points[mesh_.tets[tet][i]];
    const bool right = is_right(mesh_, potentials_, tet);
    const double u = depth_.at(place, right);
    const FibreAngles a = params_.septum && !right
                              ? mixed(params_.wall, *params_.septum, septal_share(tet, shares, right))
                              : params_.wall;
    const Eigen::Matrix3d frame =
        frame_outwards(-mean(right ? rv_ : lv_, tet, shares), mean(base_, tet, shares));
    return turned(frame, (1 - u) * a.alpha_endo + u * a.alpha_epi, (1 - u) * a.beta_endo + u * a.beta_epi);
  }

  Eigen::Matrix3d bayer(std::size_t tet, const CornerShares& shares) const {
    const double lv = mean(potentials_.lv, tet, shares), rv = mean(potentials_.rv, tet, shares);
    const double epi = std::clamp(mean(potentials_.epi, tet, shares), 0.0, 1.0);
    const double d = lv + rv > 0 ? std::clamp(rv / (lv + rv), 0.0, 1.0) : 0.5;
    const FibreAngles& wall = params_.wall;
    const FibreAngles both_sides{wall.alpha_endo, -wall.alpha_endo, wall.beta_endo, -wall.beta_endo};
    const FibreAngles endo =
        params_.septum
            ? mixed(both_sides, *params_.septum, septal_share(tet, shares, is_right(mesh_, potentials_, tet)))
            : both_sides;
    const double alpha_endo = (1 - d) * endo.alpha_endo + d * endo.alpha_epi;
    const double beta_endo = (1 - d) * endo.beta_endo + d * endo.beta_epi;
    const double alpha_wall = (1 - epi) * wall.alpha_endo + epi * wall.alpha_epi;
    const double beta_wall = (1 - epi) * wall.beta_endo + epi * wall.beta_epi;

    const Eigen::Vector3d to_base = mean(base_, tet, shares), to_lv = mean(lv_, tet, shares),
                          to_rv = mean(rv_, tet, shares);
    const auto frame = [&](const Eigen::Vector3d& outwards, double alpha, double beta) {
      return turned(frame_to_base(outwards, to_base), alpha, beta);
    };
    const Eigen::Matrix3d endo_frame =
        bislerp(frame(-to_lv, alpha_endo, beta_endo), frame(to_rv, alpha_endo, beta_endo), d);
    // epi is 1 - lv - rv.
    return bislerp(endo_frame, frame(-to_lv - to_rv, alpha_wall, beta_wall), epi);
  }

  const TetMesh& mesh_;
  const VentricularPotentials& potentials_;
  const FibreParams& params_;
  WallDepth depth_;
  Gradients lv_, rv_, base_;
};

/// Of the largest eigenvalue of a symmetric matrix, of which the lower triangle is read.
Eigen::Vector3d principal_direction(const Eigen::Matrix3d& tensor) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor).eigenvectors().col(2);
}

}  // namespace

Result<Fibres> tet_fibres(const TetMesh& mesh, const HeartSurfaces& surfaces,
                          const VentricularPotentials& potentials, const FibreParams& params,
                          const RunContext& ctx, std::span<const CornerShares> places) {
  if (Status checked = check_fibre_params(params); !checked) return checked.error();
  const Rules rules(mesh, surfaces, potentials, params);
  const std::vector<Eigen::Vector3d> nothing(mesh.tets.size() * places.size(), Eigen::Vector3d::Zero());
  Fibres fibres{nothing, nothing};
  parallel_for(ctx.threads, mesh.tets.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last && !ctx.cancelled(); ++t) {
      if (!surfaces.wall[t]) continue;
      for (std::size_t i = 0; i < places.size(); ++i) {
        const Eigen::Matrix3d frame = rules.at(t, places[i]);
        fibres.fibre[t * places.size() + i] = frame.col(0);
        fibres.sheet[t * places.size() + i] = frame.col(2);
      }
    }
  });
  if (ctx.cancelled()) return cancelled_error(kFibresStage);
  return fibres;
}

Fibres point_fibres(const TetMesh& mesh, const Fibres& of_tets) {
  const std::vector<Eigen::Matrix3d> nothing(mesh.points.size(), Eigen::Matrix3d::Zero());
  std::vector<Eigen::Matrix3d> fibre = nothing, sheet = nothing;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Eigen::Vector3d &f = of_tets.fibre[t], &s = of_tets.sheet[t];
    const double volume = fem::element_of(mesh, t).volume;
    for (const std::uint32_t point : mesh.tets[t]) {
      fibre[point] += volume * f * f.transpose();
      sheet[point] += volume * s * s.transpose();
    }
  }
  Fibres fibres;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    fibres.fibre.emplace_back(Eigen::Vector3d::Zero());
    fibres.sheet.emplace_back(Eigen::Vector3d::Zero());
    if (fibre[i].isZero(0)) continue;
    const Eigen::Vector3d f = principal_direction(fibre[i]).normalized();
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - f * f.transpose();
    fibres.fibre.back() = f;
    fibres.sheet.back() = unit_across(principal_direction(across * sheet[i] * across), f);
  }
  return fibres;
}

}  // namespace voxtet
