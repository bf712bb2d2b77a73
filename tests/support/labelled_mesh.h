// A small labelled tetrahedral mesh whose every number is known: a cube of n^3 cells, six Kuhn tetrahedra
// each.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "types/field.h"
#include "types/tet_mesh.h"

namespace voxtet::test {

/// The triangles between different labels, by the definition in TetMesh: normal from the greater label to the
/// lesser.
inline void add_faces(TetMesh& mesh) {
  struct Half {
    Triangle outward;
    Label label;
  };
  constexpr std::array<std::array<std::size_t, 3>, 4> kOutward{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  std::map<Triangle, std::vector<Half>> halves;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (const auto& corner : kOutward) {
      const Triangle outward{mesh.tets[t][corner[0]], mesh.tets[t][corner[1]], mesh.tets[t][corner[2]]};
      Triangle key = outward;
      std::sort(key.begin(), key.end());
      halves[key].push_back({outward, mesh.labels[t]});
    }
  for (const auto& [key, sides] : halves) {
    const Label other = sides.size() == 2 ? sides[1].label : kBackground;
    if (sides[0].label == other) continue;
    const Half& behind = sides[0].label > other ? sides[0] : sides[1];
    mesh.faces.push_back(behind.outward);
    mesh.face_sides.push_back({behind.label, std::min(sides[0].label, other)});
  }
}

/// A cube of 10 mm in n^3 cells around (-5, 20, 3), inner points displaced so that coordinates need all their
/// digits. Label 1 below the middle, 300 above, and 7 in the cell at the origin corner.
inline TetMesh kuhn_cube(std::uint32_t n) {
  TetMesh mesh;
  std::uint64_t state = 12345;
  const auto random = [&] {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state >> 11) / 9007199254740992.0 - 0.5;
  };
  const double edge = 10.0 / n;
  for (std::uint32_t k = 0; k <= n; ++k)
    for (std::uint32_t j = 0; j <= n; ++j)
      for (std::uint32_t i = 0; i <= n; ++i) {
        // Braces: their order of evaluation is defined, that of arguments is not.
        const std::array<double, 3> shift{random(), random(), random()};
        mesh.points.push_back(Eigen::Vector3d(-10, 15, -2) + edge * Eigen::Vector3d(i, j, k) +
                              0.2 * edge * Eigen::Vector3d(shift[0], shift[1], shift[2]));
      }
  const auto at = [n](std::array<std::uint32_t, 3> c) { return c[0] + (n + 1) * (c[1] + (n + 1) * c[2]); };
  constexpr std::array<std::array<std::size_t, 3>, 6> kPaths{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (std::uint32_t k = 0; k < n; ++k)
    for (std::uint32_t j = 0; j < n; ++j)
      for (std::uint32_t i = 0; i < n; ++i)
        for (std::size_t p = 0; p < 6; ++p) {
          std::array<std::uint32_t, 3> c{i, j, k};
          Tet tet{at(c), 0, 0, 0};
          for (std::size_t s = 0; s < 3; ++s) {
            ++c[kPaths[p][s]];
            tet[s + 1] = at(c);
          }
          if (p >= 3) std::swap(tet[2], tet[3]);
          mesh.tets.push_back(tet);
          mesh.labels.push_back(i + j + k == 0 ? Label{7} : 2 * k < n ? Label{1} : Label{300});
        }
  add_faces(mesh);
  return mesh;
}

/// Two tetrahedra on one triangle: label 5 above it, label 2 below.
inline TetMesh two_tets() {
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 0.25, 0}, {0, 0, 2}, {0, 0, -2}};
  mesh.tets = {{0, 2, 1, 4}, {0, 1, 2, 3}};
  mesh.labels = {2, 5};
  add_faces(mesh);
  return mesh;
}

/// Of two_tets(), with nodes that are off the middles of their edges.
inline MidsideNodes nodes_of_two_tets() {
  MidsideNodes nodes;
  nodes.edges = {{0, 1}, {0, 2}, {0, 3}, {0, 4}, {1, 2}, {1, 3}, {1, 4}, {2, 3}, {2, 4}};
  const TetMesh mesh = two_tets();
  for (const auto& [a, b] : nodes.edges)
    nodes.points.emplace_back((mesh.points[a] + mesh.points[b]) / 2 + Eigen::Vector3d(0, 0, 0.125));
  const auto edge = [&](std::uint32_t a, std::uint32_t b) {
    const std::array<std::uint32_t, 2> ends{std::min(a, b), std::max(a, b)};
    return static_cast<std::uint32_t>(std::find(nodes.edges.begin(), nodes.edges.end(), ends) -
                                      nodes.edges.begin());
  };
  for (const auto& [a, b, c, d] : mesh.tets)
    nodes.tets.push_back({edge(a, b), edge(b, c), edge(c, a), edge(a, d), edge(b, d), edge(c, d)});
  for (const auto& [a, b, c] : mesh.faces) nodes.faces.push_back({edge(a, b), edge(b, c), edge(c, a)});
  return nodes;
}

/// Names with what formats stumble on: quotes, bars, letters beyond ASCII. Label 7 has none.
inline std::vector<LabelInfo> cube_infos() {
  return {{1, "LV myocardium", {0.8F, 0.1F, 0.1F}},
          {300, "veine \"cave\" | sup\xc3\xa9rieure", {0.1F, 0.1F, 0.8F}}};
}

inline Field tet_values(const std::string& name, std::vector<float> values) {
  return {name, "", "1", On::kTets, Scale::kSequential, 1, std::move(values)};
}

/// Values that change from tet to tet: the label again, and i / tets.
inline std::vector<Field> cube_cell_data(const TetMesh& mesh) {
  Field fraction = tet_values("fraction_300", {});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    fraction.values.push_back(static_cast<float>(t) / static_cast<float>(mesh.tets.size()));
  return {tet_values("majority_label", {mesh.labels.begin(), mesh.labels.end()}), fraction};
}

}  // namespace voxtet::test
