#include "physics/mechanics/elements/mass.h"

#include <array>

#include "geometry/elements/tet_measures.h"
#include "physics/mechanics/elements/node_matrix.h"

namespace voxtet::mechanics {
namespace {

using ElementMass = std::array<std::array<double, 10>, 10>;

/// Integrals of products of two functions over a tetrahedron of volume 1.
ElementMass element_mass(bool quadratic) {
  ElementMass mass{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      mass[i][j] = quadratic ? (i == j ? 6 : 1) / 420.0 : (i == j ? 2 : 1) / 20.0;
  if (!quadratic) return mass;
  const auto is_end = [](std::size_t edge, std::size_t corner) {
    const auto [a, b] = kEdgesOfTet[edge];
    return static_cast<std::size_t>(a) == corner || static_cast<std::size_t>(b) == corner;
  };
  for (std::size_t e = 0; e < 6; ++e) {
    for (std::size_t i = 0; i < 4; ++i) mass[i][4 + e] = mass[4 + e][i] = (is_end(e, i) ? -4 : -6) / 420.0;
    for (std::size_t f = 0; f < 6; ++f) {
      const bool meet = is_end(f, static_cast<std::size_t>(kEdgesOfTet[e].first)) ||
                        is_end(f, static_cast<std::size_t>(kEdgesOfTet[e].second));
      mass[4 + e][4 + f] = (e == f ? 32 : meet ? 16 : 8) / 420.0;
    }
  }
  return mass;
}

}  // namespace

void add_mass(const Nodes& nodes, double density_kg_per_mm3, fem::SparseMatrix& matrix) {
  const ElementMass mass = element_mass(nodes.quadratic());
  for (std::size_t t = 0; t < nodes.tets(); ++t) {
    const double whole = density_kg_per_mm3 * nodes.volume_mm3(t);
    for (std::size_t a = 0; a < nodes.per_tet(); ++a)
      for (std::size_t b = 0; b < nodes.per_tet(); ++b)
        add_block(nodes.of_tet(t)[a], nodes.of_tet(t)[b], whole * mass[a][b] * Eigen::Matrix3d::Identity(),
                  matrix);
  }
}

}  // namespace voxtet::mechanics
