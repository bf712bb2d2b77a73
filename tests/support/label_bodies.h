// Small label volumes of known shape, sampled at voxel centres.
#pragma once

#include <cmath>

#include "types/label_volume.h"

namespace voxtet::test {

/// A volume of nx*ny*nz voxels with `label_at(i, j, k)` at each.
template <class LabelAt>
LabelVolume make_volume(int nx, int ny, int nz, LabelAt&& label_at) {
  LabelVolume volume;
  volume.size = {nx, ny, nz};
  volume.labels.resize(volume.voxel_count());
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        volume.labels[volume.offset(i, j, k)] = static_cast<Label>(label_at(i, j, k));
  return volume;
}

/// Ball of label 1 around (centre, centre, centre), voxels.
inline LabelVolume ball_volume(int n, double centre, double radius) {
  return make_volume(n, n, n, [=](int i, int j, int k) {
    const double x = i - centre, y = j - centre, z = k - centre;
    return x * x + y * y + z * z <= radius * radius ? 1 : 0;
  });
}

/// True inside a torus about the z axis through (cx, cy, cz).
inline bool in_torus(double x, double y, double z, double big, double small) {
  const double ring = std::sqrt(x * x + y * y) - big;
  return ring * ring + z * z <= small * small;
}

/// A heart-like body of four labels: a thick left shell (1) around a pool (3), a thinner right shell (2)
/// around a pool (4), both cut open by the top of the image.
inline LabelVolume heart_volume(int nx, int ny, int nz) {
  return make_volume(nx, ny, nz, [=](int i, int j, int k) {
    const auto inside = [&](double cx, double cy, double rx, double ry, double rz) {
      const double x = (i - cx * nx) / (rx * nx), y = (j - cy * ny) / (ry * ny),
                   z = (k - 0.95 * nz) / (rz * nz);
      return x * x + y * y + z * z <= 1;
    };
    if (k > 0.8 * nz) return 0;
    if (inside(0.62, 0.5, 0.19, 0.26, 0.75)) return 3;
    if (inside(0.62, 0.5, 0.30, 0.40, 0.90)) return 1;
    if (inside(0.34, 0.5, 0.25, 0.36, 0.70)) return 4;
    if (inside(0.34, 0.5, 0.29, 0.41, 0.76)) return 2;
    return 0;
  });
}

inline std::vector<double> label_counts(const LabelVolume& volume) {
  std::vector<double> counts(65536, 0.0);
  for (const Label label : volume.labels) counts[label] += 1;
  return counts;
}

}  // namespace voxtet::test
