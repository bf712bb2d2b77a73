#include "tetra/fill/hole_seeds.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/union_find.h"

namespace voxtet {
namespace {

/// First offset of a seed from its triangle, relative to the square root of twice its area.
constexpr double kFirstOffset = 1e-2;
constexpr int kMaxHalvings = 40;

struct Seed {
  std::uint32_t triangle = 0;
  Eigen::Vector3d from, step;
  bool crossed = false;
};

Eigen::Vector3d doubled_area_vector(const SurfaceMesh& surface, std::uint32_t t) {
  const auto [a, b, c] = surface.triangles[t];
  return (surface.points[b] - surface.points[a]).cross(surface.points[c] - surface.points[a]);
}

/// The largest triangle of each edge-connected part of the boundary of background.
std::vector<std::uint32_t> largest_triangles(const SurfaceMesh& surface, const EdgeGroups& edges) {
  UnionFind parts(surface.triangles.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    std::array<std::uint32_t, 2> pair{};
    int found = 0;
    for (const TriangleUse& use : edges[e])
      if (surface.sides[use.triangle][1] == kBackground && ++found <= 2)
        pair[static_cast<std::size_t>(found - 1)] = use.triangle;
    // Four meet where background touches itself along an edge: left apart, each part gets a seed of its own.
    if (found == 2) parts.join(pair[0], pair[1]);
  }
  constexpr std::uint32_t kNone = 0xffffffffU;
  std::vector<std::uint32_t> largest(surface.triangles.size(), kNone);
  std::vector<double> area(surface.triangles.size(), 0);
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    if (surface.sides[t][1] != kBackground) continue;
    const std::uint32_t part = parts.find(t);
    const double size = doubled_area_vector(surface, t).squaredNorm();
    if (largest[part] != kNone && size <= area[part]) continue;
    largest[part] = t;
    area[part] = size;
  }
  std::erase(largest, kNone);
  return largest;
}

/// Whether the segment from `seed.from` along `seed.step` comes near or through the triangle.
bool crosses(const Seed& seed, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  constexpr double kSlack = 1e-6;
  const Eigen::Vector3d ab = b - a, ac = c - a, start = seed.from - a;
  const Eigen::Vector3d normal = ab.cross(ac);
  const double rise = normal.dot(seed.step), height = normal.dot(start);
  if (rise == 0) return height == 0;
  const double t = -height / rise;
  if (t < -kSlack || t > 1 + kSlack) return false;
  const Eigen::Vector3d hit = start + t * seed.step;
  const double scale = normal.squaredNorm();
  const double u = normal.dot(hit.cross(ac)) / scale, v = normal.dot(ab.cross(hit)) / scale;
  return u > -kSlack && v > -kSlack && u + v < 1 + kSlack;
}

/// Marks the seeds (ascending in from.x) whose segment crosses a triangle other than its own.
bool mark_crossed(const SurfaceMesh& surface, std::vector<Seed>& seeds) {
  double reach = 0;
  for (Seed& seed : seeds) {
    seed.crossed = false;
    reach = std::max(reach, seed.step.norm());
  }
  bool any = false;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const auto [ia, ib, ic] = surface.triangles[t];
    const Eigen::Vector3d &a = surface.points[ia], &b = surface.points[ib], &c = surface.points[ic];
    const Eigen::Vector3d low = a.cwiseMin(b).cwiseMin(c).array() - reach;
    const Eigen::Vector3d high = a.cwiseMax(b).cwiseMax(c).array() + reach;
    auto seed = std::lower_bound(seeds.begin(), seeds.end(), low.x(),
                                 [](const Seed& s, double x) { return s.from.x() < x; });
    for (; seed != seeds.end() && seed->from.x() <= high.x(); ++seed) {
      if (seed->triangle == t || seed->crossed) continue;
      if ((seed->from.array() < low.array()).any() || (seed->from.array() > high.array()).any()) continue;
      seed->crossed = crosses(*seed, a, b, c);
      any = any || seed->crossed;
    }
  }
  return any;
}

}  // namespace

std::vector<Eigen::Vector3d> find_hole_seeds(const SurfaceMesh& surface, const EdgeGroups& edges) {
  std::vector<Seed> seeds;
  for (const std::uint32_t t : largest_triangles(surface, edges)) {
    const auto [a, b, c] = surface.triangles[t];
    const Eigen::Vector3d normal = doubled_area_vector(surface, t);
    const double length = normal.norm();
    seeds.push_back({t, (surface.points[a] + surface.points[b] + surface.points[c]) / 3,
                     normal / length * (kFirstOffset * std::sqrt(length))});
  }
  std::sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) {
    return a.from.x() != b.from.x() ? a.from.x() < b.from.x() : a.triangle < b.triangle;
  });
  for (int i = 0; i < kMaxHalvings && mark_crossed(surface, seeds); ++i)
    for (Seed& seed : seeds)
      if (seed.crossed) seed.step /= 2;
  std::vector<Eigen::Vector3d> points;
  points.reserve(seeds.size());
  for (const Seed& seed : seeds) points.push_back(seed.from + seed.step);
  return points;
}

}  // namespace voxtet
