#include "quality/measure_quality.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "geometry/elements/tet_measures.h"
#include "geometry/elements/triangle_measures.h"
#include "geometry/topology/adjacency.h"
#include "geometry/topology/compare_topology.h"
#include "geometry/topology/label_topology.h"
#include "quality/checklist.h"
#include "quality/fidelity.h"
#include "quality/summarise.h"
#include "quality/surface_distance.h"
#include "quality/tet_measure_table.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

using Worst = MetricInfo::Worst;

/// Of the largest distance, in units of the smallest voxel spacing.
constexpr double kDistanceToleranceVoxels = 0.05;

Status check_params(const QualityParams& params) {
  if (params.histogram_bins < 1 || !(params.sample_spacing_voxels > 0))
    return Error{ErrorCode::kUsage,
                 kQualityStage,
                 "quality: found histogram_bins " + std::to_string(params.histogram_bins) +
                     " and sample_spacing_voxels " + std::to_string(params.sample_spacing_voxels) +
                     ", expected both above 0",
                 {}};
  return std::monostate{};
}

Status check_mesh_arrays(const TetMesh& mesh) {
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t)
    for (const std::uint32_t v : mesh.tets[t])
      if (v >= mesh.points.size())
        return Error{ErrorCode::kBadInput,
                     kQualityStage,
                     "tetrahedron " + std::to_string(t) + " refers to point " + std::to_string(v) + " of " +
                         std::to_string(mesh.points.size()),
                     {{}, {t}}};
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
    for (const std::uint32_t v : mesh.faces[f])
      if (v >= mesh.points.size())
        return Error{ErrorCode::kBadInput,
                     kQualityStage,
                     "face " + std::to_string(f) + " refers to point " + std::to_string(v) + " of " +
                         std::to_string(mesh.points.size()),
                     {}};
  if (mesh.face_sides.size() != mesh.faces.size())
    return Error{ErrorCode::kBadInput,
                 kQualityStage,
                 "found " + std::to_string(mesh.faces.size()) + " faces and " +
                     std::to_string(mesh.face_sides.size()) +
                     " pairs of sides, expected one pair for each face",
                 {}};
  if (mesh.tets.empty() || mesh.labels.size() != mesh.tets.size())
    return Error{ErrorCode::kBadInput,
                 kQualityStage,
                 "found " + std::to_string(mesh.tets.size()) + " tetrahedra and " +
                     std::to_string(mesh.labels.size()) +
                     " labels, expected one label for each of at least one tetrahedron",
                 {}};
  return std::monostate{};
}

/// Upper end of a histogram of lengths: the largest value, rounded up to two digits.
double nice_upper(const std::vector<float>& values) {
  const double largest = values.empty() ? 1 : *std::max_element(values.begin(), values.end());
  if (!(largest > 0) || !std::isfinite(largest)) return 1;
  const double unit = std::pow(10, std::floor(std::log10(largest)) - 1);
  return std::ceil(largest / unit) * unit;
}

std::vector<MetricSummary> edge_metrics(const TetMesh& mesh, const SizingField* sizing, int bins) {
  std::vector<float> lengths, targets, ratios;
  for (const auto& [a, b] : tet_edges(mesh.tets, mesh.points.size())) {
    const double length = (mesh.points[b] - mesh.points[a]).norm();
    lengths.push_back(static_cast<float>(length));
    if (!sizing) continue;
    const double target = sizing->at((mesh.points[a] + mesh.points[b]) / 2);
    targets.push_back(static_cast<float>(target));
    ratios.push_back(static_cast<float>(std::log2(length / target)));
  }
  const double upper = std::max(nice_upper(lengths), targets.empty() ? 0 : nice_upper(targets));
  std::vector<MetricSummary> out{
      summarise({"edge_mm", "mm", "edges", 0, upper, Worst::kNone}, lengths, bins)};
  if (!sizing) return out;
  out.push_back(summarise({"target_edge_mm", "mm", "edges", 0, upper, Worst::kNone}, targets, bins));
  out.push_back(summarise({"size_log2", "log2", "edges", -2, 2, Worst::kNone}, ratios, bins));
  return out;
}

