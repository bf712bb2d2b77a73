#include "tetra/check_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace voxtet {
namespace {

constexpr std::size_t kMaxPlaces = 1000;
constexpr double kDegreesPerRadian = 57.295779513082321;

Error meshing_error(std::string message, const ErrorPlace& where = {}) {
  return {ErrorCode::kMeshing, "tetra", std::move(message), where};
}

/// Twice the area over the longest side squared, below which a triangle counts as degenerate.
constexpr double kFlat = 1e-10;

bool is_flat(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return !((b - a).cross(c - a).norm() > kFlat * longest);
}

}  // namespace

Status check_triangles(const SurfaceMesh& surface) {
  const std::size_t n = surface.points.size();
  if (surface.triangles.empty()) return meshing_error("the surface has no triangle");
  if (surface.sides.size() != surface.triangles.size())
    return meshing_error("the surface has " + std::to_string(surface.triangles.size()) + " triangles but " +
                         std::to_string(surface.sides.size()) + " pairs of sides");
  for (const Eigen::Vector3d& p : surface.points)
    if (!p.allFinite()) return meshing_error("a point of the surface is not finite");

  std::vector<bool> used(n, false);
  ErrorPlace flat;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const auto [a, b, c] = surface.triangles[t];
    if (a >= n || b >= n || c >= n)
      return meshing_error(
          "triangle " + std::to_string(t) + " names a point beyond the " + std::to_string(n) + " there are",
          {{}, {t}});
    if (surface.sides[t][0] <= surface.sides[t][1])
      return meshing_error("triangle " + std::to_string(t) + " has sides " +
                               std::to_string(surface.sides[t][0]) + " and " +
                               std::to_string(surface.sides[t][1]) + "; the first must be the larger",
                           {{}, {t}});
    used[a] = used[b] = used[c] = true;
    if (a != b && b != c && c != a && !is_flat(surface.points[a], surface.points[b], surface.points[c]))
      continue;
    if (flat.elements.size() < kMaxPlaces) {
      flat.elements.push_back(t);
      flat.points.push_back((surface.points[a] + surface.points[b] + surface.points[c]) / 3);
    }
  }
  if (!flat.elements.empty())
    return meshing_error(std::to_string(flat.elements.size()) + " triangles of the surface have no area",
                         flat);
  const auto unused = std::find(used.begin(), used.end(), false);
  if (unused != used.end())
    return meshing_error(
        "point " + std::to_string(unused - used.begin()) + " of the surface belongs to no triangle",
        {{surface.points[static_cast<std::size_t>(unused - used.begin())]}, {}});
  return std::monostate{};
}

Status check_closed(const SurfaceMesh& surface, const EdgeGroups& edges) {
  ErrorPlace open;
  std::size_t open_edges = 0;
  std::vector<std::pair<Label, int>> balance;
  const auto count = [&balance](Label label, int step) {
    for (auto& [seen, sum] : balance)
      if (seen == label) {
        sum += step;
        return;
      }
    balance.emplace_back(label, step);
  };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    balance.clear();
    for (const TriangleUse& use : edges[e]) {
      const int step = use.forward ? 1 : -1;
      count(surface.sides[use.triangle][0], step);
      count(surface.sides[use.triangle][1], -step);
    }
    if (std::all_of(balance.begin(), balance.end(), [](const auto& entry) { return entry.second == 0; }))
      continue;
    if (++open_edges > kMaxPlaces) continue;
    for (const TriangleUse& use : edges[e]) open.elements.push_back(use.triangle);
    open.points.push_back((surface.points[edges[e][0].low] + surface.points[edges[e][0].high]) / 2);
  }
  if (open_edges == 0) return std::monostate{};
  std::sort(open.elements.begin(), open.elements.end());
  open.elements.erase(std::unique(open.elements.begin(), open.elements.end()), open.elements.end());
  return meshing_error("the surface is open at " + std::to_string(open_edges) +
                           " edges; every label's boundary must be closed",
                       open);
}

SharpestEdge find_sharpest_edge(const SurfaceMesh& surface, const EdgeGroups& edges) {
  double largest_cosine = -1;
  SharpestEdge sharpest;
  std::vector<Eigen::Vector3d> away;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const TriangleUse& first = edges[e][0];
    const Eigen::Vector3d& low = surface.points[first.low];
    const Eigen::Vector3d axis = (surface.points[first.high] - low).normalized();
    away.clear();
    for (const TriangleUse& use : edges[e]) {
      const Eigen::Vector3d arm = surface.points[surface.triangles[use.triangle][(use.corner + 2) % 3]] - low;
      away.push_back((arm - axis * axis.dot(arm)).normalized());
    }
    for (std::size_t i = 0; i < away.size(); ++i)
      for (std::size_t j = i + 1; j < away.size(); ++j) {
        const double cosine = away[i].dot(away[j]);
        if (cosine <= largest_cosine) continue;
        largest_cosine = cosine;
        sharpest.place = (low + surface.points[first.high]) / 2;
      }
  }
  sharpest.angle_deg = std::acos(std::clamp(largest_cosine, -1.0, 1.0)) * kDegreesPerRadian;
  return sharpest;
}

}  // namespace voxtet
