#include "surface/smooth/smooth_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <new>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "geometry/cut/cut_faces.h"
#include "geometry/elements/surface_measures.h"
#include "geometry/repair/undo_intersections.h"
#include "surface/smooth/bilaplacian.h"
#include "surface/smooth/crossing_limits.h"
#include "surface/smooth/join_diagonals.h"
#include "surface/smooth/move_limits.h"
#include "surface/smooth/shape_guard.h"
#include "surface/smooth/surface_graph.h"
#include "surface/smooth/volume_correction.h"
#include "surface/smooth/voxel_regions.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr int kCorrectionPasses = 2;
constexpr int kStepsBetweenGuards = 34;
constexpr double kThickVoxels = 4;
constexpr double kSmoothingShare = 0.8;  ///< of the progress

/// How many steps are taken.
struct SmoothSteps {
  int all, of_thin;
};

/// What is thin takes a third: with more, wires would wither, and the facets of thin walls would leave many
/// voxels' centres outside. Surfaces of several labels, whose edges are half as long, take a third more.
SmoothSteps steps_of(int iterations, bool is_one_label) {
  const int third = (iterations + 2) / 3;
  return {is_one_label ? iterations : iterations + third, third};
}

Error failure(ErrorCode code, const std::string& message) {
  return {code, kSmoothStage, message, {}};
}

Status check_input(const SurfaceMesh& surface, const LabelVolume& volume, const SmoothParams& params) {
  if (params.iterations < 0)
    return failure(ErrorCode::kUsage,
                   "iterations is " + std::to_string(params.iterations) + ", expected 0 or more");
  if (!(params.step > 0 && params.step < 0.5))
    return failure(ErrorCode::kUsage,
                   "step is " + std::to_string(params.step) + ", expected more than 0 and less than 0.5");
  if (!(params.max_move_voxels > 0 && params.max_move_voxels <= 1))
    return failure(ErrorCode::kUsage, "max_move_voxels is " + std::to_string(params.max_move_voxels) +
                                          ", expected more than 0 and at most 1");
  if (!(params.slice_share >= 0 && params.slice_share <= 1))
    return failure(ErrorCode::kUsage,
                   "slice_share is " + std::to_string(params.slice_share) + ", expected 0 to 1");
  if (surface.triangles.empty() || surface.sides.size() != surface.triangles.size())
    return failure(ErrorCode::kBadInput, "the surface has " + std::to_string(surface.triangles.size()) +
                                             " triangles and " + std::to_string(surface.sides.size()) +
                                             " pairs of sides, expected some and as many");
  for (const Triangle& t : surface.triangles)
    for (const std::uint32_t v : t)
      if (v >= surface.points.size())
        return failure(ErrorCode::kBadInput, "a triangle names point " + std::to_string(v) + " of " +
                                                 std::to_string(surface.points.size()));
  if (volume.labels.size() != volume.voxel_count())
    return failure(ErrorCode::kBadInput, "the volume has " + std::to_string(volume.labels.size()) +
                                             " labels, expected " + std::to_string(volume.voxel_count()));
  if (!volume.index_to_mm.allFinite() || !(volume.voxel_mm3() > 0))
    return failure(ErrorCode::kBadInput, "the volume's affine is singular or not finite");
  return std::monostate{};
}

/// The only label of a surface against background, which may stand for several of the volume; background if
/// there are more.
Label only_label(const SurfaceMesh& surface) {
  const Label label = surface.sides.front()[0];
  for (const Sides& sides : surface.sides)
    if (sides != Sides{label, kBackground}) return kBackground;
  return label;
}

/// Regions on both sides of each triangle: an equally labelled corner of the lattice cell it lies in.
Result<RegionSides> find_region_sides(const SurfaceMesh& surface, const Points& start,
                                      const VoxelRegions& regions, const std::array<int, 3>& size,
                                      int threads) {
  RegionSides found(surface.triangles.size());
  const Eigen::Vector3d last_cell(size[0], size[1], size[2]);
  const auto find = [&](std::size_t t) {
    const Triangle& v = surface.triangles[t];
    const Eigen::Vector3d cell = ((start[v[0]] + start[v[1]] + start[v[2]]) / 3).array().floor();
    if (!(cell.array() >= -1).all() || !(cell.array() < last_cell.array()).all()) return false;
    std::array<bool, 2> known{};
    for (int corner = 0; corner < 8; ++corner) {
      const std::uint32_t region = regions.at(static_cast<int>(cell.x()) + (corner & 1),
                                              static_cast<int>(cell.y()) + (corner >> 1 & 1),
                                              static_cast<int>(cell.z()) + (corner >> 2));
      for (std::size_t side = 0; side < 2; ++side)
        if (regions.label(region) == surface.sides[t][side]) {
          found[t][side] = region;
          known[side] = true;
        }
    }
    return known[0] && known[1];
  };
  Flags is_found(found.size());
  parallel_for(threads, found.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) is_found[t] = find(t);
  });
  const auto lost = std::find(is_found.begin(), is_found.end(), std::uint8_t{0});
  if (lost == is_found.end()) return found;
  const auto t = static_cast<std::size_t>(lost - is_found.begin());
  return failure(ErrorCode::kBadInput,
                 "triangle " + std::to_string(t) + " lies between the labels " +
                     std::to_string(surface.sides[t][0]) + " and " + std::to_string(surface.sides[t][1]) +
                     ", which do not meet there in the volume: expected the volume it was extracted from");
}

