#include "geometry/elements/surface_curvature.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "base/buckets.h"
#include "geometry/elements/surface_measures.h"

namespace voxtet {
namespace {

using Eigen::Vector3d;

/// A directed edge of a triangle, at its lower point.
struct HalfEdge {
  std::uint32_t other, triangle;
  bool forward;  ///< runs from the lower point to `other`
};

/// The six entries of a symmetric tensor, xx yy zz xy xz yz, then the area that it belongs to.
using Bend = std::array<float, 7>;

struct Rows {
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<Bend> bends;
  double mean_edge_mm = 0;
};

/// Every edge once, and what each point has of the turning of its own edges.
Rows gather(const SurfaceMesh& surface) {
  Rows rows;
  rows.bends.assign(surface.points.size(), Bend{});
  std::vector<Vector3d> normals;
  normals.reserve(surface.triangles.size());
  Buckets<HalfEdge> halves(surface.points.size());
  const auto each_half = [&](auto&& visit) {
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = surface.triangles[t][i], b = surface.triangles[t][(i + 1) % 3];
        visit(std::min(a, b), HalfEdge{std::max(a, b), t, a < b});
      }
  };
  each_half([&](std::uint32_t low, const HalfEdge&) { halves.count(low); });
  halves.allocate();
  each_half([&](std::uint32_t low, const HalfEdge& half) { halves.add(low, half); });
  for (const auto& [a, b, c] : surface.triangles) {
    const Vector3d cross = triangle_cross(surface.points[a], surface.points[b], surface.points[c]);
    const double twice = cross.norm();
    normals.push_back(twice > 0 ? Vector3d(cross / twice) : Vector3d::Zero());
    for (const std::uint32_t p : {a, b, c}) rows.bends[p][6] += static_cast<float>(twice / 6);
  }
  for (std::uint32_t p = 0; p < halves.size(); ++p) {
    const std::span<HalfEdge> at = halves.at(p);
    std::sort(at.begin(), at.end(), [](const HalfEdge& x, const HalfEdge& y) {
      return std::pair(x.other, x.triangle) < std::pair(y.other, y.triangle);
    });
    for (std::size_t i = 0, stop = 0; i < at.size(); i = stop) {
      while (stop < at.size() && at[stop].other == at[i].other) ++stop;
      const Vector3d edge = surface.points[at[i].other] - surface.points[p];
      const double length = edge.norm();
      rows.edges.push_back({p, at[i].other});
      rows.mean_edge_mm += length;
      if (stop - i != 2 || !(length > 0)) continue;
      const Vector3d &m = normals[at[i].triangle], &n = normals[at[i + 1].triangle];
      const bool convex = (m.cross(n).dot(edge) > 0) == at[i].forward;
      // Half for each end; over the length once, because the direction enters twice.
      const double turn = (convex ? 0.5 : -0.5) * (n - m).norm() / length;
      const std::array<double, 6> along{edge.x() * edge.x(), edge.y() * edge.y(), edge.z() * edge.z(),
                                        edge.x() * edge.y(), edge.x() * edge.z(), edge.y() * edge.z()};
      for (const std::uint32_t end : {p, at[i].other})
        for (std::size_t k = 0; k < 6; ++k) rows.bends[end][k] += static_cast<float>(turn * along[k]);
    }
  }
  rows.mean_edge_mm /= static_cast<double>(std::max<std::size_t>(rows.edges.size(), 1));
  return rows;
}

/// Each point shares what it has with its neighbours, evenly, over and over: nothing is lost.
void spread(Rows& rows, int rounds) {
  std::vector<float> shares(rows.bends.size(), 1.F);
  for (const auto& [a, b] : rows.edges) ++shares[a], ++shares[b];
  std::vector<Bend> next;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t p = 0; p < shares.size(); ++p)
      for (float& value : rows.bends[p]) value /= shares[p];
    next = rows.bends;
    for (const auto& [a, b] : rows.edges)
      for (std::size_t k = 0; k < 7; ++k) {
        next[a][k] += rows.bends[b][k];
        next[b][k] += rows.bends[a][k];
      }
    rows.bends.swap(next);
  }
}

}  // namespace

std::vector<float> surface_curvature(const SurfaceMesh& surface, double width_mm) {
  Rows rows = gather(surface);
  // A step to one of seven places at an edge's length or none: variance along an axis 3/7 of a squared edge.
  const double step2 = 3.0 / 7 * rows.mean_edge_mm * rows.mean_edge_mm;
  if (step2 > 0) spread(rows, static_cast<int>(std::lround(width_mm * width_mm / step2)));
  std::vector<float> curvature;
  curvature.reserve(rows.bends.size());
  for (const Bend& bend : rows.bends) {
    const auto& [xx, yy, zz, xy, xz, yz, area] = bend;
    // One of the three eigenvalues, that along the normal, is about 0: the others follow from two invariants.
    const double trace = xx + yy + zz;
    const double squares = xx * xx + yy * yy + zz * zz + 2.0 * (xy * xy + xz * xz + yz * yz);
    const double largest = (std::abs(trace) + std::sqrt(std::max(0.0, 2 * squares - trace * trace))) / 2;
    curvature.push_back(area > 0 ? static_cast<float>(largest / area) : 0.F);
  }
  return curvature;
}

}  // namespace voxtet
