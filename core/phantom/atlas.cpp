// A stand-in for a parcellated brain: an ellipsoid cut into Voronoi cells, with boundaries that smooth noise
// disturbs.
#include <memory>
#include <vector>

#include "phantom/body.h"
#include "phantom/value_noise.h"

namespace voxtet {
namespace {

using Eigen::Vector3d;

const Vector3d kSemiAxes{70, 85, 60};
constexpr double kShift = 4, kShiftWave = 14;  ///< mm at scale 1: of the boundaries, and over which length
constexpr double kLeastDistance = 0.6;         ///< of sites, in edges of a cube as large as a region

/// Three numbers in [-1, 1].
Vector3d noise_vector(const Vector3d& at, std::uint32_t seed) {
  Vector3d out;
  for (int d = 0; d < 3; ++d) out[d] = 2 * value_noise(at, seed + static_cast<std::uint32_t>(d)) - 1;
  return out;
}

class Atlas {
 public:
  explicit Atlas(const PhantomParams& params)
      : outside_{Vector3d::Zero(), params.scale * kSemiAxes}, scale_(params.scale), seed_(params.seed) {
    constexpr double kBallPerCube = 4.18879;  // of the cube of the radius
    const double region = std::cbrt(kBallPerCube * outside_.semi_axes.prod() / params.regions);
    double least = kLeastDistance * region;
    // Where sites find no more room they may be closer.
    constexpr double kCloser = 0.9995;
    for (int tries = 0; sites_.size() < static_cast<std::size_t>(params.regions); ++tries, least *= kCloser) {
      const Vector3d site = noise_vector(Vector3d(tries, 0, 0), seed_).cwiseProduct(outside_.semi_axes);
      if (outside_.distance(site) >= 0) continue;
      const auto is_near = [&](const Vector3d& other) { return (other - site).norm() < least; };
      if (std::none_of(sites_.begin(), sites_.end(), is_near)) sites_.push_back(site);
    }
  }

  Label label_at(const Vector3d& p) const {
    if (outside_.distance(p) >= 0) return kBackground;
    const Vector3d shifted = p + scale_ * kShift * noise_vector(p / (scale_ * kShiftWave), seed_ + 3);
    const auto nearer = [&](const Vector3d& a, const Vector3d& b) {
      return (a - shifted).squaredNorm() < (b - shifted).squaredNorm();
    };
    return static_cast<Label>(std::min_element(sites_.begin(), sites_.end(), nearer) - sites_.begin() + 1);
  }

 private:
  Ellipsoid outside_;
  double scale_;
  std::uint32_t seed_;
  std::vector<Vector3d> sites_;
};

}  // namespace

Body atlas_body(const PhantomParams& params) {
  Body body;
  body.half_extent_mm = params.scale * kSemiAxes;
  body.radius_mm = body.half_extent_mm.maxCoeff();
  const auto atlas = std::make_shared<const Atlas>(params);
  body.label_at = [atlas](const Vector3d& p) { return atlas->label_at(p); };
  return body;
}

}  // namespace voxtet