/// Of the triangles before and after they were adapted.
std::vector<MetricSummary> triangle_metrics(const SurfaceMesh& before, const SurfaceMesh& after, int bins) {
  std::vector<float> aspect_before, aspect_after, angles_after;
  for (const auto& [a, b, c] : before.triangles)
    aspect_before.push_back(static_cast<float>(
        measure_triangle({before.points[a], before.points[b], before.points[c]}).aspect_ratio));
  for (const auto& [a, b, c] : after.triangles) {
    const TriangleShape shape = measure_triangle({after.points[a], after.points[b], after.points[c]});
    aspect_after.push_back(static_cast<float>(shape.aspect_ratio));
    angles_after.push_back(static_cast<float>(shape.min_angle_deg));
  }
  return {
      summarise({"triangle_aspect_before", "1", "triangles", 1, 6, Worst::kHighest}, aspect_before, bins),
      summarise({"triangle_aspect_after", "1", "triangles", 1, 6, Worst::kHighest}, aspect_after, bins),
      summarise({"triangle_min_angle_deg", "deg", "triangles", 0, 60, Worst::kLowest}, angles_after, bins)};
}

/// Distances of points from the label surface: in mm and in units of the voxel's smallest spacing.
std::vector<Field> distance_fields(std::vector<float> mm, double voxel_mm) {
  std::vector<float> voxels(mm.size());
  for (std::size_t i = 0; i < mm.size(); ++i) voxels[i] = mm[i] / static_cast<float>(voxel_mm);
  return {{"distance_mm", "Distance to the label surface", "mm", On::kPoints, Scale::kSequential, 1,
           std::move(mm)},
          {"distance_voxels", "Distance to the label surface", "voxels", On::kPoints, Scale::kSequential, 1,
           std::move(voxels)}};
}

bool has_places(const TetMesh& mesh) {
  return std::all_of(mesh.points.begin(), mesh.points.end(),
                     [](const Eigen::Vector3d& p) { return p.allFinite(); });
}

using Tasks = std::vector<std::function<void()>>;

/// The part of the report that needs the mesh alone, its ledger included. `others` are run along with it,
/// unless a point has no place.
Result<QualityReport> report_of_mesh(const TetMesh& mesh, const std::vector<TetFace>& faces,
                                     const SizingField* sizing, int bins, const RunContext& ctx,
                                     Tasks others = {}) {
  QualityReport report;
  TopologyLedger& ledger = report.topology.after;
  const auto find_ledger = [&] { ledger = label_topology(label_boundary(mesh, faces)); };
  if (!has_places(mesh)) {
    find_ledger();
    report.checklist = check_mesh_alone(mesh, faces, ledger, std::numeric_limits<double>::quiet_NaN());
    return report;
  }
  std::vector<float> all_angles;
  report.fields = measure_tets(mesh, sizing, ctx.threads, &all_angles);
  std::vector<std::pair<MetricInfo, const std::vector<float>*>> of_tets;
  for (const TetMeasure& row : tet_measures())
    if (row.lo < row.hi)
      of_tets.push_back({{row.name, row.unit, "tets", row.lo, row.hi, row.worst, row.title},
                         &find_field(report.fields, row.name)->values});
  of_tets.push_back({{"dihedral_deg", "deg", "tets", 0, 180, Worst::kNone}, &all_angles});
  report.metrics.resize(of_tets.size());
  std::vector<MetricSummary> of_edges;
  Tasks tasks = std::move(others);
  tasks.emplace_back([&] { of_edges = edge_metrics(mesh, sizing, bins); });
  tasks.emplace_back(find_ledger);
  for (std::size_t i = 0; i < of_tets.size(); ++i)
    tasks.emplace_back([&, i] { report.metrics[i] = summarise(of_tets[i].first, *of_tets[i].second, bins); });
  std::atomic<bool> cancelled = false;
  for (std::function<void()>& task : tasks)
    task = [&cancelled, &ctx, own = std::move(task)] {
      if (ctx.cancelled()) cancelled = true;
      if (!cancelled) own();
    };
  run_tasks(ctx.threads, tasks);
  if (cancelled) return cancelled_error(kQualityStage);
  std::move(of_edges.begin(), of_edges.end(), std::back_inserter(report.metrics));
  report.checklist = check_mesh_alone(mesh, faces, ledger, report.metrics.front().min);
  return report;
}

}  // namespace