/// The vertices of what is thin: those of slender voxels, and of regions whose volume is less than a sheet of
/// four voxels' thickness has by its area, if there are several. What is beyond cuts is thin, but goes in the
/// end.
Flags vertices_of_thin(const CorrectionProblem& problem, const VoxelRegions& regions, const CutPlanes& cuts,
                       bool is_one_label) {
  Flags thin(problem.start.size());
  for (std::size_t v = 0; v < thin.size(); ++v) thin[v] = problem.limits.is_slender(v);
  if (is_one_label) return thin;
  std::vector<double> areas(problem.target.size(), 0);  // in voxels' faces
  for (std::size_t t = 0; t < problem.regions.size(); ++t) {
    const auto [a, b, c] = problem.surface.triangles[t];
    const double area = 0.5 * triangle_cross(problem.start[a], problem.start[b], problem.start[c]).norm();
    for (const std::uint32_t region : problem.regions[t]) areas[region] += area;
  }
  const auto is_thin = [&](std::uint32_t region) {
    return region != VoxelRegions::kOutside && !is_beyond(cuts, regions.label(region)) &&
           2 * problem.target[region] < kThickVoxels * areas[region];
  };
  for (std::size_t t = 0; t < problem.regions.size(); ++t)
    if (std::any_of(problem.regions[t].begin(), problem.regions[t].end(), is_thin))
      for (const std::uint32_t v : problem.surface.triangles[t]) thin[v] = 1;
  return thin;
}

void hold_in_planes(const SurfaceMesh& surface, const CutPlanes& cuts, MoveLimits& limits) {
  if (cuts.empty()) return;
  const std::vector<CutBits> of_points =
      cuts_of_points(surface.points.size(), surface.triangles, surface.sides, cuts);
  for (std::size_t v = 0; v < of_points.size(); ++v)
    for (std::size_t c = 0; c < cuts.size(); ++c)
      if ((of_points[v] >> c & 1) != 0) limits.hold(v, cuts[c].axis);
}

/// Smoothing, and the guard after every few steps, so that a surface held at a voxel centre stays smooth
/// around it. What is thin takes the first steps alone. Crossings are limited after these: the normals of a
/// staircase say nothing. False when cancelled.
bool smooth_guarded(const CorrectionProblem& problem, const VoxelRegions& regions, const SurfaceGraph& graph,
                    const Flags& thin, const SmoothParams& params, const SmoothSteps& steps,
                    const RunContext& ctx, Points& x) {
  const std::vector<Triangle>& triangles = problem.surface.triangles;
  BilaplacianSmoother smoother(graph, problem.start, problem.limits, params.step);
  for (int done = 0, now = steps.of_thin; done < steps.all; done += now) {
    ctx.progress(kSmoothStage, kSmoothingShare * done / steps.all);
    if (done > 0) {
      now = std::min(kStepsBetweenGuards, steps.all - done);
      smoother.limit_crossings(crossing_limits(triangles, problem.start, x, problem.limits.reach()));
    }
    if (done == steps.of_thin) smoother.fix(thin);
    const Points safe = x;
    if (!smoother.run(now, ctx, x)) return false;
    guard_shape(triangles, regions, problem.start, safe, x, ctx);
  }
  return true;
}

/// Volumes corrected and shapes guarded in turn: points that the guard took back leave their share of the
/// correction to the others. False when cancelled.
bool correct_guarded(const CorrectionProblem& problem, const VoxelRegions& regions, const SurfaceGraph& graph,
                     const RunContext& ctx, Points& x) {
  Flags movable(x.size());
  for (std::size_t v = 0; v < x.size(); ++v) movable[v] = graph.kinds[v] == VertexKind::kSurface;
  const std::vector<CrossingLimit> crossings =
      crossing_limits(problem.surface.triangles, problem.start, x, problem.limits.reach());
  for (int pass = 0; pass < kCorrectionPasses; ++pass) {
    const Points safe = x;
    if (!correct_volumes(problem, crossings, ctx, movable, x)) return false;
    const Flags back = guard_shape(problem.surface.triangles, regions, problem.start, safe, x, ctx);
    for (std::size_t v = 0; v < x.size(); ++v) movable[v] = movable[v] && !back[v];
  }
  return true;
}

