// The promise of SurfaceMesh, checked: every label's boundary is a closed, outward 2-manifold.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "types/surface_mesh.h"

namespace voxtet::test {

/// What was found on the boundary of one label.
struct LabelTopology {
  std::size_t points = 0, edges = 0, triangles = 0;
  std::size_t bad_edges = 0;  ///< with other than two triangles, or traversed twice in the same direction
  std::size_t pinched_points = 0;  ///< excess cycles of vertex links
  std::size_t components = 0;
  double volume_mm3 = 0;  ///< signed
  long euler() const {
    return static_cast<long>(points) - static_cast<long>(edges) + static_cast<long>(triangles);
  }
};

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[root(a)] = root(b); }
  std::size_t roots() {
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < parent_.size(); ++i) count += root(i) == i ? 1 : 0;
    return count;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Topology of the closed surface made of `triangles`, already turned outwards.
inline LabelTopology topology_of(const std::vector<Eigen::Vector3d>& points,
                                 const std::vector<Triangle>& triangles) {
  struct Half {
    std::uint32_t low, high, triangle;
    bool forward;
  };
  LabelTopology out;
  out.triangles = triangles.size();
  std::vector<Half> halves;
  std::vector<std::uint32_t> used;
  const Eigen::Vector3d reference = points.empty() ? Eigen::Vector3d::Zero() : points.front();
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const Triangle& v = triangles[t];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = v[i], b = v[(i + 1) % 3];
      halves.push_back({std::min(a, b), std::max(a, b), t, a < b});
      used.push_back(a);
    }
    out.volume_mm3 +=
        (points[v[0]] - reference).dot((points[v[1]] - reference).cross(points[v[2]] - reference)) / 6;
  }
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  out.points = used.size();
  std::sort(halves.begin(), halves.end(), [](const Half& a, const Half& b) {
    return std::array{a.low, a.high, a.triangle} < std::array{b.low, b.high, b.triangle};
  });
  // Corners of one vertex that triangles sharing an edge connect form one cycle of its link.
  DisjointSets corners(3 * triangles.size()), pieces(triangles.size());
  const auto corner = [&](std::uint32_t t, std::uint32_t vertex) {
    const auto at = std::find(triangles[t].begin(), triangles[t].end(), vertex) - triangles[t].begin();
    return 3 * t + static_cast<std::uint32_t>(at);
  };
  for (std::size_t i = 0; i < halves.size();) {
    std::size_t stop = i;
    while (stop < halves.size() && halves[stop].low == halves[i].low && halves[stop].high == halves[i].high)
      ++stop;
    ++out.edges;
    if (stop - i != 2 || halves[i].forward == halves[i + 1].forward) ++out.bad_edges;
    for (std::size_t j = i + 1; j < stop; ++j) {
      pieces.join(halves[i].triangle, halves[j].triangle);
      for (const std::uint32_t v : {halves[i].low, halves[i].high})
        corners.join(corner(halves[i].triangle, v), corner(halves[j].triangle, v));
    }
    i = stop;
  }
  out.pinched_points = corners.roots() - out.points;
  out.components = pieces.roots();
  return out;
}

/// Labels with triangles, background excluded, ascending.
inline std::vector<Label> labels_of(const SurfaceMesh& surface) {
  std::vector<bool> seen(65536, false);
  for (const Sides& sides : surface.sides) seen[sides[0]] = seen[sides[1]] = true;
  std::vector<Label> labels;
  for (std::size_t l = 1; l < seen.size(); ++l)
    if (seen[l]) labels.push_back(static_cast<Label>(l));
  return labels;
}

/// One entry a label of `labels_of(surface)`. Needs valid indices.
inline std::vector<LabelTopology> label_topologies(const SurfaceMesh& surface) {
  const std::vector<Label> labels = labels_of(surface);
  std::vector<std::size_t> place(65536, labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i) place[labels[i]] = i;
  std::vector<std::vector<Triangle>> parts(labels.size() + 1);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    Triangle triangle = surface.triangles[t];
    parts[place[surface.sides[t][0]]].push_back(triangle);
    std::swap(triangle[1], triangle[2]);
    parts[place[surface.sides[t][1]]].push_back(triangle);
  }
  std::vector<LabelTopology> out;
  for (std::size_t i = 0; i < labels.size(); ++i) out.push_back(topology_of(surface.points, parts[i]));
  return out;
}

/// First broken promise in words, or empty.
inline std::string surface_fault(const SurfaceMesh& surface) {
  if (surface.sides.size() != surface.triangles.size()) return "sides and triangles differ in number";
  std::vector<bool> used(surface.points.size(), false);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Triangle& v = surface.triangles[t];
    for (const std::uint32_t point : v) {
      if (point >= surface.points.size()) return "triangle " + std::to_string(t) + " names a missing point";
      used[point] = true;
    }
    if (v[0] == v[1] || v[1] == v[2] || v[0] == v[2])
      return "triangle " + std::to_string(t) + " repeats a point";
    if (surface.sides[t][0] <= surface.sides[t][1])
      return "triangle " + std::to_string(t) + " has sides " + std::to_string(surface.sides[t][0]) + ", " +
             std::to_string(surface.sides[t][1]);
  }
  for (std::size_t p = 0; p < used.size(); ++p) {
    if (!used[p]) return "point " + std::to_string(p) + " is not used";
    if (!surface.points[p].allFinite()) return "point " + std::to_string(p) + " is not finite";
  }
  const std::vector<Label> labels = labels_of(surface);
  const std::vector<LabelTopology> found = label_topologies(surface);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const std::string name = "label " + std::to_string(labels[i]) + " has ";
    if (found[i].bad_edges)
      return name + std::to_string(found[i].bad_edges) + " edges without two opposite triangles";
    if (found[i].pinched_points) return name + std::to_string(found[i].pinched_points) + " pinched points";
    if (!(found[i].volume_mm3 > 0)) return name + "volume " + std::to_string(found[i].volume_mm3);
  }
  return {};
}

inline ::testing::AssertionResult is_valid_surface(const SurfaceMesh& surface) {
  const std::string fault = surface_fault(surface);
  return fault.empty() ? ::testing::AssertionSuccess() : ::testing::AssertionFailure() << fault;
}

}  // namespace voxtet::test
