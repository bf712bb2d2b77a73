#include "tetra/fill/fill_tets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tetra/backends/delaunay_backend.h"
#include "tetra/backends/tetgen_backend.h"
#include "tetra/fill/check_surface.h"
#include "tetra/fill/forecast_points.h"
#include "tetra/fill/hole_seeds.h"
#include "tetra/fill/label_tets.h"
#include "tetra/fill/order_tets.h"
#include "tetra/mesh/edge_groups.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

constexpr double kSharpEdgeDeg = 10;
constexpr double kSharpCornerDeg = 1;
/// A run that asks for so many times the points forecast is stopped.
constexpr double kRunawayFactor = 20;
/// Part of its shortest edge by which a point is displaced, along each axis and either way.
constexpr double kDisplacement = 5e-7;

/// How a mesher may be called.
struct Strategy {
  const char* name;
  TetgenOptions options;
  bool displaced = false;  ///< the mesher sees points moved a little; they go back afterwards
  bool laxer = false;      ///< asks for less than the caller did
  TetBackend backend = TetBackend::kTetgen;
};

/// The strategies, in the order in which they are tried until one passes every check. Each has a surface in
/// tests/unit/tetra/fallback_test.cpp that those before it fail on. Points added on the surface (without -Y)
/// are none of them: what that saved the finer tolerance saves as well, and TetGen 1.5.0 crashes there.
std::vector<Strategy> strategies_for(const FillParams& params, std::size_t max_points) {
  TetgenOptions asked;
  asked.radius_edge = params.radius_edge;
  asked.min_dihedral_deg = params.min_dihedral_deg;
  asked.max_dihedral_deg = params.max_dihedral_deg;
  asked.max_points = max_points;
  TetgenOptions fine = asked, angles = asked, shapes = asked;
  fine.tolerance = 1e-15;
  angles.tolerance = shapes.tolerance = fine.tolerance;
  angles.min_dihedral_deg = angles.max_dihedral_deg = 0;
  shapes.min_dihedral_deg = shapes.max_dihedral_deg = 0;
  shapes.radius_edge = 20;
  std::vector<Strategy> strategies{{"as asked", asked},
                                   {"with a finer tolerance", fine},
                                   {"with points displaced by a millionth of their edges", asked, true},
                                   {"without bounds on dihedral angles", angles, false, true},
                                   {"with bounds on sizes alone", shapes, false, true}};
  if (params.backend == TetBackend::kDelaunay) {
    strategies.front().name = "by TetGen";
    strategies.insert(strategies.begin(),
                      {"by Delaunay refinement", asked, false, false, TetBackend::kDelaunay});
  }
  return strategies;
}

Status check_sizing(const SizingField& sizing) {
  const auto [x, y, z] = sizing.size;
  const bool empty = x < 1 || y < 1 || z < 1 ||
                     sizing.h_mm.size() != static_cast<std::size_t>(x) * static_cast<std::size_t>(y) *
                                               static_cast<std::size_t>(z);
  const bool valid = !empty && std::all_of(sizing.h_mm.begin(), sizing.h_mm.end(),
                                           [](float h) { return std::isfinite(h) && h > 0; });
  if (valid) return std::monostate{};
  return Error{ErrorCode::kInternal,
               kTetraStage,
               "the sizing field is empty or holds a size that is not positive",
               {}};
}

std::string fixed(double value, int digits) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

std::string angle_at(const SharpAngle& sharp) {
  return fixed(sharp.angle_deg, 2) + " degrees at (" + fixed(sharp.place.x(), 2) + ", " +
         fixed(sharp.place.y(), 2) + ", " + fixed(sharp.place.z(), 2) + ")";
}

void tell_sharp_angles(const SurfaceMesh& surface, const EdgeGroups& edges, const RunContext& ctx) {
  const SharpAngle corner = find_sharpest_corner(surface), edge = find_sharpest_edge(surface, edges);
  ctx.note(kTetraStage, "the surface's smallest angles: in a triangle " + fixed(corner.angle_deg, 2) +
                            " degrees, between two " + fixed(edge.angle_deg, 2) + " degrees");
  if (corner.angle_deg < kSharpCornerDeg)
    ctx.warn(kTetraStage, "a triangle has an angle of " + angle_at(corner));
  if (edge.angle_deg < kSharpEdgeDeg)
    ctx.warn(kTetraStage,
             "two triangles meet at " + angle_at(edge) + ": tetrahedra there cannot be better shaped");
}

/// The surface with every point displaced a little, the same way in every run.
SurfaceMesh displaced(const SurfaceMesh& surface) {
  std::vector<double> shortest(surface.points.size(), std::numeric_limits<double>::max());
  for (const Triangle& t : surface.triangles)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = t[c], b = t[(c + 1) % 3];
      const double length = (surface.points[a] - surface.points[b]).norm();
      shortest[a] = std::min(shortest[a], length);
      shortest[b] = std::min(shortest[b], length);
    }
  SurfaceMesh moved = surface;
  std::uint64_t state = 1;
  for (std::size_t p = 0; p < moved.points.size(); ++p)
    for (int d = 0; d < 3; ++d) {
      state = state * 6364136223846793005ULL + 1442695040888963407ULL;
      const double within_one = static_cast<double>(state >> 33) / 1073741824.0 - 1;
      moved.points[p][d] += kDisplacement * shortest[p] * within_one;
    }
  return moved;
}

