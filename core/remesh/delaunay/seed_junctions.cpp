#include "remesh/delaunay/seed_junctions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace voxtet::remesh {

std::vector<Edge> junction_edges(const SurfaceMesh& surface) {
  // The higher ends of all edges, by their lower ends.
  std::vector<std::uint32_t> start(surface.points.size() + 2, 0);
  const auto for_edges = [&](auto&& visit) {
    for (const Triangle& t : surface.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = t[i], b = t[(i + 1) % 3];
        visit(std::min(a, b), std::max(a, b));
      }
  };
  for_edges([&](std::uint32_t low, std::uint32_t) { ++start[low + 2]; });
  for (std::size_t p = 2; p < start.size(); ++p) start[p] += start[p - 1];
  std::vector<std::uint32_t> highs(start.back());
  for_edges([&](std::uint32_t low, std::uint32_t high) { highs[start[low + 1]++] = high; });
  std::vector<Edge> out;
  for (std::uint32_t low = 0; low < surface.points.size(); ++low) {
    const auto last = highs.begin() + start[low + 1];
    std::sort(highs.begin() + start[low], last);
    for (auto e = highs.begin() + start[low]; e != last;) {
      const auto next = std::find_if(e, last, [&](std::uint32_t other) { return other != *e; });
      if (next - e > 2) out.push_back({low, *e});
      e = next;
    }
  }
  return out;
}

namespace {

/// The points of one curve in order; the first and the last are equal where it closes.
using Curve = std::vector<std::uint32_t>;

/// The edges cut at every point that has not two of them, and the closed curves that are left.
std::vector<Curve> trace_curves(const std::vector<Edge>& edges, std::size_t points) {
  std::vector<std::uint32_t> first(points + 1, 0), at(2 * edges.size());
  for (const Edge& e : edges)
    for (const std::uint32_t p : e) ++first[p + 1];
  for (std::size_t p = 0; p < points; ++p) first[p + 1] += first[p];
  std::vector<std::uint32_t> fill(first.begin(), first.end() - 1);
  for (std::uint32_t e = 0; e < edges.size(); ++e)
    for (const std::uint32_t p : edges[e]) at[fill[p]++] = e;

  std::vector<std::uint8_t> done(edges.size(), 0);
  const auto ends_at = [&](std::uint32_t p) { return first[p + 1] - first[p] != 2; };
  const auto follow = [&](std::uint32_t p, std::uint32_t edge) {
    Curve curve{p};
    for (;;) {
      done[edge] = 1;
      p = edges[edge][0] == p ? edges[edge][1] : edges[edge][0];
      curve.push_back(p);
      if (ends_at(p)) return curve;
      edge = at[first[p]] == edge ? at[first[p] + 1] : at[first[p]];
      if (done[edge]) return curve;
    }
  };
  std::vector<Curve> curves;
  for (const bool closed : {false, true})
    for (std::uint32_t e = 0; e < edges.size(); ++e)
      for (const std::uint32_t p : edges[e])
        if (!done[e] && (closed || ends_at(p))) curves.push_back(follow(p, e));
  return curves;
}

/// Appends the points that divide a curve evenly, measured in target edge lengths.
void divide(const SurfaceMesh& surface, const SizingField& sizing, const Curve& curve,
            std::vector<Eigen::Vector3d>& out) {
  std::vector<double> along{0};
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const Eigen::Vector3d &a = surface.points[curve[i - 1]], &b = surface.points[curve[i]];
    along.push_back(along.back() + (b - a).norm() / sizing.at(0.5 * (a + b)));
  }
  const int parts = std::max(1, static_cast<int>(std::lround(along.back())));
  std::size_t i = 1;
  for (int k = 1; k < parts; ++k) {
    const double wanted = along.back() * k / parts;
    while (along[i] < wanted) ++i;
    const double t = (wanted - along[i - 1]) / (along[i] - along[i - 1]);
    out.push_back((1 - t) * surface.points[curve[i - 1]] + t * surface.points[curve[i]]);
  }
}

}  // namespace

std::vector<Eigen::Vector3d> seed_junctions(const SurfaceMesh& surface, const SizingField& sizing) {
  const std::vector<Curve> curves = trace_curves(junction_edges(surface), surface.points.size());
  std::vector<std::uint32_t> ends;
  for (const Curve& curve : curves) ends.insert(ends.end(), {curve.front(), curve.back()});
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<Eigen::Vector3d> out;
  for (const std::uint32_t p : ends) out.push_back(surface.points[p]);
  for (const Curve& curve : curves) divide(surface, sizing, curve, out);
  return out;
}

}  // namespace voxtet::remesh
