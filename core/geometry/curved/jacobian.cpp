#include "geometry/curved/jacobian.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "types/tet_mesh.h"

namespace voxtet {
namespace {

constexpr int kMostHalvings = 12;
constexpr double kTightness = 0.01;

/// The coefficient of a cubic at three corners, in any order: its blossom there.
using Cubic = std::array<double, 20>;
using Triple = std::array<std::size_t, 3>;

constexpr std::array<Triple, 20> kTriples = [] {
  std::array<Triple, 20> triples{};
  std::size_t n = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i; j < 4; ++j)
      for (std::size_t k = j; k < 4; ++k) triples[n++] = {i, j, k};
  return triples;
}();

/// Of three corners, as digits to the base 4.
constexpr std::array<std::uint8_t, 64> kPlaces = [] {
  std::array<std::uint8_t, 64> places{};
  for (std::size_t n = 0; n < 20; ++n) {
    const auto [i, j, k] = kTriples[n];
    for (const auto& [a, b, c] : {Triple{i, j, k}, Triple{i, k, j}, Triple{j, i, k}, Triple{j, k, i},
                                  Triple{k, i, j}, Triple{k, j, i}})
      places[16 * a + 4 * b + c] = static_cast<std::uint8_t>(n);
  }
  return places;
}();

double at(const Cubic& cubic, const Triple& corners) {
  return cubic[kPlaces[16 * corners[0] + 4 * corners[1] + corners[2]]];
}

Cubic determinant_of(const Tet10Points& x) {
  // The map's coefficients, then those of its derivatives towards corner k + 1, which are linear.
  std::array<std::array<Eigen::Vector3d, 4>, 4> map;
  for (std::size_t i = 0; i < 4; ++i) map[i][i] = x[i];
  for (std::size_t e = 0; e < 6; ++e) {
    const auto& [i, j] = kMidsidesOfTet[e];
    map[i][j] = map[j][i] = 2 * x[4 + e] - (x[i] + x[j]) / 2;
  }
  std::array<std::array<Eigen::Vector3d, 4>, 3> towards;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 4; ++i) towards[k][i] = 2 * (map[k + 1][i] - map[0][i]);
  Cubic cubic{};
  for (std::size_t n = 0; n < 20; ++n) {
    const auto [i, j, k] = kTriples[n];
    for (const auto& [a, b, c] : {Triple{i, j, k}, Triple{i, k, j}, Triple{j, i, k}, Triple{j, k, i},
                                  Triple{k, i, j}, Triple{k, j, i}})
      cubic[n] += towards[0][a].dot(towards[1][b].cross(towards[2][c])) / 6;
  }
  return cubic;
}

/// The cubic on the half of its tetrahedron where `gone` has moved to the middle of its edge to `kept`.
Cubic half_of(const Cubic& cubic, std::size_t kept, std::size_t gone) {
  Cubic half{};
  for (std::size_t n = 0; n < 20; ++n) {
    // Each time that `gone` stands in the triple, it is the mean of both ends.
    double sum = 0, terms = 0;
    for (unsigned choice = 0; choice < 8; ++choice) {
      Triple corners = kTriples[n];
      bool once = true;
      for (std::size_t c = 0; c < 3; ++c) {
        if ((choice >> c & 1U) == 0) continue;
        once = once && corners[c] == gone;
        corners[c] = kept;
      }
      if (!once) continue;
      sum += at(cubic, corners);
      ++terms;
    }
    half[n] = sum / terms;
  }
  return half;
}

double lower_bound(const Cubic& cubic, double tolerance, int halvings) {
  const double bound = *std::min_element(cubic.begin(), cubic.end());
  double taken = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 4; ++i) taken = std::min(taken, at(cubic, {i, i, i}));
  if (taken - bound <= tolerance || halvings == kMostHalvings) return bound;
  // Opposite edges follow one another.
  constexpr std::array<std::pair<std::size_t, std::size_t>, 6> kTurns{
      {{0, 1}, {2, 3}, {0, 2}, {1, 3}, {0, 3}, {1, 2}}};
  const auto& [i, j] = kTurns[static_cast<std::size_t>(halvings) % 6];
  return std::min(lower_bound(half_of(cubic, i, j), tolerance, halvings + 1),
                  lower_bound(half_of(cubic, j, i), tolerance, halvings + 1));
}

}  // namespace

DeterminantBounds determinant_bounds(const Tet10Points& nodes) {
  const Cubic cubic = determinant_of(nodes);
  const double straight = (nodes[1] - nodes[0]).dot((nodes[2] - nodes[0]).cross(nodes[3] - nodes[0]));
  return {lower_bound(cubic, kTightness * std::abs(straight), 0),
          *std::max_element(cubic.begin(), cubic.end())};
}

}  // namespace voxtet
