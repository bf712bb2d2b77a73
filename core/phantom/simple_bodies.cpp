#include "phantom/body.h"

namespace voxtet {
namespace {

Body sphere(double outer, double inner) {
  Body body;
  body.half_extent_mm = Eigen::Vector3d::Constant(outer);
  body.radius_mm = outer;
  body.label_at = [outer, inner](const Eigen::Vector3d& p) -> Label {
    const double r2 = p.squaredNorm();
    return r2 < outer * outer && r2 >= inner * inner ? 1 : kBackground;
  };
  return body;
}

Body torus(double major, double minor) {
  Body body;
  body.half_extent_mm = {major + minor, major + minor, minor};
  body.radius_mm = major + minor;
  body.label_at = [major, minor](const Eigen::Vector3d& p) -> Label {
    const double ring = std::sqrt(p.x() * p.x() + p.y() * p.y()) - major;
    return ring * ring + p.z() * p.z() < minor * minor ? 1 : kBackground;
  };
  return body;
}

bool in_box(const Eigen::Vector3d& p, const Eigen::Vector3d& half) {
  return std::abs(p.x()) < half.x() && std::abs(p.y()) < half.y() && std::abs(p.z()) < half.z();
}

Body slab(double half_width, double thickness) {
  Body body;
  body.half_extent_mm = {half_width, half_width, thickness / 2};
  body.radius_mm = body.half_extent_mm.norm();
  body.label_at = [half = body.half_extent_mm](const Eigen::Vector3d& p) -> Label { return in_box(p, half); };
  return body;
}

Body nested_boxes(double half_size) {
  Body body;
  body.half_extent_mm = Eigen::Vector3d::Constant(half_size);
  body.radius_mm = body.half_extent_mm.norm();
  body.label_at = [half = body.half_extent_mm](const Eigen::Vector3d& p) -> Label {
    return static_cast<Label>(in_box(p, half) + in_box(p, half * 2 / 3) + in_box(p, half / 3));
  };
  return body;
}

Body branching_tube(double quarter_length) {
  const double trunk_radius = 0.5 * quarter_length;
  const double branch_radius = 0.375 * quarter_length;
  const double fillet = 0.4 * quarter_length;
  const Eigen::Vector3d trunk(0, 0, trunk_radius - 2 * quarter_length);
  const Eigen::Vector3d branch(1.4 * quarter_length, 0, 2 * quarter_length - branch_radius);
  const Eigen::Vector3d mirrored_branch(-branch.x(), 0, branch.z());
  Body body;
  // The fillet may bulge by a quarter of its width; at the tips, where the box is tight, it has no say.
  body.half_extent_mm = {branch.x() + branch_radius, trunk_radius + fillet / 4, 2 * quarter_length};
  body.radius_mm = body.half_extent_mm.norm();
  body.label_at = [=](const Eigen::Vector3d& p) -> Label {
    const Eigen::Vector3d fork = Eigen::Vector3d::Zero();
    const double left = capsule_distance(p, fork, branch, branch_radius);
    const double right = capsule_distance(p, fork, mirrored_branch, branch_radius);
    const double stem = capsule_distance(p, trunk, fork, trunk_radius);
    return smooth_min(smooth_min(left, right, fillet), stem, fillet) < 0;
  };
  return body;
}

}  // namespace

Body simple_body(const PhantomParams& params) {
  switch (params.kind) {
    case PhantomKind::kSphere: return sphere(params.radius_mm, 0);
    case PhantomKind::kShell: return sphere(params.radius_mm, params.inner_radius_mm);
    case PhantomKind::kTorus: return torus(params.radius_mm, params.inner_radius_mm);
    case PhantomKind::kSlab: return slab(params.radius_mm, params.thickness_mm);
    case PhantomKind::kNestedBoxes: return nested_boxes(params.radius_mm);
    default: return branching_tube(params.radius_mm);
  }
}

}  // namespace voxtet
