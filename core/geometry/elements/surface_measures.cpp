#include "geometry/elements/surface_measures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace voxtet {
namespace {

/// Six times the signed volume between a triangle and `reference`. A reference near the surface keeps digits
/// that a far origin would cancel.
double sixfold_volume(const SurfaceMesh& surface, const Triangle& t, const Eigen::Vector3d& reference) {
  const Eigen::Vector3d a = surface.points[t[0]] - reference;
  return a.dot((surface.points[t[1]] - reference).cross(surface.points[t[2]] - reference));
}

}  // namespace

double enclosed_volume_mm3(const SurfaceMesh& surface, Label label) {
  if (surface.points.empty()) return 0;
  const Eigen::Vector3d reference = surface.points.front();
  double sixfold = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Sides& sides = surface.sides[t];
    if (sides[0] != label && sides[1] != label) continue;
    const double part = sixfold_volume(surface, surface.triangles[t], reference);
    sixfold += sides[0] == label ? part : -part;
  }
  return sixfold / 6;
}

std::vector<double> enclosed_volumes_mm3(const SurfaceMesh& surface) {
  Label largest = kBackground;
  for (const Sides& sides : surface.sides) largest = std::max({largest, sides[0], sides[1]});
  std::vector<double> volumes(static_cast<std::size_t>(largest) + 1, 0.0);
  if (surface.points.empty()) return volumes;
  const Eigen::Vector3d reference = surface.points.front();
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const double part = sixfold_volume(surface, surface.triangles[t], reference) / 6;
    volumes[surface.sides[t][0]] += part;
    volumes[surface.sides[t][1]] -= part;
  }
  volumes[kBackground] = 0;
  return volumes;
}

double staircase_energy_mm(const SurfaceMesh& surface) {
  const std::size_t points = surface.points.size();
  struct Half {
    std::uint32_t other, triangle;
  };
  std::vector<std::size_t> first(points + 1, 0);
  const auto each_edge = [&](auto&& visit) {
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = surface.triangles[t][i], b = surface.triangles[t][(i + 1) % 3];
        visit(std::min(a, b), Half{std::max(a, b), static_cast<std::uint32_t>(t)});
      }
  };
  each_edge([&](std::uint32_t low, const Half&) { ++first[low + 1]; });
  for (std::size_t p = 0; p < points; ++p) first[p + 1] += first[p];
  std::vector<Half> halves(3 * surface.triangles.size());
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  each_edge([&](std::uint32_t low, const Half& half) { halves[next[low]++] = half; });

  const auto normal = [&](std::uint32_t t) {
    const Triangle& v = surface.triangles[t];
    return triangle_cross(surface.points[v[0]], surface.points[v[1]], surface.points[v[2]]);
  };
  double energy = 0;
  for (std::size_t p = 0; p < points; ++p) {
    const auto begin = halves.begin() + static_cast<std::ptrdiff_t>(first[p]);
    const auto end = halves.begin() + static_cast<std::ptrdiff_t>(first[p + 1]);
    std::sort(begin, end, [](const Half& a, const Half& b) {
      return a.other != b.other ? a.other < b.other : a.triangle < b.triangle;
    });
    for (auto it = begin; it != end;) {
      auto stop = it;
      while (stop != end && stop->other == it->other) ++stop;
      if (stop - it == 2) {
        const Eigen::Vector3d m = normal(it[0].triangle), n = normal(it[1].triangle);
        const double turn = std::atan2(m.cross(n).norm(), m.dot(n));
        energy += (surface.points[it->other] - surface.points[p]).norm() * turn * turn;
      }
      it = stop;
    }
  }
  return energy;
}

}  // namespace voxtet
