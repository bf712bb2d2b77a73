#include "surface/smooth_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <new>
#include <string>
#include <vector>

#include "surface/surface_graph.h"
#include "surface/volume_correction.h"

namespace voxtet {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr double kSmallestAreaRatio = 0.02;  ///< of a triangle's area before smoothing
constexpr int kRestoreRounds = 6;

Error failure(ErrorCode code, const std::string& message) {
  return {code, "smooth", message, {}};
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
  if (surface.triangles.empty() || surface.sides.size() != surface.triangles.size())
    return failure(ErrorCode::kBadInput, "the surface has " + std::to_string(surface.triangles.size()) +
                                             " triangles and " + std::to_string(surface.sides.size()) +
                                             " pairs of sides, expected some and as many");
  for (const Triangle& t : surface.triangles)
    for (const std::uint32_t v : t)
      if (v >= surface.points.size())
        return failure(ErrorCode::kBadInput, "a triangle names point " + std::to_string(v) + " of " +
                                                 std::to_string(surface.points.size()));
  if (!volume.index_to_mm.allFinite() || !(volume.voxel_mm3() > 0))
    return failure(ErrorCode::kBadInput, "the volume's affine is singular or not finite");
  return std::monostate{};
}

/// L(x) at vertex v: mean of its neighbours minus itself.
Eigen::Vector3d umbrella(const SurfaceGraph& graph, const Points& x, std::size_t v) {
  const auto row = graph.of(v);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::uint32_t other : row) sum += x[other];
  return sum / static_cast<double>(row.size()) - x[v];
}

/// x <- clamp(x - step * L(L(x))). Returns false when cancelled.
bool smooth_points(const SurfaceGraph& graph, const SmoothParams& params, const Points& start,
                   const RunContext& ctx, Points& x) {
  Points laplacian(x.size(), Eigen::Vector3d::Zero());
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(params.max_move_voxels);
  for (int iteration = 0; iteration < params.iterations; ++iteration) {
    if (ctx.cancelled()) return false;
    ctx.progress("smooth", static_cast<double>(iteration) / (params.iterations + 1));
    for (std::size_t v = 0; v < x.size(); ++v)
      if (graph.kinds[v] != VertexKind::kFixed) laplacian[v] = umbrella(graph, x, v);
    for (std::size_t v = 0; v < x.size(); ++v) {
      if (graph.kinds[v] == VertexKind::kFixed) continue;
      x[v] -= params.step * umbrella(graph, laplacian, v);
      x[v] = x[v].cwiseMax(start[v] - reach).cwiseMin(start[v] + reach);
    }
  }
  return true;
}

/// Specks and pillars one voxel thick would shrink to points and lines. Vertices of triangles that lost
/// nearly all their area, or turned over, go half-way back to their start until none is left.
void restore_collapsed(const SurfaceMesh& surface, const Points& start, Points& x) {
  const auto cross = [&surface](const Points& points, std::size_t t) -> Eigen::Vector3d {
    const Triangle& v = surface.triangles[t];
    return (points[v[1]] - points[v[0]]).cross(points[v[2]] - points[v[0]]);
  };
  std::vector<bool> back(x.size());
  for (int round = 0; round < kRestoreRounds; ++round) {
    std::fill(back.begin(), back.end(), false);
    bool any = false;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      const Eigen::Vector3d before = cross(start, t);
      // The projection on the old normal falls below the ratio in either case.
      if (cross(x, t).dot(before) >= kSmallestAreaRatio * before.squaredNorm()) continue;
      any = true;
      for (const std::uint32_t v : surface.triangles[t]) back[v] = true;
    }
    if (!any) return;
    for (std::size_t v = 0; v < x.size(); ++v)
      if (back[v]) x[v] = 0.5 * (x[v] + start[v]);
  }
}

/// Wanted volume by label, in voxels. A surface of one label may be that of all labels together.
std::vector<double> voxel_volumes(const SurfaceMesh& surface, const LabelVolume& volume) {
  Label largest = kBackground, only = kBackground;
  bool several = false;
  for (const Sides& sides : surface.sides)
    for (const Label label : sides) {
      largest = std::max(largest, label);
      if (label == kBackground) continue;
      several = several || (only != kBackground && label != only);
      only = label;
    }
  for (const Label label : volume.labels) largest = std::max(largest, label);
  std::vector<double> counts(static_cast<std::size_t>(largest) + 1, 0.0);
  for (const Label label : volume.labels) counts[label] += 1;
  counts[kBackground] = 0;
  if (!several) {
    double total = 0;
    for (const double count : counts) total += count;
    counts[only] = total;
  }
  return counts;
}

Result<SurfaceMesh> smooth_checked(const SurfaceMesh& surface, const LabelVolume& volume,
                                   const SmoothParams& params, RunContext& ctx) {
  const Eigen::Matrix3d to_mm = volume.linear();
  const Eigen::Matrix3d to_index = to_mm.inverse();
  const Eigen::Vector3d origin = volume.origin();
  Points start(surface.points.size());
  for (std::size_t v = 0; v < start.size(); ++v) start[v] = to_index * (surface.points[v] - origin);

  const SurfaceGraph graph = build_surface_graph(surface);
  Points x = start;
  if (!smooth_points(graph, params, start, ctx, x)) return cancelled_error("smooth");
  restore_collapsed(surface, start, x);
  if (params.keep_volume) {
    const double orientation = to_mm.determinant() < 0 ? -1 : 1;
    correct_volumes(surface, graph, voxel_volumes(surface, volume), orientation, params.max_move_voxels,
                    start, x);
  }
  SurfaceMesh out{std::move(x), surface.triangles, surface.sides};
  for (std::size_t v = 0; v < out.points.size(); ++v)
    out.points[v] =
        out.points[v] == start[v] ? surface.points[v] : Eigen::Vector3d(to_mm * out.points[v] + origin);
  ctx.progress("smooth", 1.0);
  return out;
}

}  // namespace

Result<SurfaceMesh> smooth_surface(const SurfaceMesh& surface, const LabelVolume& volume,
                                   const SmoothParams& params, RunContext& ctx) {
  if (const Status status = check_input(surface, volume, params); !status) return status.error();
  if (params.iterations == 0) return surface;
  try {
    return smooth_checked(surface, volume, params, ctx);
  } catch (const std::bad_alloc&) {
    return failure(ErrorCode::kOutOfMemory,
                   "not enough memory to smooth " + std::to_string(surface.triangles.size()) + " triangles");
  }
}

}  // namespace voxtet
