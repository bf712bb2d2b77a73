#include "remesh/remesh_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <new>
#include <stdexcept>

#include <chrono>
#include "remesh/drop_fragments.h"
#include "remesh/extract_interface.h"
#include "remesh/fit_surface.h"
#include "remesh/interface_edges.h"
#include "remesh/label_field.h"
#include "remesh/mend_pinches.h"
#include "remesh/missed_places.h"
#include "remesh/refine_delaunay.h"
#include "remesh/relabel_cells.h"
#include "remesh/seed_interfaces.h"
#include "remesh/topology_ledger.h"

namespace voxtet {
namespace {

using namespace remesh;

const char* const kStage = "remesh";
/// Measured on hearts, aorta and spheres: the median edge of a refined surface is 1.30 times the largest
/// radius allowed for the surface Delaunay balls.
constexpr double kEdgePerRadius = 1.30;
constexpr int kRepairRounds = 3;
constexpr double kLeastPinchVoxels = 0.3;
constexpr double kMissedVoxels = 0.45;
constexpr double kSeparation = 0.5, kSeedSeparation = 0.25;
void pinch(const char* w, const CellComplex& c) {
  auto e = find_interface_edges(c);
  printf("   %s: edges %zu points %zu\n", w, find_pinched_edges(c, e).size(),
         find_pinched_points(c, e).size());
}
double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Error bad_input(const std::string& message) {
  return {ErrorCode::kBadInput, kStage, message, {}};
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

Status check_volume(const LabelVolume& volume) {
  for (const int n : volume.size)
    if (n < 1)
      return bad_input("volume.size holds " + std::to_string(n) + "; expected at least 1 voxel an axis");
  if (volume.labels.size() != volume.voxel_count())
    return bad_input("volume.labels holds " + std::to_string(volume.labels.size()) + " values; expected " +
                     std::to_string(volume.voxel_count()));
  constexpr std::size_t kMostVoxels = std::size_t{1} << 30;
  if (volume.voxel_count() > kMostVoxels)
    return bad_input("volume has " + std::to_string(volume.voxel_count()) +
                     " voxels; at most 2^30 are supported");
  const double voxel = volume.voxel_mm3(), box = volume.spacing_mm().prod();
  if (!volume.index_to_mm.allFinite() || !(voxel > 1e-6 * box))
    return bad_input("volume.index_to_mm is singular or not finite");
  if (std::all_of(volume.labels.begin(), volume.labels.end(), [](Label l) { return l == kBackground; }))
    return bad_input("volume has no voxel with a label other than 0: there is nothing to mesh");
  return std::monostate{};
}

Status check_parameters(const SizingField& sizing, const RemeshParams& params) {
  const std::size_t count = static_cast<std::size_t>(std::max(0, sizing.size[0])) *
                            static_cast<std::size_t>(std::max(0, sizing.size[1])) *
                            static_cast<std::size_t>(std::max(0, sizing.size[2]));
  if (count == 0 || sizing.h_mm.size() != count)
    return bad_input("sizing.h_mm holds " + std::to_string(sizing.h_mm.size()) + " values; expected " +
                     std::to_string(count) + ", at least 1");
  for (const float h : sizing.h_mm)
    if (!(h > 0) || !std::isfinite(h))
      return bad_input("sizing.h_mm holds " + number(h) + "; expected h > 0");
  if (!(params.facet_angle_deg >= 0 && params.facet_angle_deg <= 30))
    return bad_input("facet_angle_deg is " + number(params.facet_angle_deg) +
                     "; expected 0 to 30, beyond which refinement need not end");
  if (!(params.max_distance_voxels >= 0.01))
    return bad_input("max_distance_voxels is " + number(params.max_distance_voxels) +
                     "; expected at least 0.01");
  return std::monostate{};
}

struct Outcome {
  CellComplex cells;
  SurfaceMesh surface;
  bool cancelled = false;
};

Outcome refine_until_followed(const LabelField& field, const SurfaceMesh& reference,
                              const SizingField& sizing, const RemeshParams& params, const Seeds& seeds,
                              RunContext& ctx) {
  const double voxel = field.smallest_spacing_mm();
  RefineCriteria criteria;
  criteria.facet_angle_deg = params.facet_angle_deg;
  criteria.max_distance_mm = params.max_distance_voxels * voxel;
  criteria.radius_per_edge = 1 / kEdgePerRadius;
  DelaunayRefiner refiner(field, sizing, criteria);
  Outcome out;
  refiner.insert(seeds.points, kSeedSeparation * voxel);
  for (int round = 0;; ++round) {
    out.cancelled =
        !refiner.refine(ctx, std::max(seeds.predicted_vertices, static_cast<double>(refiner.vertex_count())));
    if (out.cancelled) return out;
    double T0 = now();
    out.cells = refiner.cells();
    double T1 = now();
    auto nf = drop_fragments(out.cells, field);
    pinch("refined", out.cells);
    relabel_cells(out.cells);
    pinch("relabelled", out.cells);
    double T2 = now();
    auto nm = mend_pinches(out.cells, field);
    double T3 = now();
    pinch("mended", out.cells);
    auto nf2 = drop_fragments(out.cells, field);
    printf("  fragments %zu %zu\n", nf, nf2);
    out.surface = extract_interface(out.cells);
    fit_surface(out.surface, field);
    double T4 = now();
    const std::vector<Eigen::Vector3d> missed =
        missed_places(reference, out.surface, field, kMissedVoxels * voxel, kSeparation * voxel);
    double T5 = now();
    printf(
        "  round %d: vertices %zu missed %zu mended %zu  t cells %.3f relabel %.3f mend %.3f fit %.3f missed "
        "%.3f\n",
        round, refiner.vertex_count(), missed.size(), nm, T1 - T0, T2 - T1, T3 - T2, T4 - T3, T5 - T4);
    if (round == kRepairRounds) return out;
    std::size_t added = refiner.insert(missed, kSeparation * voxel);
    for (const InterfaceFacet& facet : facets_at_pinches(out.cells))
      added += refiner.request(facet.cell, facet.corner, kLeastPinchVoxels * voxel);
    if (added == 0) return out;
  }
}

/// An error if a label of the field has no cell; its `where` holds voxel centres of the lost labels.
Status check_labels(const LabelField& field, const CellComplex& cells) {
  std::vector<std::uint8_t> meshed(65536, 0);
  for (const Label label : cells.labels) meshed[label] = 1;
  Error error{ErrorCode::kMeshing, kStage, "", {}};
  std::size_t voxel = 0;
  for (int k = 0; k < field.size()[2]; ++k)
    for (int j = 0; j < field.size()[1]; ++j)
      for (int i = 0; i < field.size()[0]; ++i, ++voxel) {
        const Label label = field.centre_labels()[voxel];
        if (meshed[label]) continue;
        meshed[label] = 1;
        error.message += (error.message.empty() ? "label " : ", ") + std::to_string(label);
        error.where.points.push_back(field.to_mm(Eigen::Vector3d(i, j, k)));
      }
  if (error.message.empty()) return std::monostate{};
  error.message +=
      ": in the volume, but lost in the surface; expected every label to have a boundary. "
      "A smaller edge length there may keep it";
  return error;
}

void warn_about_topology(const Seeds& seeds, const Outcome& outcome, RunContext& ctx) {
  std::vector<std::uint32_t> expected(65536, 0);
  for (const Label label : seeds.component_labels) ++expected[label];
  const std::vector<std::uint32_t> found = count_components(outcome.cells);
  std::string differing;
  for (std::size_t label = 0; label < expected.size(); ++label)
    if (expected[label] != found[label])
      differing += (differing.empty() ? "" : "; ") + std::string("label ") + std::to_string(label) + ": " +
                   std::to_string(expected[label]) + " in the volume, " + std::to_string(found[label]) +
                   " in the surface";
  if (!differing.empty()) ctx.warn(kStage, "connected components differ: " + differing);
  const InterfaceEdges edges = find_interface_edges(outcome.cells);
  const std::size_t pinched_edges = find_pinched_edges(outcome.cells, edges).size();
  const std::size_t pinched_points = find_pinched_points(outcome.cells, edges).size();
  if (pinched_edges + pinched_points > 0)
    ctx.warn(kStage, "the boundary of a label touches itself at " + std::to_string(pinched_edges) +
                         " edges and " + std::to_string(pinched_points) + " points");
}

void warn_about_sizes(const SurfaceMesh& surface, const SizingField& sizing, RunContext& ctx) {
  constexpr double kMuchSmaller = 0.5, kWorthSaying = 0.1;
  std::size_t smaller = 0;
  for (const Triangle& t : surface.triangles) {
    const Eigen::Vector3d &a = surface.points[t[0]], &b = surface.points[t[1]], &c = surface.points[t[2]];
    const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    const double wished = kMuchSmaller * sizing.at((a + b + c) / 3);
    if (longest < wished * wished) ++smaller;
  }
  const double share = static_cast<double>(smaller) / static_cast<double>(surface.triangles.size());
  if (share > kWorthSaying)
    ctx.warn(kStage,
             number(std::round(100 * share)) +
                 " % of the triangles are less than half as large as wished, because max_distance_voxels or "
                 "narrow places demand it");
}

/// The caller's context, with progress that never falls: repeated refinements start their own count again.
RunContext with_rising_progress(const RunContext& ctx) {
  RunContext rising = ctx;
  if (ctx.on_progress)
    rising.on_progress = [report = ctx.on_progress, highest = 0.0](const std::string& stage,
                                                                   double fraction) mutable {
      highest = std::max(highest, fraction);
      report(stage, highest);
    };
  return rising;
}

Result<SurfaceMesh> remesh_delaunay(const LabelVolume& volume, const SurfaceMesh& reference,
                                    const SizingField& sizing, const RemeshParams& params, RunContext& ctx) {
  ctx.progress(kStage, 0);
  const LabelField field(volume, reference);
  if (ctx.cancelled()) return cancelled_error(kStage);
  ctx.progress(kStage, 0.08);
  double T0 = now();
  const Seeds seeds = seed_interfaces(field, sizing, {});
  printf("  seeds %zu %.3f s\n", seeds.points.size(), now() - T0);
  if (ctx.cancelled()) return cancelled_error(kStage);
  Outcome outcome = refine_until_followed(field, reference, sizing, params, seeds, ctx);
  if (outcome.cancelled) return cancelled_error(kStage);
  if (Status labels = check_labels(field, outcome.cells); !labels) return labels.error();
  SurfaceMesh surface = std::move(outcome.surface);
  warn_about_topology(seeds, outcome, ctx);
  warn_about_sizes(surface, sizing, ctx);
  ctx.progress(kStage, 1);
  return surface;
}

}  // namespace

Result<SurfaceMesh> remesh_surface(const LabelVolume& volume, const SurfaceMesh& reference,
                                   const SizingField& sizing, const RemeshParams& params, RunContext& ctx) {
  if (Status status = check_volume(volume); !status) return status.error();
  if (Status status = check_parameters(sizing, params); !status) return status.error();
  try {
    RunContext rising = with_rising_progress(ctx);
    return remesh_delaunay(volume, reference, sizing, params, rising);
  } catch (const std::bad_alloc&) {
    return Error{
        ErrorCode::kOutOfMemory, kStage, "not enough memory to refine the surface to the wished size", {}};
  } catch (const std::exception& e) {
    return Error{ErrorCode::kInternal, kStage, std::string("the triangulation failed: ") + e.what(), {}};
  }
}

}  // namespace voxtet
