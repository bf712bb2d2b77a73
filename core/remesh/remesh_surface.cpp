#include "remesh/remesh_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <cstdio>
#include <new>
#include <numeric>
#include <stdexcept>

#include "geometry/cut/cut_faces.h"
#include "geometry/repair/undo_intersections.h"
#include "geometry/topology/compare_topology.h"
#include "geometry/topology/label_topology.h"
#include "remesh/adapt/adapt_complex.h"
#include "remesh/adapt/improve_surface.h"
#include "remesh/delaunay/delaunay_surface.h"
#include "remesh/field/label_field.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

using namespace remesh;

/// Of max_distance_voxels, the distance to which facets are refined around layers. Where facets are as far
/// off as what counts as missed, points are added regardless of sizes: triangles much finer than a layer is
/// thick leave no room for good tetrahedra across it. Measured on shells: 0.8 gives 33 degrees where 1
/// gave 16.
constexpr double kLayerDistance = 0.8;
/// Of the time: of the label field in refinement, and of refinement in both it and improvement.
constexpr double kFieldShare = 0.1, kRefinementShare = 0.8;

Error bad_input(const std::string& message) {
  return {ErrorCode::kBadInput, kRemeshStage, message, {}};
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

Status check_label_surface(const SurfaceMesh& surface, const LabelVolume& volume) {
  if (surface.triangles.empty() || surface.sides.size() != surface.triangles.size())
    return bad_input("label_surface has " + std::to_string(surface.triangles.size()) + " triangles and " +
                     std::to_string(surface.sides.size()) + " sides; expected as many of each, at least 1");
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (const std::uint32_t p : surface.triangles[t])
      if (p >= surface.points.size() || !surface.points[p].allFinite())
        return bad_input("triangle " + std::to_string(t) + " of label_surface names point " +
                         std::to_string(p) + " of " + std::to_string(surface.points.size()) +
                         "; expected one that is there and finite");
  std::array<std::bitset<65536>, 2> labels;
  for (const Label label : volume.labels) labels[0].set(label);
  for (const Sides& sides : surface.sides)
    for (const Label label : sides) labels[1].set(label);
  labels[0] ^= labels[1];
  for (std::size_t label = 1; label < labels[0].size(); ++label)
    if (labels[0][label])
      return bad_input(
          "label " + std::to_string(label) + " is on " +
          (labels[1][label] ? "label_surface and not in the volume" : "no triangle of label_surface") +
          "; expected the surface of all labels of the volume");
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
  if (!(params.shape_weight >= 0 && params.shape_weight <= 1))
    return bad_input("shape_weight is " + number(params.shape_weight) + "; expected 0 to 1");
  return std::monostate{};
}

void warn_about_sizes(const SurfaceMesh& surface, const SizingField& sizing, RunContext& ctx) {
  constexpr double kMuchSmaller = 0.5, kWorthSaying = 0.1;
  std::size_t smaller = 0;
  for (const Triangle& t : surface.triangles) {
    const Eigen::Vector3d &a = surface.points[t[0]], &b = surface.points[t[1]], &c = surface.points[t[2]];
    const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    const double target = kMuchSmaller * sizing.at((a + b + c) / 3);
    if (longest < target * target) ++smaller;
  }
  const double share = static_cast<double>(smaller) / static_cast<double>(surface.triangles.size());
  if (share > kWorthSaying)
    ctx.warn(
        kRemeshStage,
        number(std::round(100 * share)) +
            " % of the triangles are less than half as large as the target, because max_distance_voxels or "
            "narrow places demand it");
}

/// Why a surface is not good enough to be kept instead of one with the reference's exact topology; empty if
/// it is.
std::string broken_topology(const TopologyLedger& wanted, const TopologyLedger& found, KeepTopology keep) {
  if (keep == KeepTopology::kNothing || wanted == found) return {};
  std::string lost, pinched;
  const auto name = [](std::string& list, Label label) {
    list += (list.empty() ? "" : ", ") + std::to_string(label);
  };
  for (const LabelTopology& label : wanted.labels) {
    const auto same = std::find_if(found.labels.begin(), found.labels.end(),
                                   [&](const LabelTopology& other) { return other.label == label.label; });
    if (same == found.labels.end())
      name(lost, label.label);
    else if (same->pinched_edges + same->pinched_points > label.pinched_edges + label.pinched_points)
      name(pinched, label.label);
  }
  if (!lost.empty()) return "lost label " + lost;
  if (!pinched.empty()) return "left the boundary touching itself of label " + pinched;
  if (keep != KeepTopology::kAll) return {};
  constexpr std::size_t kNamed = 3;
  const std::vector<TopologyDifference> differences = compare_topology(wanted, found);
  std::string changed = "changed the topology of labels: ";
  for (std::size_t i = 0; i < std::min(kNamed, differences.size()); ++i)
    changed += (i ? ", " : "") + in_words(differences[i]);
  if (differences.size() > kNamed) changed += " and " + std::to_string(differences.size() - kNamed) + " more";
  return changed;
}

AdaptParams adapt_params(const LabelVolume& volume, const RemeshParams& params) {
  AdaptParams adapt;
  adapt.schedule = params.schedule;
  adapt.voxel_mm = volume.spacing_mm().minCoeff();
  adapt.shape_weight = params.shape_weight;
  adapt.verify = params.verify;
  return adapt;
}

void report_verified(const AdaptRecord& record, RunContext& ctx) {
  const std::string found =
      "intersections found after " +
      std::to_string(std::accumulate(record.accepted.begin(), record.accepted.end(), std::uint64_t{0})) +
      " verified operations: " + std::to_string(record.violations);
  if (record.violations > 0)
    ctx.warn(kRemeshStage, found);
  else
    ctx.note(kRemeshStage, found);
}

Result<SurfaceMesh> adapt(const LabelVolume& volume, const SurfaceMesh& reference, const SizingField& sizing,
                          const RemeshParams& params, RunContext& ctx) {
  ctx.note(kRemeshStage, "method adapt");
  AdaptRecord record;
  Result<SurfaceMesh> surface = adapt_complex(reference, sizing, adapt_params(volume, params), ctx, &record);
  if (surface && params.verify) report_verified(record, ctx);
  return surface;
}

/// The refined surface with its poor places mended.
Result<SurfaceMesh> improve(const SurfaceMesh& surface, const LabelVolume& volume,
                            const SurfaceMesh& reference, const SizingField& sizing,
                            const RemeshParams& params, RunContext& ctx) {
  constexpr double kAngleShare = 0.975, kDistanceShare = 0.9;  // of what refinement aims at
  constexpr double kLeastDihedralDeg = 30;                     // what refined surfaces have nearly everywhere
  AdaptParams adapt = adapt_params(volume, params);
  adapt.min_angle_deg = kAngleShare * params.facet_angle_deg;
  adapt.min_dihedral_deg = kLeastDihedralDeg;
  adapt.envelope_voxels = kDistanceShare * params.max_distance_voxels;
  AdaptRecord record;
  Result<SurfaceMesh> improved = improve_surface(surface, reference, sizing, adapt, ctx, &record);
  if (improved && params.verify) report_verified(record, ctx);
  return improved;
}

/// False when cancelled.
bool flatten(SurfaceMesh& surface, const CutPlanes& cuts, RunContext& ctx) {
  if (cuts.empty()) return true;
  const std::vector<Eigen::Vector3d> before = surface.points;
  flatten_cuts(surface, cuts);
  return !undo_intersections(surface, before, ctx).cancelled;
}

/// The label field goes with the end of refinement: what comes after needs its memory.
Result<SurfaceMesh> refine(const LabelVolume& volume, const SurfaceMesh& reference,
                           const TopologyLedger& wanted, const SizingField& sizing,
                           const RemeshParams& params, RunContext& ctx, const WallLayers& layers,
                           const CutPlanes& cuts) {
  const LabelField field(volume, reference, layers, ctx.threads);
  if (ctx.cancelled()) return cancelled_error(kRemeshStage);
  RunContext refinement = ctx.part(kFieldShare, 1);
  DelaunayParams aims{params.facet_angle_deg, params.max_distance_voxels};
  if (!layers.empty()) {
    aims.missed_voxels = aims.max_distance_voxels;
    aims.max_distance_voxels *= kLayerDistance;
  }
  return delaunay_surface(field, reference, wanted, sizing, aims, refinement, cuts);
}

Result<SurfaceMesh> by_method(const LabelVolume& volume, const SurfaceMesh& reference,
                              const SizingField& sizing, const RemeshParams& params, RunContext& ctx,
                              const WallLayers& layers, const CutPlanes& cuts) {
  ctx.progress(kRemeshStage, 0);
  if (params.method == RemeshMethod::kAdapt) return adapt(volume, reference, sizing, params, ctx);
  const TopologyLedger wanted = topology_before(cuts, label_topology(reference));
  if (ctx.cancelled()) return cancelled_error(kRemeshStage);
  RunContext first = ctx.part(0, kRefinementShare), then = ctx.part(kRefinementShare, 1);
  Result<SurfaceMesh> surface = refine(volume, reference, wanted, sizing, params, first, layers, cuts);
  if (!surface) return surface;
  if (!flatten(*surface, cuts, ctx)) return cancelled_error(kRemeshStage);
  const TopologyLedger found = topology_before(cuts, label_topology(merge_layers(*surface, layers)));
  if (ctx.cancelled()) return cancelled_error(kRemeshStage);
  const std::string broken = broken_topology(wanted, found, params.keep_topology);
  if (broken.empty()) {
    ctx.note(kRemeshStage, "method delaunay");
    for (const TopologyDifference& difference : compare_topology(wanted, found))
      ctx.warn(kRemeshStage, in_words(difference));
    // Sheets between layers are not on the reference: nothing there could be moved.
    if (!layers.empty()) return surface;
    return improve(*surface, volume, reference, sizing, params, then);
  }
  ctx.warn(kRemeshStage, "the method delaunay " + broken + ": the method adapt was taken instead" +
                             (layers.empty() ? "" : ", which lays no sheets between layers"));
  return adapt(volume, reference, sizing, params, then);
}

}  // namespace

