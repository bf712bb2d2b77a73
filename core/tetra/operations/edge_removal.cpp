#include "tetra/operations/edge_removal.h"

#include <algorithm>
#include <limits>

namespace voxtet::tetra {
namespace {

constexpr std::uint32_t kMost = EdgeRing::kMost;

struct Table {
  double best[kMost][kMost];  ///< of the ring from i to j, closed by the diagonal i-j
  std::uint32_t middle[kMost][kMost];
};

void collect(const Table& table, std::uint32_t i, std::uint32_t j, RingFilling& filling,
             std::uint32_t& count) {
  if (j < i + 2) return;
  const std::uint32_t k = table.middle[i][j];
  filling.triangles[count++] = {i, k, j};
  collect(table, i, k, filling, count);
  collect(table, k, j, filling, count);
}

bool sizes_allow(const TetComplex& complex, const EdgeRing& ring, const RingFilling& filling,
                 const SizeGuard& guard) {
  if (ring.size == 3) return true;
  const double before = guard.misfit(complex.point(ring.a), complex.point(ring.b));
  for (std::uint32_t f = 0; f + 2 < ring.size; ++f) {
    // Every diagonal is the long side of one triangle i < k < j, the one that closes its part of the ring.
    const auto& [i, k, j] = filling.triangles[f];
    if (j == i + ring.size - 1) continue;
    if (!guard.allows(complex.point(ring.ring[i]), complex.point(ring.ring[j]), before)) return false;
  }
  return true;
}

}  // namespace

RingFilling fill_ring(const TetComplex& complex, const EdgeRing& ring, double least) {
  const Point &a = complex.point(ring.a), &b = complex.point(ring.b);
  const auto at = [&](std::uint32_t i) -> const Point& { return complex.point(ring.ring[i]); };
  Table table{};
  for (std::uint32_t i = 0; i + 1 < ring.size; ++i)
    table.best[i][i + 1] = std::numeric_limits<double>::infinity();
  for (std::uint32_t span = 2; span < ring.size; ++span)
    for (std::uint32_t i = 0; i + span < ring.size; ++i) {
      const std::uint32_t j = i + span;
      double best = least;
      for (std::uint32_t k = i + 1; k < j; ++k) {
        double q = std::min(table.best[i][k], table.best[k][j]);
        if (q > best) q = std::min(q, quality(at(i), at(k), at(j), b));
        if (q > best) q = std::min(q, quality(at(i), at(j), at(k), a));
        if (q <= best) continue;
        best = q;
        table.middle[i][j] = k;
      }
      table.best[i][j] = best > least ? best : 0;
    }
  RingFilling filling;
  filling.quality = table.best[0][ring.size - 1];
  std::uint32_t count = 0;
  if (filling.quality > 0) collect(table, 0, ring.size - 1, filling, count);
  return filling;
}

bool remove_edge(TetComplex& complex, std::uint32_t t, std::uint32_t i, std::uint32_t j,
                 const SizeGuard& guard) {
  EdgeRing ring;
  if (!complex.find_ring(t, i, j, ring)) return false;
  double before = complex.quality_of(t);
  for (std::uint32_t r = 0; r < ring.size; ++r) before = std::min(before, complex.quality_of(ring.tets[r]));
  const RingFilling filling = fill_ring(complex, ring, before);
  if (!(filling.quality > before) || !sizes_allow(complex, ring, filling, guard)) return false;
  std::array<Tet, 2 * (kMost - 2)> made;
  for (std::uint32_t f = 0; f + 2 < ring.size; ++f) {
    const std::uint32_t x = ring.ring[filling.triangles[f][0]], y = ring.ring[filling.triangles[f][1]],
                        z = ring.ring[filling.triangles[f][2]];
    made[2 * f] = {x, y, z, ring.b};
    made[2 * f + 1] = {x, z, y, ring.a};
  }
  return complex.replace({ring.tets.data(), ring.size}, {made.data(), 2 * (ring.size - 2)});
}

}  // namespace voxtet::tetra
