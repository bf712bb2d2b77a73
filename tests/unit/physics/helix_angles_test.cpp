// Signs and sizes of helix angles in both ventricles and in the septum.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "geometry/elements/surface_measures.h"
#include "support/heart_fibres.h"

namespace voxtet {
namespace {

using test::fibres_of, test::kRadians;

/// The helix angle (degrees, -90 to 90) about z of a direction in a surface with this outward normal.
double helix_angle(const Eigen::Vector3d& fibre, const Eigen::Vector3d& outward) {
  const Eigen::Vector3d t = outward.normalized();
  const Eigen::Vector3d l = (Eigen::Vector3d::UnitZ() - t.z() * t).normalized(), c = l.cross(t);
  return std::atan(fibre.dot(l) / fibre.dot(c)) / kRadians;
}

/// The mean helix angle of the tetrahedra at the faces of a surface, away from its rim and the apex; `side`
/// is 1 where face normals point outwards of the ventricle that the angle is about, -1 where they point
/// inwards.
double mean_helix_angle(const test::HeartBody& body, const Fibres& fibres, HeartSurface surface, double side,
                        double least_x, double most_x) {
  std::vector<bool> at(body.mesh.points.size(), false), rim = at;
  std::vector<Eigen::Vector3d> normal(at.size(), Eigen::Vector3d::Zero());
  for (std::size_t f = 0; f < body.mesh.faces.size(); ++f)
    for (const std::uint32_t i : body.mesh.faces[f]) {
      if (body.surfaces.faces[f] == surface) {
        const auto& [a, b, c] = body.mesh.faces[f];
        normal[i] += side * triangle_cross(body.mesh.points[a], body.mesh.points[b], body.mesh.points[c]);
        at[i] = true;
      } else {
        rim[i] = true;
      }
    }
  double sum = 0;
  int count = 0;
  for (std::size_t t = 0; t < body.mesh.tets.size(); ++t) {
    int here = 0;
    Eigen::Vector3d outward = Eigen::Vector3d::Zero();
    for (const std::uint32_t i : body.mesh.tets[t]) {
      here += at[i] && !rim[i] && body.part[i] > 0.5 && body.part[i] < 0.9;
      outward += normal[i];
    }
    const double x = body.centroid(t).x();
    if (here < 3 || x < least_x || x > most_x) continue;
    sum += helix_angle(fibres.fibre[t], outward);
    ++count;
  }
  EXPECT_GT(count, 10);
  return sum / count;
}

/// Mean helix angles at the surfaces. On the septum as seen from the left ventricle.
struct HelixAngles {
  double lv, septum_left, septum_right, rv, lv_epi, rv_epi;

  HelixAngles(const test::HeartBody& body, const FibreParams& params) {
    constexpr double kFar = 100;
    const Fibres fibres = fibres_of(body, params);
    const auto mean = [&](HeartSurface surface, double side, double least_x, double most_x) {
      return mean_helix_angle(body, fibres, surface, side, least_x, most_x);
    };
    lv = mean(HeartSurface::kLvEndocardium, -1, -kFar, 0);
    septum_left = mean(HeartSurface::kLvEndocardium, -1, 5, kFar);
    septum_right = mean(HeartSurface::kRvSeptum, 1, 5, kFar);
    rv = mean(HeartSurface::kRvEndocardium, -1, 5, kFar);
    lv_epi = mean(HeartSurface::kEpicardium, 1, -kFar, 0);
    rv_epi = mean(HeartSurface::kEpicardium, 1, 16, kFar);
  }
};

// Centroids are a quarter of a layer from the surface, 1/16 of the wall.
constexpr double kDepth = 1 / 16.0;

TEST(HelixAngles, AreRightHandedHelicesAtBothEndocardiaAndLeftHandedOnesAtTheEpicardium) {
  const HelixAngles found(test::two_ventricles(4, 24), {});
  const double angle = 60 - 120 * kDepth;
  EXPECT_NEAR(found.lv, angle, 1);
  EXPECT_NEAR(found.septum_left, angle, 1);
  EXPECT_NEAR(found.septum_right, -angle, 1);
  EXPECT_NEAR(found.rv, angle, 1);
  EXPECT_NEAR(found.lv_epi, -angle, 1);
  EXPECT_NEAR(found.rv_epi, -angle, 1);
}

TEST(HelixAngles, SoTheyAreByBayersRule) {
  const HelixAngles found(test::two_ventricles(4, 24), {FibreRule::kBayer, {}, {}});
  // Of a blend by phi between 60 and 60 - 120 phi, the shorter way round.
  const double endo = 60 - 120 * kDepth * kDepth;
  const double epi = 60 + (1 - kDepth) * (180 - 120 * (1 - kDepth)) - 180;
  const double septum = 60 - 120 * kDepth;
  EXPECT_NEAR(found.lv, endo, 2);
  EXPECT_NEAR(found.septum_left, septum, 2);
  EXPECT_NEAR(found.septum_right, -septum, 2);
  EXPECT_NEAR(found.rv, endo, 2);
  EXPECT_NEAR(found.lv_epi, epi, 2);
  EXPECT_NEAR(found.rv_epi, epi, 2);
}

TEST(HelixAngles, TheSeptumMayHaveItsOwnAngles) {
  for (const FibreRule rule : {FibreRule::kLinear, FibreRule::kBayer}) {
    const HelixAngles found(test::two_ventricles(4, 24), {rule, {}, FibreAngles{20, -30, 0, 0}});
    EXPECT_NEAR(found.lv, rule == FibreRule::kLinear ? 60 - 120 * kDepth : 60 - 120 * kDepth * kDepth, 2);
    EXPECT_NEAR(found.septum_left, 20 - 50 * kDepth, 1);
    EXPECT_NEAR(found.septum_right, -30 + 50 * kDepth, 1);
    EXPECT_NEAR(found.rv, rule == FibreRule::kLinear ? 60 - 120 * kDepth : 60 - 120 * kDepth * kDepth, 2);
  }
}

}  // namespace
}  // namespace voxtet
