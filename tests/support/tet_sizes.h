// Sizes of tetrahedra and of their edges, and a body whose sizes change.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "support/check_tets.h"
#include "support/test_surfaces.h"

namespace voxtet::test {

inline double volume_of(const TetMesh& mesh, Label label) {
  double volume = 0;
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t)
    if (mesh.labels[t] == label) volume += tet_volume(mesh, t);
  return volume;
}

inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

inline std::vector<Edge> edges_of(const TetMesh& mesh, Label label) {
  std::vector<Edge> edges;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (std::size_t i = 0; mesh.labels[t] == label && i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) edges.push_back(std::minmax(mesh.tets[t][i], mesh.tets[t][j]));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// Median log2(edge / target) over the edges of a label that are not in the surface.
inline double inner_size_bias(const TetMesh& mesh, Label label, const SizingField& sizing) {
  std::vector<Edge> surface;
  for (const Triangle& t : mesh.faces)
    for (std::size_t c = 0; c < 3; ++c) surface.push_back(std::minmax(t[c], t[(c + 1) % 3]));
  std::sort(surface.begin(), surface.end());
  std::vector<double> logs;
  for (const auto& [a, b] : edges_of(mesh, label)) {
    if (std::binary_search(surface.begin(), surface.end(), Edge(a, b))) continue;
    const Eigen::Vector3d &p = mesh.points[a], &q = mesh.points[b];
    logs.push_back(std::log2((p - q).norm() / sizing.at((p + q) / 2)));
  }
  return median(logs);
}

/// Nested spheres of label 2 in label 1, edges 0.8 mm in the inner and growing by 0.3 to 2 mm outside.
inline SurfaceMesh graded_spheres() {
  SurfaceMesh surface = sphere({0, 0, 0}, 5.7, 3, 2, 1);
  append(surface, sphere({0, 0, 0}, 14.2, 3, 1, 0));
  return surface;
}

inline SizingField graded_sizing() {
  return sampled_sizing({-16, -16, -16}, {16, 16, 16}, 0.75, [](const Eigen::Vector3d& x) {
    return std::min(2.0, 0.8 + 0.3 * std::max(0.0, x.norm() - 5.7));
  });
}

}  // namespace voxtet::test