/// What a mesher made of the surface, checked, with neighbours together.
Result<TetMesh> mesh_of(const SurfaceMesh& surface, FilledParts filled) {
  Result<TetMesh> mesh = label_tets(surface, std::move(filled));
  if (mesh) tetra::order_along_curve(*mesh, surface.points.size());
  return mesh;
}

Result<TetMesh> fill_by(const Strategy& strategy, const SurfaceMesh& surface,
                        const std::vector<Eigen::Vector3d>& holes, const SizingField& sizing,
                        const WallLayers& layers, const RunContext& ctx) {
  if (strategy.backend == TetBackend::kDelaunay) {
    SurfaceMesh recovered = surface;
    Result<FilledParts> filled = run_delaunay(
        recovered, sizing, {strategy.options.radius_edge, strategy.options.max_points}, layers, ctx);
    if (!filled) return filled.error();
    return mesh_of(recovered, *std::move(filled));
  }
  Result<FilledParts> filled = strategy.displaced
                                   ? run_tetgen(displaced(surface), holes, sizing, strategy.options, ctx)
                                   : run_tetgen(surface, holes, sizing, strategy.options, ctx);
  if (!filled) return filled.error();
  if (strategy.displaced && filled->points.size() >= surface.points.size())
    std::copy(surface.points.begin(), surface.points.end(), filled->points.begin());
  return mesh_of(surface, *std::move(filled));
}

Result<TetMesh> fill_by_first(const SurfaceMesh& surface, const EdgeGroups& edges, const SizingField& sizing,
                              const FillParams& params, const WallLayers& layers, const RunContext& ctx) {
  const std::vector<Eigen::Vector3d> holes = find_hole_seeds(surface, edges);
  const double most = std::min(kRunawayFactor * forecast_points(surface, sizing), 2e9);
  const std::vector<Strategy> strategies = strategies_for(params, static_cast<std::size_t>(most));
  const RunContext filling = ctx.part(0.1, 0.9);
  std::optional<Error> first_failure;
  bool runaway = false;
  for (std::size_t r = 0; r < strategies.size(); ++r) {
    const Strategy& strategy = strategies[r];
    // Where points were without end, another rounding of the same sizes does not help.
    if (runaway && !strategy.laxer) continue;
    if (ctx.cancelled()) return cancelled_error(kTetraStage);
    Result<TetMesh> mesh = fill_by(strategy, surface, holes, sizing, layers, filling);
    if (mesh) {
      const std::string filled = std::string("filled ") + strategy.name;
      ctx.note(kTetraStage, filled + " (strategy " + std::to_string(r + 1) + " of " +
                                std::to_string(strategies.size()) + ")");
      if (!layers.empty() && strategy.backend == TetBackend::kTetgen)
        ctx.warn(kTetraStage,
                 "TetGen, which filled the surface, adds points inside of layers: some have more than one "
                 "element");
      // TetGen in the first strategy of its own is no worse than the Delaunay refinement that it follows.
      if (r > 0 && strategies[r - 1].backend == strategy.backend)
        ctx.warn(kTetraStage, filled + ", after: " + first_failure->message);
      return mesh;
    }
    if (mesh.error().code != ErrorCode::kMeshing) return mesh;
    ctx.note(kTetraStage, std::string("not filled ") + strategy.name + ": " + mesh.error().message);
    runaway = runaway || is_runaway(mesh.error());
    if (!first_failure) first_failure = mesh.error();
  }
  if (first_failure->where.elements.empty()) first_failure->where = find_narrow_places(surface, edges);
  first_failure->message +=
      "; none of " + std::to_string(strategies.size()) + " strategies to fill the surface succeeded";
  return *std::move(first_failure);
}

Result<TetMesh> check_and_fill(const SurfaceMesh& surface, const SizingField& sizing,
                               const FillParams& params, const WallLayers& layers, const RunContext& ctx) {
  if (const Status sizes = check_sizing(sizing); !sizes) return sizes.error();
  if (const Status triangles = check_triangles(surface); !triangles) return triangles.error();
  const EdgeGroups edges(surface);
  if (const Status closed = check_closed(surface, edges); !closed) return closed.error();
  if (const Status clean = check_intersections(surface); !clean) return clean.error();
  if (const Status apart = check_overlaps(surface, edges); !apart) return apart.error();
  tell_sharp_angles(surface, edges, ctx);
  return fill_by_first(surface, edges, sizing, params, layers, ctx);
}

}  // namespace

Result<TetMesh> fill_tets(const SurfaceMesh& surface, const SizingField& sizing, const FillParams& params,
                          RunContext& ctx, const WallLayers& layers) {
  ctx.progress(kTetraStage, 0);
  try {
    Result<TetMesh> mesh = check_and_fill(surface, sizing, params, layers, ctx);
    if (mesh) ctx.progress(kTetraStage, 1);
    return mesh;
  } catch (const std::bad_alloc&) {
    return Error{
        ErrorCode::kOutOfMemory, kTetraStage, "memory ran out around the filling of the surface", {}};
  }
}

}  // namespace voxtet
