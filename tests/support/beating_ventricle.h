// A left ventricle as an ellipsoid, with what it needs to beat.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "physics/beat/make_heart.h"
#include "physics/mechanics/elements/nodes.h"
#include "support/ellipsoid.h"
#include "types/tissue.h"

namespace voxtet::test {

/// Walls of 9 mm around 50 ml.
inline constexpr Ellipsoid kSmallVentricle{20, 29, 45, 54, 10};

/// Fibres in closed form, linear in the depth from one helix angle to another, at the centroids and at the
/// four samples of each tetrahedron.
class BeatingVentricle {
 public:
  BeatingVentricle(std::uint32_t layers, std::uint32_t rings, bool fine_fibres = false,
                   const Ellipsoid& ellipsoid = kSmallVentricle, double endo_deg = 60, double epi_deg = -60)
      : body(left_ventricle(layers, rings, ellipsoid)),
        ellipsoid_(ellipsoid),
        endo_deg_(endo_deg),
        epi_deg_(epi_deg) {
    for (std::size_t t = 0; t < body.mesh.tets.size(); ++t) {
      right.push_back(false);
      across.push_back(frame_at(body.centroid(t)).across);
      add_fibres(body.centroid(t), fibres);
      for (std::size_t s = 0; fine_fibres && s < 4; ++s) {
        const auto shares = mechanics::Nodes::shares_of(4, s);
        Eigen::Vector3d place = Eigen::Vector3d::Zero();
        for (std::size_t i = 0; i < 4; ++i) place += shares[i] * body.mesh.points[body.mesh.tets[t][i]];
        add_fibres(place, fine);
      }
    }
  }

  beat::Anatomy anatomy() const {
    return {body.mesh, body.surfaces, fibres, across, right, fine.fibre.empty() ? nullptr : &fine};
  }

  HeartBody body;
  Fibres fibres, fine;
  std::vector<Eigen::Vector3d> across;
  std::vector<bool> right;

 private:
  struct Frame {
    Eigen::Vector3d fibre, sheet, across;
  };
  /// Sheets are across the wall.
  Frame frame_at(const Eigen::Vector3d& place) const {
    const double depth = ellipsoid_.depth(place);
    const double angle = (endo_deg_ + (epi_deg_ - endo_deg_) * depth) * EIGEN_PI / 180;
    const Eigen::Vector3d fibre = ellipsoid_.fibre(place, angle);
    const Eigen::Vector3d sheet = fibre.cross(ellipsoid_.fibre(place, angle + EIGEN_PI / 2)).normalized();
    return {fibre, sheet, sheet};
  }
  void add_fibres(const Eigen::Vector3d& place, Fibres& to) const {
    const Frame frame = frame_at(place);
    to.fibre.push_back(frame.fibre);
    to.sheet.push_back(frame.sheet);
  }

  Ellipsoid ellipsoid_;
  double endo_deg_, epi_deg_;
};

/// One step of the heart, to its end.
inline Status step(beat::HeartSteps& steps) {
  while (true) {
    const Result<bool> done = steps.advance();
    if (!done) return done.error();
    if (*done) return std::monostate{};
  }
}

}  // namespace voxtet::test
