// Orthonormal frames in a wall, and fibres in them.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "base/portable_trig.h"

namespace voxtet {

/// v / |v|; the axis z where v is 0.
inline Eigen::Vector3d unit_along(const Eigen::Vector3d& v) {
  const double length = v.norm();
  return length > 0 ? Eigen::Vector3d(v / length) : Eigen::Vector3d::UnitZ();
}

/// The unit vector at right angles to `unit` in the plane of both. Where v has no part across it but
/// rounding, the coordinate axis that has most is taken for v.
inline Eigen::Vector3d unit_across(const Eigen::Vector3d& v, const Eigen::Vector3d& unit) {
  constexpr double kRounding = 1e-10;
  Eigen::Vector3d across = v - v.dot(unit) * unit;
  if (!(across.norm() > kRounding * v.norm())) {
    Eigen::Index least = 0;
    unit.cwiseAbs().minCoeff(&least);
    across = Eigen::Vector3d::Unit(least) - unit[least] * unit;
  }
  across.normalize();
  // Once more, for what cancellation left.
  return (across - across.dot(unit) * unit).normalized();
}

/// Columns e_c, e_l, e_t from directions outwards and to the base, e_t straight outwards.
inline Eigen::Matrix3d frame_outwards(const Eigen::Vector3d& outwards, const Eigen::Vector3d& to_base) {
  Eigen::Matrix3d frame;
  frame.col(2) = unit_along(outwards);
  frame.col(1) = unit_across(to_base, frame.col(2));
  frame.col(0) = frame.col(1).cross(frame.col(2));
  return frame;
}

/// The same with e_l straight to the base: function 2 of Bayer's supplement.
inline Eigen::Matrix3d frame_to_base(const Eigen::Vector3d& outwards, const Eigen::Vector3d& to_base) {
  Eigen::Matrix3d frame;
  frame.col(1) = unit_along(to_base);
  frame.col(2) = unit_across(outwards, frame.col(1));
  frame.col(0) = frame.col(1).cross(frame.col(2));
  return frame;
}

/// Columns fibre, sheet normal, sheet: the frame turned by alpha about e_t and then by beta about the fibre
/// (degrees), function 3 of Bayer's supplement.
inline Eigen::Matrix3d turned(const Eigen::Matrix3d& frame, double alpha, double beta) {
  constexpr double kRadians = EIGEN_PI / 180;
  const auto [cos_alpha, sin_alpha] = cos_sin(alpha * kRadians);
  const auto [cos_beta, sin_beta] = cos_sin(beta * kRadians);
  const Eigen::Vector3d along = cos_alpha * frame.col(1) - sin_alpha * frame.col(0);
  Eigen::Matrix3d out;
  out.col(0) = cos_alpha * frame.col(0) + sin_alpha * frame.col(1);
  out.col(1) = cos_beta * along - sin_beta * frame.col(2);
  out.col(2) = sin_beta * along + cos_beta * frame.col(2);
  return out;
}

}  // namespace voxtet
