// Complexes of cubes, each cut into six tetrahedra (Kuhn), for tests of cell labels.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "remesh/cells/labelled_cells.h"

namespace voxtet::test {

/// n * n * n cubes of edge `spacing`, the first corner at `origin` in every coordinate; labels by cube.
template <class LabelAt>
remesh::LabelledCells lattice_complex(int n, double spacing, double origin, LabelAt&& label_at) {
  remesh::LabelledCells cells;
  const auto id = [&](const std::array<int, 3>& p) {
    return static_cast<std::uint32_t>(p[0] + (n + 1) * (p[1] + (n + 1) * p[2]));
  };
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        cells.points.push_back(Eigen::Vector3d::Constant(origin) + spacing * Eigen::Vector3d(i, j, k));
  constexpr std::array<std::array<std::size_t, 3>, 6> kOrders{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (std::size_t o = 0; o < 6; ++o) {
          std::array<int, 3> at{i, j, k};
          std::array<std::uint32_t, 4> cell{id(at)};
          for (std::size_t step = 0; step < 3; ++step) {
            ++at[kOrders[o][step]];
            cell[step + 1] = id(at);
          }
          if (o >= 3) std::swap(cell[2], cell[3]);
          cells.vertices.push_back(cell);
          cells.labels.push_back(static_cast<Label>(label_at(i, j, k)));
        }
  cells.neighbours.assign(cells.vertices.size(), {});
  std::map<std::array<std::uint32_t, 3>, std::array<std::uint32_t, 2>> open;
  for (std::uint32_t c = 0; c < cells.vertices.size(); ++c)
    for (std::uint32_t f = 0; f < 4; ++f) {
      cells.neighbours[c][f] = remesh::LabelledCells::kNone;
      std::array<std::uint32_t, 3> facet{};
      for (std::size_t v = 0; v < 3; ++v) facet[v] = cells.vertices[c][kFacetCorners[f][v]];
      std::sort(facet.begin(), facet.end());
      const auto [found, added] = open.try_emplace(facet, std::array{c, f});
      if (added) continue;
      const auto [other, corner] = found->second;
      cells.neighbours[c][f] = other;
      cells.neighbours[other][corner] = c;
    }
  return cells;
}

}  // namespace voxtet::test