/// In voxels, along each index axis.
Eigen::Vector3d reach_of(const SmoothParams& params, const std::array<int, 3>& planes) {
  Eigen::Vector3d reach;
  for (std::size_t d = 0; d < 3; ++d)
    reach[static_cast<Eigen::Index>(d)] =
        params.max_move_voxels * std::max(1.0, params.slice_share * planes[d]);
  return reach;
}

/// Volumes corrected, points in mm, flat in cuts and without intersections. `x`: in index space.
Result<SurfaceMesh> finished(const CorrectionProblem& problem, const VoxelRegions& regions,
                             const SurfaceGraph& graph, const LabelVolume& volume, bool keep_volume,
                             const CutPlanes& cuts, RunContext& ctx, Points& x) {
  if (keep_volume && !correct_guarded(problem, regions, graph, ctx, x)) return cancelled_error(kSmoothStage);
  const SurfaceMesh& surface = problem.surface;
  SurfaceMesh out{std::move(x), surface.triangles, surface.sides};
  for (std::size_t v = 0; v < out.points.size(); ++v)
    out.points[v] = out.points[v] == problem.start[v]
                        ? surface.points[v]
                        : Eigen::Vector3d(volume.linear() * out.points[v] + volume.origin());
  flatten_cuts(out, cuts);
  if (undo_intersections(out, surface.points, ctx).cancelled) return cancelled_error(kSmoothStage);
  ctx.progress(kSmoothStage, 1.0);
  return out;
}

template <class T>
std::vector<T> picked(const std::vector<T>& all, const std::vector<std::uint32_t>& which) {
  std::vector<T> out;
  out.reserve(which.size());
  for (const std::uint32_t i : which) out.push_back(all[i]);
  return out;
}

Result<SurfaceMesh> smooth_checked(const SurfaceMesh& surface, const LabelVolume& volume,
                                   const SmoothParams& params, RunContext& ctx, const CutPlanes& cuts,
                                   const std::array<int, 3>& planes) {
  const Eigen::Matrix3d to_index = volume.linear().inverse();
  Points start(surface.points.size());
  for (std::size_t v = 0; v < start.size(); ++v) start[v] = to_index * (surface.points[v] - volume.origin());

  const Label label = only_label(surface);
  const VoxelRegions regions(volume, label);
  const Result<RegionSides> sides = find_region_sides(surface, start, regions, volume.size, ctx.threads);
  if (!sides) return sides.error();
  const SurfaceGraph graph = build_surface_graph(surface);
  const auto limits_of = [&](const SurfaceMesh& of, const Points& at) {
    MoveLimits limits(at, regions, reach_of(params, planes));
    hold_in_planes(of, cuts, limits);
    return limits;
  };
  const MoveLimits limits = limits_of(surface, start);
  const double orientation = volume.linear().determinant() < 0 ? -1 : 1;
  const CorrectionProblem problem{surface, *sides, regions.volumes(), start, limits, orientation};
  Points x = start;
  const bool is_one_label = label != kBackground;
  if (!smooth_guarded(problem, regions, graph, vertices_of_thin(problem, regions, cuts, is_one_label), params,
                      steps_of(params.iterations, is_one_label), ctx, x))
    return cancelled_error(kSmoothStage);
  if (is_one_label) return finished(problem, regions, graph, volume, params.keep_volume, cuts, ctx, x);

  const std::optional<JoinedSurface> joined = join_diagonals(volume, surface, start, x, ctx);
  if (!joined) return cancelled_error(kSmoothStage);
  const SurfaceMesh fewer{picked(surface.points, joined->vertex_of), joined->triangles,
                          picked(surface.sides, joined->triangle_of)};
  const Points fewer_start = picked(start, joined->vertex_of);
  const RegionSides fewer_sides = picked(*sides, joined->triangle_of);
  const MoveLimits fewer_limits = limits_of(fewer, fewer_start);
  x = picked(x, joined->vertex_of);
  return finished({fewer, fewer_sides, regions.volumes(), fewer_start, fewer_limits, orientation}, regions,
                  build_surface_graph(fewer), volume, params.keep_volume, cuts, ctx, x);
}

}  // namespace

Result<SurfaceMesh> smooth_surface(const SurfaceMesh& surface, const LabelVolume& volume,
                                   const SmoothParams& params, RunContext& ctx, const CutPlanes& cuts,
                                   const std::array<int, 3>& planes) {
  if (const Status status = check_input(surface, volume, params); !status) return status.error();
  if (params.iterations == 0) return surface;
  try {
    return smooth_checked(surface, volume, params, ctx, cuts, planes);
  } catch (const std::bad_alloc&) {
    return failure(ErrorCode::kOutOfMemory,
                   "not enough memory to smooth " + std::to_string(surface.triangles.size()) + " triangles");
  }
}

}  // namespace voxtet
