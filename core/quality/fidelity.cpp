#include "quality/fidelity.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/adjacency.h"
#include "geometry/closest_point.h"
#include "geometry/rasterise.h"
#include "geometry/tet_measures.h"
#include "quality/summarise.h"

namespace voxtet {
namespace {

constexpr double kMaxSamples = 400'000;

struct Samples {
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
  std::vector<double> reach_mm;  ///< from the sample to the farthest point of its sub-triangle
};

double longest_edge(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
}

/// Rows of sub-triangles that a triangle is cut into.
int rows_of(double longest, double spacing) {
  return std::max(1, static_cast<int>(std::ceil(longest / spacing)));
}

/// The spacing asked for, or a larger one that needs at most kMaxSamples, or else one sample a triangle.
double affordable_spacing(const TriangleSet& set, double spacing) {
  std::vector<double> longest;
  longest.reserve(set.triangles.size());
  for (const auto& [i, j, k] : set.triangles)
    longest.push_back(longest_edge(set.points[i], set.points[j], set.points[k]));
  const double most = longest.empty() ? 0 : *std::max_element(longest.begin(), longest.end());
  const double limit = std::max(kMaxSamples, static_cast<double>(longest.size()));
  while (spacing < most) {
    double samples = 0;
    for (const double length : longest) {
      const double rows = std::max(1.0, std::ceil(length / spacing));
      samples += rows * rows;
    }
    if (samples <= limit) break;
    spacing *= std::max(1.05, std::sqrt(samples / limit));
  }
  return spacing;
}

Samples sample(const TriangleSet& set, double spacing_mm) {
  const double spacing = affordable_spacing(set, spacing_mm);
  Samples out;
  for (const auto& [i, j, k] : set.triangles) {
    const Eigen::Vector3d &a = set.points[i], &b = set.points[j], &c = set.points[k];
    const double longest = longest_edge(a, b, c);
    const int n = rows_of(longest, spacing);
    const double weight = 0.5 * (b - a).cross(c - a).norm() / (static_cast<double>(n) * n);
    const Eigen::Vector3d u = (b - a) / n, v = (c - a) / n;
    const Eigen::Vector3d centre = (a + b + c) / 3;
    const double reach = std::sqrt(std::max({(a - centre).squaredNorm(), (b - centre).squaredNorm(),
                                             (c - centre).squaredNorm()})) /
                         n;
    out.reach_mm.insert(out.reach_mm.end(), static_cast<std::size_t>(n) * static_cast<std::size_t>(n), reach);
    for (int row = 0; row < n; ++row) {
      for (int column = 0; column + row < n; ++column) {
        const Eigen::Vector3d corner = a + row * u + column * v;
        out.points.push_back(corner + (u + v) / 3);
        out.weights.push_back(weight);
        if (column + row + 1 < n) {
          out.points.push_back(corner + (u + v) * (2.0 / 3));
          out.weights.push_back(weight);
        }
      }
    }
  }
  return out;
}

std::vector<float> lengths_of(const std::vector<Edge>& edges, const std::vector<Eigen::Vector3d>& points) {
  std::vector<float> lengths;
  lengths.reserve(edges.size());
  for (const auto& [a, b] : edges) lengths.push_back(static_cast<float>((points[b] - points[a]).norm()));
  return lengths;
}

}  // namespace

std::vector<LabelFidelity> measure_labels(const TetMesh& mesh, const LabelVolume& volume,
                                          const SizingField& sizing) {
  const std::vector<Label> raster = rasterise(mesh, mesh.labels, volume);
  std::vector<LabelFidelity> all(65536);
  std::vector<std::uint64_t> both(65536, 0), meshed(65536, 0);
  for (std::size_t i = 0; i < raster.size(); ++i) {
    ++all[volume.labels[i]].voxels;
    ++meshed[raster[i]];
    if (raster[i] == volume.labels[i]) ++both[raster[i]];
  }
  std::vector<std::vector<Tet>> tets(65536);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto [a, b, c, d] = mesh.tets[t];
    all[mesh.labels[t]].mesh_mm3 +=
        tet_volume_mm3({mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]});
    tets[mesh.labels[t]].push_back(mesh.tets[t]);
  }
  std::vector<LabelFidelity> out;
  for (std::size_t label = 1; label < all.size(); ++label) {
    LabelFidelity& f = all[label];
    f.tets = tets[label].size();
    if (f.voxels == 0 && f.tets == 0) continue;
    f.label = static_cast<Label>(label);
    f.voxel_mm3 = static_cast<double>(f.voxels) * volume.voxel_mm3();
    f.volume_error_percent = f.voxels > 0 ? 100 * (f.mesh_mm3 - f.voxel_mm3) / f.voxel_mm3 : 0;
    f.dice = 2.0 * static_cast<double>(both[label]) / static_cast<double>(f.voxels + meshed[label]);
    const std::vector<Edge> edges = tet_edges(tets[label], mesh.points.size());
    std::vector<float> lengths = lengths_of(edges, mesh.points), wished;
    wished.reserve(edges.size());
    for (const auto& [a, b] : edges)
      wished.push_back(static_cast<float>(sizing.at((mesh.points[a] + mesh.points[b]) / 2)));
    f.median_edge_mm = quantile(lengths, 0.5);
    f.wished_edge_mm = quantile(wished, 0.5);
    out.push_back(f);
  }
  return out;
}

DistanceSummary measure_distance(const TriangleSet& from, const TriangleSet& to, double spacing_mm) {
  DistanceSummary out;
  if (from.triangles.empty() || to.triangles.empty()) return out;
  const ClosestPointTree tree(to.points, to.triangles);
  const Samples samples = sample(from, spacing_mm);
  std::vector<std::pair<float, float>> found;  // distance, weight
  found.reserve(samples.points.size());
  double sum = 0, squares = 0, area = 0, bound = 0;
  std::uint32_t hint = 0;
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    const ClosestPointTree::Hit hit = tree.closest(samples.points[i], hint);
    hint = hit.triangle;
    sum += samples.weights[i] * hit.distance_mm;
    squares += samples.weights[i] * hit.distance_mm * hit.distance_mm;
    area += samples.weights[i];
    out.max_mm = std::max(out.max_mm, hit.distance_mm);
    // The distance to a surface changes by no more than the way gone.
    bound = std::max(bound, hit.distance_mm + samples.reach_mm[i]);
    found.emplace_back(static_cast<float>(hit.distance_mm), static_cast<float>(samples.weights[i]));
  }
  out.samples = found.size();
  out.mean_mm = sum / area;
  out.rms_mm = std::sqrt(squares / area);
  out.uncertainty_mm = bound - out.max_mm;
  std::sort(found.begin(), found.end());
  double below = 0;
  for (const auto& [distance, weight] : found) {
    below += weight;
    out.p95_mm = distance;
    if (below >= 0.95 * area) break;
  }
  return out;
}

}  // namespace voxtet
