#include "sweep/fidelity/measure_fidelity.h"

#include <ctime>

#include "geometry/topology/compare_topology.h"
#include "geometry/topology/label_topology.h"
#include "quality/fidelity.h"
#include "quality/summarise.h"
#include "quality/surface_distance.h"
#include "quality/tet_measure_table.h"

namespace voxtet::sweep {
namespace {

Status run_stages(Session& session, nlohmann::json& row) {
  RunContext ctx;
  for (const Stage stage : {Stage::kVolume, Stage::kSurface, Stage::kSmooth, Stage::kSizing, Stage::kRemesh,
                            Stage::kTetra, Stage::kOptimise}) {
    const std::clock_t start = std::clock();
    if (Status done = session.run(stage, ctx); !done) return done;
    row["seconds"][name_of(stage)] = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  }
  return std::monostate{};
}

Status measure_both_ways(const TriangleSet& mesh, const TriangleSet& surface, double voxel_mm,
                         const std::string& what, nlohmann::json& row) {
  RunContext ctx;
  const Result<SurfaceDistances> found = measure_distances(mesh, surface, {voxel_mm / 4, voxel_mm / 20}, ctx);
  if (!found) return found.error();
  for (const auto& [way, summary] : {std::pair{"to_", found->forth}, std::pair{"from_", found->back}})
    row[way + what] = {{"mean", summary.mean_mm / voxel_mm}, {"max", summary.max_mm / voxel_mm}};
  return std::monostate{};
}

}  // namespace

Result<nlohmann::json> measure_fidelity(const std::string& name, const ReferenceFolders& folders,
                                        Session& session) {
  nlohmann::json row;
  if (const Status ran = run_stages(session, row); !ran) return ran.error();
  const Result<Reference> reference = reference_of(name, session, folders);
  if (!reference) return reference.error();
  row["reference"] = reference->digest;
  const TetMesh& mesh = *session.mesh();
  const SurfaceMesh& voxels = reference->voxels;
  row["tets"] = mesh.tets.size();
  row["triangles"] = mesh.faces.size();

  const double voxel_mm = session.volume()->smallest_spacing_mm();
  const TriangleSet boundaries{mesh.points, mesh.faces, mesh.face_sides};
  for (const auto& [what, surface] :
       {std::pair{"smoothed", &reference->smoothed}, std::pair{"voxels", &voxels}})
    if (const Status done = measure_both_ways(
            boundaries, {surface->points, surface->triangles, surface->sides}, voxel_mm, what, row);
        !done)
      return done.error();

  for (const LabelFidelity& label : measure_labels(mesh, *session.selected_volume(), *session.sizing())) {
    row["dice"][std::to_string(label.label)] = label.dice;
    row["volume_percent"][std::to_string(label.label)] = label.volume_error_percent;
  }
  const std::vector<Field> measures = measure_tets(mesh, nullptr, 1);
  std::vector<float> smallest = find_field(measures, "min_dihedral_deg")->values;
  row["dihedral_deg"] = {{"least", quantile(smallest, 0)}, {"p01", quantile(smallest, 0.001)}};
  row["ledger"] = nlohmann::json::array();
  for (const TopologyDifference& difference :
       compare_topology(label_topology(voxels), label_topology({mesh.points, mesh.faces, mesh.face_sides})))
    row["ledger"].push_back(in_words(difference));
  return row;
}

}  // namespace voxtet::sweep
