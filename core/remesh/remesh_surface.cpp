#include "remesh/remesh_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <new>
#include <stdexcept>

#include "remesh/extract_interface.h"
#include "remesh/interface_edges.h"
#include "remesh/label_field.h"
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
constexpr int kSeedTries = 4;  ///< each with seeds twice as dense where a component got lost
constexpr int kPinchRounds = 12;
constexpr double kLeastPinchVoxels = 0.15;  ///< radius below which a facet is not refined to open a pinch

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
  std::vector<std::uint32_t> lost;  ///< components without a cell
  bool cancelled = false;
};

double facet_area2(const CellComplex& cells, const InterfaceFacet& facet) {
  const auto point = [&](std::size_t c) {
    return cells.points[cells.vertices[facet.cell][static_cast<std::size_t>(kFacetCorners[facet.corner][c])]];
  };
  return (point(1) - point(0)).cross(point(2) - point(0)).squaredNorm();
}

/// The largest facet at each edge and point where the boundary of a label touches itself.
std::vector<InterfaceFacet> facets_at_pinches(const CellComplex& cells) {
  const InterfaceEdges edges = find_interface_edges(cells);
  constexpr std::uint32_t kNone = CellComplex::kNone;
  std::vector<InterfaceFacet> out;
  for (const std::uint32_t edge : find_pinched_edges(cells, edges)) {
    std::uint32_t largest = edges.facet_of[edges.start[edge]];
    for (std::uint32_t k = edges.start[edge]; k < edges.start[edge + 1]; ++k)
      if (facet_area2(cells, edges.facets[edges.facet_of[k]]) > facet_area2(cells, edges.facets[largest]))
        largest = edges.facet_of[k];
    out.push_back(edges.facets[largest]);
  }
  const std::vector<std::uint32_t> points = find_pinched_points(cells, edges);
  if (points.empty()) return out;
  std::vector<std::uint32_t> slot(cells.points.size(), kNone), largest(points.size(), kNone);
  for (std::uint32_t i = 0; i < points.size(); ++i) slot[points[i]] = i;
  for (std::uint32_t f = 0; f < edges.facets.size(); ++f)
    for (const int k : kFacetCorners[edges.facets[f].corner]) {
      const std::uint32_t i = slot[cells.vertices[edges.facets[f].cell][static_cast<std::size_t>(k)]];
      if (i == kNone) continue;
      if (largest[i] == kNone ||
          facet_area2(cells, edges.facets[f]) > facet_area2(cells, edges.facets[largest[i]]))
        largest[i] = f;
    }
  for (const std::uint32_t f : largest) out.push_back(edges.facets[f]);
  return out;
}

/// Refines where a label's boundary touches itself, as long as the facets there are not tiny. False when
/// cancelled.
bool open_pinches(DelaunayRefiner& refiner, CellComplex& cells, double least_mm, RunContext& ctx) {
  for (int round = 0; round < kPinchRounds; ++round) {
    bool requested = false;
    for (const InterfaceFacet& facet : facets_at_pinches(cells))
      requested = refiner.request(facet.cell, facet.corner, least_mm) || requested;
    if (!requested) return true;
    if (!refiner.refine(ctx, static_cast<double>(refiner.vertex_count()))) return false;
    cells = refiner.cells();
  }
  return true;
}

Outcome refine_from_seeds(const LabelField& field, const SizingField& sizing, const RemeshParams& params,
                          const Seeds& seeds, RunContext& ctx) {
  RefineCriteria criteria;
  criteria.facet_angle_deg = params.facet_angle_deg;
  criteria.max_distance_mm = params.max_distance_voxels * field.smallest_spacing_mm();
  criteria.radius_per_edge = 1 / kEdgePerRadius;
  DelaunayRefiner refiner(field, sizing, criteria);
  Outcome out;
  const std::vector<std::uint32_t> seed_points = refiner.insert(seeds.points);
  out.cancelled = !refiner.refine(ctx, seeds.predicted_vertices);
  if (out.cancelled) return out;
  out.cells = refiner.cells();
  out.cancelled = !open_pinches(refiner, out.cells, kLeastPinchVoxels * field.smallest_spacing_mm(), ctx);
  if (out.cancelled) return out;
  relabel_cells(out.cells);
  out.lost = lost_components(out.cells, seeds, seed_points);
  return out;
}

/// The lost components that must not be: those that are no specks, and all of a label of which nothing is
/// left.
std::vector<std::uint32_t> missed_components(const Seeds& seeds, const std::vector<std::uint32_t>& lost) {
  (void)seeds;
  return lost;
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
  if (!outcome.lost.empty())
    ctx.warn(kStage,
             std::to_string(outcome.lost.size()) + " components of the labels are not in the surface");
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
  Outcome outcome;
  Seeds seeds;
  std::vector<std::uint8_t> denser;  // per component, how often its seeds have been made denser
  for (int attempt = 0; attempt < kSeedTries; ++attempt) {
    seeds = seed_interfaces(field, sizing, denser);
    if (ctx.cancelled()) return cancelled_error(kStage);
    outcome = refine_from_seeds(field, sizing, params, seeds, ctx);
    if (outcome.cancelled) return cancelled_error(kStage);
    denser.resize(seeds.component_labels.size(), 0);
    const std::vector<std::uint32_t> missed = missed_components(seeds, outcome.lost);
    if (missed.empty()) break;
    for (const std::uint32_t component : missed) ++denser[component];
  }
  if (Status labels = check_labels(field, outcome.cells); !labels) return labels.error();
  SurfaceMesh surface = extract_interface(outcome.cells);
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
