#include "bench/peers/surface_regions.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <set>

#include "base/union_find.h"

namespace voxtet::peers {
namespace {

/// A closed set of triangles of one label; the volume is negative where the label lies outside of it.
struct Shell {
  double mm3 = 0;
  Eigen::AlignedBox3d box;
  std::vector<std::uint32_t> triangles;
  std::uint32_t region = 0;
};

std::vector<Shell> shells_of(const SurfaceMesh& surface, Label label) {
  UnionFind joined(static_cast<std::uint32_t>(surface.points.size()));
  const auto bounds = [&](std::size_t t) {
    return surface.sides[t][0] == label || surface.sides[t][1] == label;
  };
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (!bounds(t)) continue;
    const auto [a, b, c] = surface.triangles[t];
    joined.join(a, b);
    joined.join(b, c);
  }
  std::map<std::uint32_t, Shell> shells;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    if (!bounds(t)) continue;
    const auto [a, b, c] = surface.triangles[t];
    Shell& shell = shells[joined.find(a)];
    const double cone = surface.points[a].dot(surface.points[b].cross(surface.points[c])) / 6;
    shell.mm3 += surface.sides[t][0] == label ? cone : -cone;
    for (const std::uint32_t v : {a, b, c}) shell.box.extend(surface.points[v]);
    shell.triangles.push_back(t);
  }
  std::vector<Shell> list;
  for (auto& [root, shell] : shells) list.push_back(std::move(shell));
  return list;
}

/// The region of a cavity: that of the smallest shell around it.
std::uint32_t region_around(const Shell& cavity, const std::vector<Shell>& shells) {
  double smallest = std::numeric_limits<double>::max();
  std::uint32_t region = 0;
  for (const Shell& shell : shells) {
    if (shell.mm3 <= 0 || shell.mm3 >= smallest || !shell.box.contains(cavity.box)) continue;
    smallest = shell.mm3;
    region = shell.region;
  }
  return region;
}

}  // namespace

SurfaceRegions find_regions(const SurfaceMesh& surface) {
  SurfaceRegions regions;
  regions.of_triangle.resize(surface.triangles.size(), {0, 0});
  std::set<Label> labels;
  for (const Sides& sides : surface.sides) labels.insert(sides.begin(), sides.end());
  labels.erase(kBackground);
  for (const Label label : labels) {
    std::vector<Shell> shells = shells_of(surface, label);
    for (Shell& shell : shells)
      if (shell.mm3 > 0) shell.region = ++regions.count;
    for (Shell& shell : shells) {
      if (shell.mm3 <= 0) shell.region = region_around(shell, shells);
      for (const std::uint32_t t : shell.triangles)
        regions.of_triangle[t][surface.sides[t][0] == label ? 0 : 1] = shell.region;
    }
  }
  return regions;
}

}  // namespace voxtet::peers
