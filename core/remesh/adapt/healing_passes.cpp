#include "remesh/adapt/healing_passes.h"

#include <vector>

#include "geometry/elements/triangle_measures.h"

namespace voxtet::remesh {

/// Opens the angles of what the trial made, down to the limit or to what it found; gives up at the first that
/// can be opened neither by what adds no points nor by so many splits.
bool HealingPasses::heal(double limit_cosine, int most_splits) {
  constexpr int kRounds = 4;
  const int rounds = kRounds + most_splits;
  const ComplexMesh& mesh = editor_.mesh();
  std::vector<std::uint32_t> poor;
  for (int round = 0; round <= rounds; ++round) {
    const double limit = std::max(limit_cosine, editor_.trial_cosine_before());
    const auto is_poor = [&](std::uint32_t t) {
      return sharpest_cosine(mesh.corners(mesh.triangle(t))) > limit;
    };
    poor.clear();
    editor_.for_trial_triangles([&](std::uint32_t t) {
      if (is_poor(t)) poor.push_back(t);
    });
    if (poor.empty()) return true;
    if (round == rounds) break;
    std::sort(poor.begin(), poor.end());
    poor.erase(std::unique(poor.begin(), poor.end()), poor.end());
    for (const std::uint32_t t : poor)
      if (mesh.alive(t) && is_poor(t) && !open_angle(t) && (most_splits-- <= 0 || !split_ahead_of(t)))
        return false;
  }
  return false;
}

/// Splits the first edge on the way from longest edge to longest edge that is the longest of all triangles
/// at it (Rivara 1997).
bool HealingPasses::split_ahead_of(std::uint32_t t) {
  constexpr int kMostSteps = 8;
  const ComplexMesh& mesh = editor_.mesh();
  for (int step = 0; step < kMostSteps; ++step) {
    const Triangle corners = mesh.triangle(t);
    const auto length_of = [&](std::size_t i) {
      return (mesh.point(corners[i]) - mesh.point(corners[(i + 1) % 3])).norm();
    };
    std::size_t side = 2;
    for (const std::size_t i : {1, 0})
      if (length_of(i) > length_of(side)) side = i;
    const std::uint32_t a = corners[side], b = corners[(side + 1) % 3];
    double longest = length_of(side);
    const std::uint32_t from = t;
    for (const std::uint32_t other : mesh.star(a)) {
      if (other == from || !has_corner(mesh.triangle(other), b)) continue;
      const double length = longest_edge_mm(mesh.corners(mesh.triangle(other)));
      if (length > longest) {
        longest = length;
        t = other;
      }
    }
    if (t == from) return operations_.split(a, b, Demand::kNearer);
  }
  return false;
}

}  // namespace voxtet::remesh
