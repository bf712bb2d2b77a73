// The interface of every parametric body, and the distance functions that bodies are built from.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>

#include "phantom/make_phantom.h"

namespace voxtet {

/// A label at every point of space (mm) and a box and a ball that hold all labelled points.
struct Body {
  std::function<Label(const Eigen::Vector3d&)> label_at;
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();       ///< of the box and of the ball
  Eigen::Vector3d half_extent_mm = Eigen::Vector3d::Zero();  ///< of the box, along the body's own axes
  double radius_mm = 0;                                      ///< of the ball
};

/// Sphere, shell, torus, slab, nested boxes and branching tube.
Body simple_body(const PhantomParams& params);
/// The heart: see biventricle.cpp for its anatomy.
Body biventricle_body(const PhantomParams& params);
/// The atlas: an ellipsoid of many regions.
Body atlas_body(const PhantomParams& params);

/// Minimum of two distances, rounded with a fillet where they differ by less than `width` (mm): at most
/// width/4 below the minimum, polynomial. https://iquilezles.org/articles/smin
inline double smooth_min(double a, double b, double width) {
  const double overlap = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - overlap * overlap * width / 4;
}
inline double smooth_max(double a, double b, double width) {
  return -smooth_min(-a, -b, width);
}

/// Signed distance to an ellipsoid, negative inside, to first order near its surface.
struct Ellipsoid {
  Eigen::Vector3d centre, semi_axes;

  double distance(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d unit = (point - centre).cwiseQuotient(semi_axes);
    const double level = unit.norm();
    const double slope = unit.cwiseQuotient(semi_axes).norm();
    return slope > 0 ? level * (level - 1) / slope : -semi_axes.minCoeff();
  }
  Ellipsoid shrunk(double by) const { return {centre, (semi_axes.array() - by).matrix()}; }
};

/// Signed distance to a segment thickened to `radius`.
inline double capsule_distance(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
                               const Eigen::Vector3d& b, double radius) {
  const Eigen::Vector3d along = b - a;
  const double t = std::clamp((point - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (point - a - t * along).norm() - radius;
}

}  // namespace voxtet
