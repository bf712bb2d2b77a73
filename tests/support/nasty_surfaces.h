// Valid surfaces that are hard to fill with tetrahedra: needles, spikes, specks, sheets, near touches. Made
// with + - * / and sqrt alone, so that they are the same on every platform.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/test_surfaces.h"

namespace voxtet::test {

/// Numbers in [0, 1).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double operator()() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 33) / 2147483648.0;
  }
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>((*this)() * static_cast<double>(count));
  }
  Eigen::Vector3d within_one() {
    const std::array<double, 3> x{(*this)(), (*this)(), (*this)()};
    return 2 * Eigen::Vector3d(x[0], x[1], x[2]) - Eigen::Vector3d::Ones();
  }

 private:
  std::uint64_t state_;
};

inline SurfaceMesh scaled(SurfaceMesh s, const Eigen::Vector3d& factor,
                          const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) {
  for (Eigen::Vector3d& p : s.points) p = p.cwiseProduct(factor) + shift;
  return s;
}

/// Turned by the rotation of the quaternion (w, x, y, z), which need not be of length one.
inline SurfaceMesh turned(SurfaceMesh s, double w, double x, double y, double z) {
  const double n = std::sqrt(w * w + x * x + y * y + z * z);
  const Eigen::Matrix3d rotation = Eigen::Quaterniond(w / n, x / n, y / n, z / n).toRotationMatrix();
  for (Eigen::Vector3d& p : s.points) p = rotation * p;
  return s;
}

/// `count` points more, each in a random triangle: half of them close to a corner, half close to a side, by
/// about `width` of the triangle.
inline SurfaceMesh needled(SurfaceMesh s, int count, double width, std::uint64_t seed) {
  Random random(seed);
  for (int i = 0; i < count; ++i) {
    const std::size_t t = random.below(s.triangles.size()), c = random.below(3);
    const double u = width * (0.5 + random()), v = width * (0.5 + random()), along = 0.1 + 0.8 * random();
    const bool at_corner = random() < 0.5;
    const Triangle corners = s.triangles[t];
    const Eigen::Vector3d &a = s.points[corners[c]], &b = s.points[corners[(c + 1) % 3]],
                          &d = s.points[corners[(c + 2) % 3]];
    Eigen::Vector3d weight(u, (1 - u) * along, (1 - u) * (1 - along));
    if (at_corner) weight = {1 - u - v, u, v};
    const Eigen::Vector3d place = weight[0] * a + weight[1] * b + weight[2] * d;
    const std::uint32_t p = static_cast<std::uint32_t>(s.points.size());
    s.points.push_back(place);
    s.triangles[t] = {corners[0], corners[1], p};
    s.triangles.push_back({corners[1], corners[2], p});
    s.triangles.push_back({corners[2], corners[0], p});
    s.sides.insert(s.sides.end(), 2, s.sides[t]);
  }
  return s;
}

/// Octahedra of label 2 in a sphere of label 1 and radius 10, on a grid of `across` a side, displaced.
inline SurfaceMesh specks(int across, double radius, int levels) {
  SurfaceMesh s = sphere({0, 0, 0}, 10, levels, 1, 0);
  SurfaceMesh speck;
  speck.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  speck.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  speck.sides.assign(8, {2, 1});
  Random random(3);
  for (int k = 0; k < across; ++k)
    for (int j = 0; j < across; ++j)
      for (int i = 0; i < across; ++i) {
        const Eigen::Vector3d place =
            8.0 * (Eigen::Vector3d(i, j, k) + 0.3 * random.within_one()) / across - Eigen::Vector3d(4, 4, 4);
        append(s, scaled(speck, Eigen::Vector3d::Constant(radius), place));
      }
  return s;
}

