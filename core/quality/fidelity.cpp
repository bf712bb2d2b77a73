#include "quality/fidelity.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/elements/tet_measures.h"
#include "geometry/grid/rasterise.h"
#include "geometry/topology/adjacency.h"
#include "quality/summarise.h"

namespace voxtet {
namespace {

std::vector<float> lengths_of(const std::vector<Edge>& edges, const std::vector<Eigen::Vector3d>& points) {
  std::vector<float> lengths;
  lengths.reserve(edges.size());
  for (const auto& [a, b] : edges) lengths.push_back(static_cast<float>((points[b] - points[a]).norm()));
  return lengths;
}

}  // namespace

std::vector<LabelFidelity> measure_labels(const TetMesh& mesh, const LabelVolume& volume,
                                          const SizingField& sizing,
                                          const std::map<Label, double>& more_mm3) {
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
    if (const auto more = more_mm3.find(f.label); more != more_mm3.end()) f.voxel_mm3 += more->second;
    f.volume_error_percent = f.voxels > 0 ? 100 * (f.mesh_mm3 - f.voxel_mm3) / f.voxel_mm3 : 0;
    f.dice = 2.0 * static_cast<double>(both[label]) / static_cast<double>(f.voxels + meshed[label]);
    const std::vector<Edge> edges = tet_edges(tets[label], mesh.points.size());
    std::vector<float> lengths = lengths_of(edges, mesh.points), targets;
    targets.reserve(edges.size());
    for (const auto& [a, b] : edges)
      targets.push_back(static_cast<float>(sizing.at((mesh.points[a] + mesh.points[b]) / 2)));
    f.median_edge_mm = quantile(lengths, 0.5);
    f.target_edge_mm = quantile(targets, 0.5);
    out.push_back(f);
  }
  return out;
}

}  // namespace voxtet