Result<QualityReport> measure_mesh(const TetMesh& mesh, const QualityParams& params, RunContext& ctx) {
  if (Status valid = check_params(params); !valid) return valid.error();
  if (Status valid = check_mesh_arrays(mesh); !valid) return valid.error();
  if (ctx.cancelled()) return cancelled_error(kQualityStage);
  return report_of_mesh(mesh, tet_faces(mesh.tets, mesh.points.size()), nullptr, params.histogram_bins, ctx);
}

Result<QualityReport> measure_quality(const TetMesh& mesh, const QualityReference& reference,
                                      const QualityParams& params, RunContext& ctx) {
  if (Status valid = check_params(params); !valid) return valid.error();
  if (Status valid = check_mesh_arrays(mesh); !valid) return valid.error();
  const int bins = params.histogram_bins;
  const std::vector<TetFace> faces = tet_faces(mesh.tets, mesh.points.size());
  if (!has_places(mesh)) return report_of_mesh(mesh, faces, &reference.sizing, bins, ctx);
  ctx.progress(kQualityStage, 0.1);
  if (ctx.cancelled()) return cancelled_error(kQualityStage);
  const double voxel = reference.volume.smallest_spacing_mm();
  const SurfaceMesh& surface = reference.label_surface;
  DistanceMeasurement distances(
      {mesh.points, mesh.faces, mesh.face_sides}, {surface.points, surface.triangles, surface.sides},
      {params.sample_spacing_voxels * voxel, kDistanceToleranceVoxels * voxel}, ctx);
  ctx.progress(kQualityStage, 0.2);
  if (ctx.cancelled()) return cancelled_error(kQualityStage);
  std::vector<MetricSummary> of_triangles;
  std::vector<LabelFidelity> labels;
  TopologyLedger before;
  FoundLayers layers;
  Result<QualityReport> of_mesh = report_of_mesh(
      mesh, faces, &reference.sizing, bins, ctx,
      {[&] { distances.measure(0); }, [&] { distances.measure(1); },
       [&] { labels = measure_labels(mesh, reference.labels, reference.sizing, reference.more_mm3); },
       [&] { layers = count_layers(mesh, reference.walls); }, [&] { before = label_topology(surface); },
       [&] { of_triangles = triangle_metrics(surface, reference.adapted, bins); }});
  if (!of_mesh) return of_mesh.error();
  QualityReport report = std::move(of_mesh).value();
  const Result<SurfaceDistances> measured = distances.result();
  if (!measured) return measured.error();
  report.mesh_to_surface = measured->forth;
  report.surface_to_mesh = measured->back;
  std::move(of_triangles.begin(), of_triangles.end(), std::back_inserter(report.metrics));
  report.labels = std::move(labels);
  report.layers = std::move(layers.counts);
  std::move(layers.fields.begin(), layers.fields.end(), std::back_inserter(report.fields));
  std::vector<Field> of_points = distance_fields(distances.of_points(), voxel);
  std::move(of_points.begin(), of_points.end(), std::back_inserter(report.fields));
  TopologyComparison& topology = report.topology;
  topology.before = std::move(before);
  topology.differences = compare_topology(topology.before, topology.after);
  for (ChecklistItem& item :
       check_against_labels(mesh, faces, reference.volume, report.labels, topology.differences, ctx))
    report.checklist.push_back(std::move(item));
  for (ChecklistItem& item : check_exact_layers(report.layers)) report.checklist.push_back(std::move(item));
  return report;
}

}  // namespace voxtet