/// A sphere of radius 10 with thin spikes, out of it and into it.
inline SurfaceMesh spiked(double width, int count, int levels, double length, std::uint64_t seed) {
  SurfaceMesh s = sphere({0, 0, 0}, 10, levels, 1, 0);
  Random random(seed);
  for (int i = 0; i < count; ++i) {
    const std::size_t t = random.below(s.triangles.size());
    const auto [a, b, c] = s.triangles[t];
    const Eigen::Vector3d middle = (s.points[a] + s.points[b] + s.points[c]) / 3;
    const std::uint32_t p = static_cast<std::uint32_t>(s.points.size()), q = p + 1, r = p + 2, tip = p + 3;
    for (const std::uint32_t corner : {a, b, c})
      s.points.push_back(middle + width * (s.points[corner] - middle));
    s.points.push_back(middle + middle / middle.norm() * length * (random() < 0.5 ? 1 : -1));
    s.triangles[t] = {a, b, q};
    s.triangles.insert(
        s.triangles.end(),
        {{a, q, p}, {b, c, r}, {b, r, q}, {c, a, p}, {c, p, r}, {p, q, tip}, {q, r, tip}, {r, p, tip}});
    s.sides.resize(s.triangles.size(), {1, 0});
  }
  return s;
}

/// Cells of random labels up to `labels`, a fifth of them empty; corners displaced by up to `shift` of a
/// cell.
inline SurfaceMesh random_cells(int across, int labels, double shift, std::uint64_t seed) {
  Random random(seed);
  std::vector<Label> label(static_cast<std::size_t>(across * across * across));
  for (Label& l : label) {
    const bool empty = random() < 0.2;
    const Label any = static_cast<Label>(1 + random.below(static_cast<std::size_t>(labels)));
    l = empty ? kBackground : any;
  }
  SurfaceMesh s = cells({across, across, across}, 1, [&](int i, int j, int k) {
    return label[static_cast<std::size_t>(i + across * (j + across * k))];
  });
  for (Eigen::Vector3d& p : s.points) p += shift * random.within_one();
  return s;
}

/// Two spheres of radius 10, mirror images of each other, whose nearest vertices are `gap` apart.
inline SurfaceMesh nearly_touching(double gap) {
  SurfaceMesh s = turned(sphere({0, 0, 0}, 10, 2, 1, 0), 7, 1, 2, 3);
  SurfaceMesh mirrored = s;
  double far = 0;
  for (const Eigen::Vector3d& p : s.points) far = std::max(far, p.x());
  for (Eigen::Vector3d& p : mirrored.points) p.x() = 2 * far - p.x() + gap;
  for (Triangle& t : mirrored.triangles) std::swap(t[1], t[2]);
  append(s, mirrored);
  return s;
}

/// Spheres inside each other, the n-th around label n, `step` apart, each turned against the others.
inline SurfaceMesh nested_spheres(int count, double step) {
  SurfaceMesh s;
  for (int i = 0; i < count; ++i)
    append(s, turned(sphere({0, 0, 0}, 10 - step * i, 3, static_cast<Label>(i + 1), static_cast<Label>(i)), 9,
                     i, 2 * i, 1));
  return s;
}

/// A prism over a regular polygon of four to the power of `levels` corners, its top turned so that the bent
/// walls leave no way to fill it without points inside (E. Schoenhardt, 1928).
inline SurfaceMesh twisted_prism(double turn) {
  SurfaceMesh s;
  const double h = std::sqrt(0.75), n = std::sqrt(1 + turn * turn);
  const double c = 1 / n, d = turn / n;
  for (const double z : {0.0, 1.5})
    for (const Eigen::Vector2d& p :
         {Eigen::Vector2d(1, 0), Eigen::Vector2d(-0.5, h), Eigen::Vector2d(-0.5, -h)})
      s.points.emplace_back(z > 0 ? Eigen::Vector3d(c * p.x() + d * p.y(), c * p.y() - d * p.x(), z)
                                  : Eigen::Vector3d(p.x(), p.y(), z));
  s.triangles = {{0, 2, 1}, {3, 4, 5}};
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::uint32_t j = (i + 1) % 3;
    s.triangles.insert(s.triangles.end(), {{i, j, j + 3}, {i, j + 3, i + 3}});
  }
  s.sides.assign(s.triangles.size(), {1, 0});
  return s;
}

}  // namespace voxtet::test