Result<SurfaceMesh> remesh_surface(const LabelVolume& volume, const SurfaceMesh& reference,
                                   const SizingField& sizing, const RemeshParams& params, RunContext& ctx,
                                   const WallLayers& layers, const CutPlanes& cuts) {
  if (Status status = check_volume(volume); !status) return status.error();
  if (Status status = check_label_surface(reference, volume); !status) return status.error();
  if (Status status = check_parameters(sizing, params); !status) return status.error();
  if (!layers.empty() && params.method != RemeshMethod::kDelaunay)
    return Error{ErrorCode::kUsage,
                 kRemeshStage,
                 "remesh.method: found adapt, expected delaunay, which alone lays the sheets between exact "
                 "layers",
                 {}};
  try {
    RunContext rising = ctx.part(0, 1);
    Result<SurfaceMesh> surface = by_method(volume, reference, sizing, params, rising, layers, cuts);
    if (surface) {
      if (!flatten(*surface, cuts, ctx)) return cancelled_error(kRemeshStage);
      warn_about_sizes(*surface, sizing, ctx);
      ctx.progress(kRemeshStage, 1);
    }
    return surface;
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory,
                 kRemeshStage,
                 "not enough memory to refine the surface to the target size",
                 {}};
  } catch (const std::exception& e) {
    return Error{
        ErrorCode::kInternal, kRemeshStage, std::string("the triangulation failed: ") + e.what(), {}};
  }
}

}  // namespace voxtet
