// Walls of known thickness, and how far a measurement is from it.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "geometry/elements/rotation.h"
#include "surface/extract/extract_surface.h"
#include "surface/smooth/smooth_surface.h"
#include "volume/stack/interpolate_slices.h"
#include "walls/measure_wall.h"

namespace voxtet::test {

/// A wall (label 1) around or beside an inner space (label 2), in mm about the origin.
struct Body {
  std::function<Label(const Eigen::Vector3d&)> label_at;
  std::function<double(const Eigen::Vector3d&)> thickness_at;  ///< NaN: not to be compared
  double reach_mm;                                             ///< half size of the image
};

inline Body shell(double inner, double outer) {
  return {[=](const Eigen::Vector3d& p) -> Label {
            const double r = p.norm();
            return r < inner ? 2 : (r < outer ? 1 : 0);
          },
          [=](const Eigen::Vector3d&) { return outer - inner; }, outer + 3};
}

/// Confocal prolate spheroids about z, whose potential is known: its field lines are the hyperbolas of the
/// confocal family. Half axes across z: `inner`, `outer`; `focus` is the distance of the foci.
inline Body ellipsoidal_shell(double focus, double inner, double outer) {
  // cosh(mu) from the sum of distances to the foci, cos(nu) from their difference.
  const auto coordinates = [=](const Eigen::Vector3d& p) {
    const double a = (p - Eigen::Vector3d(0, 0, focus)).norm(), b = (p + Eigen::Vector3d(0, 0, focus)).norm();
    return std::array<double, 2>{std::acosh(std::max(1.0, (a + b) / (2 * focus))), (b - a) / (2 * focus)};
  };
  const double mu0 = std::asinh(inner / focus), mu1 = std::asinh(outer / focus);
  return {[=](const Eigen::Vector3d& p) -> Label {
            const double mu = coordinates(p)[0];
            return mu < mu0 ? 2 : (mu < mu1 ? 1 : 0);
          },
          [=](const Eigen::Vector3d& p) {
            const double cosine = coordinates(p)[1];
            constexpr int kSteps = 200;
            double length = 0;  // of the hyperbola of constant nu: ds = f sqrt(sinh^2 mu + sin^2 nu) d mu
            for (int i = 0; i < kSteps; ++i) {
              const double s = std::sinh(mu0 + (mu1 - mu0) * (i + 0.5) / kSteps);
              length += focus * std::sqrt(s * s + 1 - cosine * cosine) * (mu1 - mu0) / kSteps;
            }
            return length;
          },
          std::sqrt(outer * outer + focus * focus) + 3};
}

/// A slab across z that the image cuts off; the inner space below it.
inline Body slab(double thickness) {
  return {[=](const Eigen::Vector3d& p) -> Label {
            return p.z() < -thickness / 2 ? 2 : (p.z() < thickness / 2 ? 1 : 0);
          },
          [=](const Eigen::Vector3d& p) {
            return p.head<2>().norm() < 12 ? thickness : std::numeric_limits<double>::quiet_NaN();
          },
          24};
}

/// Sampled at voxel centres of a grid through the origin, whose axes are rotated.
inline LabelVolume sample(const Body& body, const Eigen::Vector3d& spacing_mm,
                          const Eigen::Vector3d& rotation_deg) {
  LabelVolume volume;
  Eigen::Vector3d middle;
  for (int d = 0; d < 3; ++d) {
    volume.size[static_cast<std::size_t>(d)] = 1 + 2 * static_cast<int>(body.reach_mm / spacing_mm[d]);
    middle[d] = static_cast<int>(body.reach_mm / spacing_mm[d]) + 0.31;  // off the lattice
  }
  const Eigen::Matrix3d linear = rotation_from_degrees(rotation_deg) * spacing_mm.asDiagonal();
  volume.index_to_mm.topLeftCorner<3, 3>() = linear;
  volume.index_to_mm.topRightCorner<3, 1>() = -linear * middle;
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i)
        volume.labels.push_back(body.label_at(volume.to_mm({1.0 * i, 1.0 * j, 1.0 * k})));
  return volume;
}

/// The volume with all other labels taken for background.
inline LabelVolume only(const std::vector<Label>& kept, LabelVolume volume) {
  for (Label& label : volume.labels)
    if (std::find(kept.begin(), kept.end(), label) == kept.end()) label = kBackground;
  return volume;
}

/// Of the wall labels alone, meshed as they are.
inline Result<WallField> measure(const LabelVolume& anatomy, const WallLabels& labels, RunContext& ctx) {
  const LabelVolume meshed = only(labels.wall, anatomy);
  if (labels.wall.empty()) return measure_wall({anatomy, meshed, {}}, labels, "sizing.thickness[0]", ctx);
  const SurfaceMesh rough = extract_surface(meshed, {}, ctx).value();
  const SurfaceMesh surface = smooth_surface(rough, meshed, {}, ctx).value();
  return measure_wall({anatomy, meshed, surface}, labels, "sizing.thickness[0]", ctx);
}

/// In units of the smallest spacing, over the wall's voxels.
struct ThicknessErrors {
  std::size_t count = 0;
  double bias = 0, p95 = 0, most = 0;
};

inline ThicknessErrors thickness_errors(const Body& body, const LabelVolume& volume) {
  RunContext ctx;
  const Result<WallField> field = measure(volume, {{1}, {2}}, ctx);
  EXPECT_TRUE(field.ok()) << (field ? "" : field.error().message);
  ThicknessErrors errors;
  if (!field) return errors;
  std::vector<double> size;
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i) {
        const Eigen::Vector3d p = volume.to_mm({1.0 * i, 1.0 * j, 1.0 * k});
        const double truth = body.thickness_at(p);
        if (volume.at(i, j, k) != 1 || std::isnan(truth)) continue;
        const double error = (field->thickness_at(p) - truth) / volume.smallest_spacing_mm();
        errors.bias += error;
        size.push_back(std::abs(error));
      }
  errors.count = size.size();
  if (size.empty()) return errors;
  errors.bias /= static_cast<double>(size.size());
  std::sort(size.begin(), size.end());
  errors.p95 = size[size.size() * 95 / 100];
  errors.most = size.back();
  return errors;
}

}  // namespace voxtet::test
