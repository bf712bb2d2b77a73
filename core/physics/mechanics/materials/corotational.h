// Linear elasticity in a frame that turns with the body.
#pragma once

#include <Eigen/Core>

#include "physics/mechanics/materials/material.h"

namespace voxtet::mechanics {

/// As response_of(); the tangent is exact.
Response respond_corotational(const Corotational& material, const Eigen::Matrix3d& c,
                              const Eigen::Matrix3d& frame);

}  // namespace voxtet::mechanics
