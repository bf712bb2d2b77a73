// The surfaces that the heart is made of, and the place of its scar, for given parameters.
#pragma once

#include "phantom/body.h"

namespace voxtet {

/// All in millimetres at scale 1, in the frame of biventricle.cpp: the axis of the left ventricle is z with
/// the base up, the right ventricle lies towards +x. The right ventricle's surfaces go on within the left
/// one, which is taken away from them.
struct HeartShape {
  Ellipsoid lv_cavity, lv_outside;
  Ellipsoid rv_cavity, rv_outside;
  Ellipsoid infundibulum_cavity, infundibulum_outside;
  double base_height;              ///< of the base plane, along its normal
  Eigen::Vector3d low, high;       ///< corners of a box that holds the heart
  Eigen::Vector2d scar_direction;  ///< of the scar's middle, in (x, y)
  double scar_height;              ///< of the scar's middle, in z
  Ellipsoid scar_outline;          ///< of its core, in (share of the arc, height): see kArcShare
  double mid_wall_radius;          ///< on which arcs are measured
};

/// An arc counts less than a height where the distance from the scar's outline is measured: the border zone
/// is so much wider around the ventricle than along it.
constexpr double kArcShare = 5.0 / 6;

HeartShape heart_shape(const PhantomParams& params);

}  // namespace voxtet
