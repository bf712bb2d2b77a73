// The measures of a peer's mesh, by the code that measures voxtet's own: `measure_peer SURFACE MESH.vtu`,
// JSON to standard output. Sizes are log2(edge / target) over all edges.
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "bench/peers/surface_file.h"
#include "geometry/elements/tet_measures.h"
#include "geometry/topology/adjacency.h"
#include "io/mesh/read_mesh.h"
#include "pipeline/report.h"
#include "quality/measure_quality.h"
#include "quality/summarise.h"

using namespace voxtet;

namespace {

constexpr int kBins = 90;

nlohmann::json sizes_json(const TetMesh& mesh, const SizingField& sizing) {
  std::vector<float> ratios, absolute;
  for (const auto& [a, b] : tet_edges(mesh.tets, mesh.points.size())) {
    const Eigen::Vector3d &p = mesh.points[a], &q = mesh.points[b];
    ratios.push_back(static_cast<float>(std::log2((q - p).norm() / sizing.at((p + q) / 2))));
    absolute.push_back(std::abs(ratios.back()));
  }
  return {{"median", quantile(ratios, 0.5)}, {"p95_absolute", quantile(absolute, 0.95)}};
}

nlohmann::json volumes_json(const TetMesh& mesh) {
  std::map<Label, double> volumes;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto [a, b, c, d] = mesh.tets[t];
    volumes[mesh.labels[t]] +=
        tet_volume_mm3({mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]});
  }
  nlohmann::json out = nlohmann::json::object();
  for (const auto& [label, mm3] : volumes) out[std::to_string(label)] = mm3;
  return out;
}

int fail(const Error& error) {
  std::fprintf(stderr, "%s\n", error.message.c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "measure_peer: expected SURFACE MESH.vtu\n");
    return 2;
  }
  const Result<peers::FillTask> task = peers::read_fill_task(argv[1]);
  if (!task) return fail(task.error());
  const Result<TetMesh> mesh = read_tet_mesh_file(argv[2]);
  if (!mesh) return fail(mesh.error());
  QualityParams params;
  params.histogram_bins = kBins;
  RunContext ctx;
  const Result<QualityReport> report = measure_mesh(*mesh, params, ctx);
  if (!report) return fail(report.error());
  nlohmann::json figures = quality_json(*report);
  figures["tets"] = mesh->tets.size();
  figures["sizes"] = sizes_json(*mesh, task->sizing);
  figures["volumes_mm3"] = volumes_json(*mesh);
  std::printf("%s\n", figures.dump().c_str());
  return 0;
}
