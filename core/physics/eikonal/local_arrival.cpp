#include "physics/eikonal/local_arrival.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace voxtet::eikonal {
namespace {

/// The corners of the face opposite each corner.
constexpr std::array<std::array<std::uint8_t, 3>, 4> kOpposite{{{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};
/// The place of the edge between two corners in SquaredEdgeTimes.
constexpr std::array<std::array<std::uint8_t, 4>, 4> kEdge{
    {{0, 0, 1, 2}, {0, 0, 3, 4}, {1, 3, 0, 5}, {2, 4, 5, 0}}};
/// A determinant of less than this part of its diagonal's product is too near to rounding: the tetrahedron
/// counts as flat, and only its edges carry waves; a triangle likewise.
constexpr double kFlat = 1e-12;

// A point of the face is y = sum of m_i p_i, where the m_i add up to 1. Let g be the matrix of the products
// (x - p_i) . C^-1 (x - p_j). The function to minimise is m . t + sqrt(m . g m), and it is convex. Its
// minimum T over the plane of the face satisfies
//
//     (T - t) . g^-1 (T - t) = 1,   m a positive multiple of g^-1 (T - t),
//
// where T - t has the components T - t_i. This is a quadratic for T, of which the greater root counts. It has
// none where times differ by more than the wave takes along the face: `room` is then negative. Where all m_i
// are positive, y is on the face. Otherwise the minimum over the face is on an edge that y lies beyond: one
// opposite a corner of negative m_i. For an edge and its two ends the same holds.

double arrival_from_edge(const Eigen::Matrix3d& g, const Eigen::Vector3d& times, int a, int b) {
  const double rise = times[b] - times[a];
  const double length = g(a, a) + g(b, b) - 2 * g(a, b);  // squared, of the edge
  const double room = length - rise * rise;
  const double determinant = g(a, a) * g(b, b) - g(a, b) * g(a, b);
  if (room > 0 && determinant > kFlat * g(a, a) * g(b, b)) {
    const double from_a = ((g(a, a) - g(a, b)) * rise + std::sqrt(determinant * room)) / length;
    const double from_b = from_a - rise;
    if (g(b, b) * from_a >= g(a, b) * from_b && g(a, a) * from_b >= g(a, b) * from_a)
      return times[a] + from_a;
  }
  return std::min(times[a] + std::sqrt(g(a, a)), times[b] + std::sqrt(g(b, b)));
}

/// From the face with corners at `times`.
double arrival_from_face(const Eigen::Matrix3d& g, const Eigen::Vector3d& times) {
  Eigen::Matrix3d adjugate;
  adjugate << g.col(1).cross(g.col(2)), g.col(2).cross(g.col(0)), g.col(0).cross(g.col(1));
  const double determinant = g.col(0).dot(adjugate.col(0));
  const Eigen::Vector3d sums = adjugate.rowwise().sum();
  const double area = sums.sum();  // four times its square, of the face

  const Eigen::Vector3d rise = times.array() - times[0];
  const Eigen::Vector3d turned(rise[2] - rise[1], -rise[2], rise[1]);  // (1, 1, 1) x rise
  const double room = area - turned.dot(g * turned);
  Eigen::Vector3d m(-1, -1, -1);
  if (room > 0 && determinant > kFlat * g(0, 0) * g(1, 1) * g(2, 2)) {
    const double arrival = (sums.dot(rise) + std::sqrt(determinant * room)) / area;
    m = sums * arrival - adjugate * rise;
    if (m.minCoeff() >= 0) return times[0] + arrival;
  }
  double earliest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i)
    if (m[i] < 0) earliest = std::min(earliest, arrival_from_edge(g, times, (i + 1) % 3, (i + 2) % 3));
  return earliest;
}

}  // namespace

double local_arrival(const SquaredEdgeTimes& edges, std::size_t x, const std::array<double, 4>& times) {
  const auto [a, b, c] = kOpposite[x];
  const double xa = edges[kEdge[x][a]], xb = edges[kEdge[x][b]], xc = edges[kEdge[x][c]];
  const double ab = edges[kEdge[a][b]], ac = edges[kEdge[a][c]], bc = edges[kEdge[b][c]];
  const double g_ab = (xa + xb - ab) / 2, g_ac = (xa + xc - ac) / 2, g_bc = (xb + xc - bc) / 2;
  Eigen::Matrix3d g;
  g << xa, g_ab, g_ac, g_ab, xb, g_bc, g_ac, g_bc, xc;
  return arrival_from_face(g, {times[a], times[b], times[c]});
}

}  // namespace voxtet::eikonal
