#include "tetra/fill_tets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/self_intersections.h"
#include "tetra/check_surface.h"
#include "tetra/edge_groups.h"
#include "tetra/hole_seeds.h"
#include "tetra/label_tets.h"
#include "tetra/tetgen_backend.h"

namespace voxtet {
namespace {

constexpr std::size_t kMaxPlaces = 1000;
constexpr double kSharpEdgeDeg = 10;

/// One way to call the mesher; tried in order until one passes every check.
struct Attempt {
  std::string name;
  TetgenOptions options;
};

std::vector<Attempt> attempts(const FillParams& params) {
  const TetgenOptions asked{params.radius_edge, params.min_dihedral_deg, params.max_dihedral_deg, 1e-8};
  TetgenOptions fine = asked, coarse = asked, plain = asked;
  fine.tolerance = plain.tolerance = 1e-10;
  coarse.tolerance = 1e-6;
  plain.min_dihedral_deg = plain.max_dihedral_deg = 0;
  return {{"as asked", asked},
          {"with a finer tolerance", fine},
          {"with a coarser tolerance", coarse},
          {"without bounds on dihedral angles", plain}};
}

Status check_sizing(const SizingField& sizing) {
  const auto [x, y, z] = sizing.size;
  const bool empty = x < 1 || y < 1 || z < 1 ||
                     sizing.h_mm.size() != static_cast<std::size_t>(x) * static_cast<std::size_t>(y) *
                                               static_cast<std::size_t>(z);
  const bool valid = !empty && std::all_of(sizing.h_mm.begin(), sizing.h_mm.end(),
                                           [](float h) { return std::isfinite(h) && h > 0; });
  if (valid) return std::monostate{};
  return Error{
      ErrorCode::kInternal, "tetra", "the sizing field is empty or holds a size that is not positive", {}};
}

std::string fixed(double value, int digits) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

void warn_of_sharp_edge(const SurfaceMesh& surface, const EdgeGroups& edges, const RunContext& ctx) {
  const SharpestEdge sharpest = find_sharpest_edge(surface, edges);
  if (sharpest.angle_deg >= kSharpEdgeDeg) return;
  ctx.warn("tetra", "two triangles meet at " + fixed(sharpest.angle_deg, 2) + " degrees at (" +
                        fixed(sharpest.place.x(), 2) + ", " + fixed(sharpest.place.y(), 2) + ", " +
                        fixed(sharpest.place.z(), 2) + "): tetrahedra there cannot be better shaped");
}

/// The triangles that intersect each other, where there are any.
std::optional<Error> intersection_error(const SurfaceMesh& surface) {
  const std::vector<std::array<std::uint32_t, 2>> pairs = find_self_intersections(surface, kMaxPlaces);
  if (pairs.empty()) return std::nullopt;
  ErrorPlace where;
  for (const auto& pair : pairs) where.elements.insert(where.elements.end(), pair.begin(), pair.end());
  std::sort(where.elements.begin(), where.elements.end());
  where.elements.erase(std::unique(where.elements.begin(), where.elements.end()), where.elements.end());
  for (const std::uint32_t t : where.elements) {
    const auto [a, b, c] = surface.triangles[t];
    where.points.push_back((surface.points[a] + surface.points[b] + surface.points[c]) / 3);
  }
  std::string message = "the surface intersects itself: " + std::to_string(where.elements.size()) +
                        " triangles do; it must be free of intersections";
  return Error{ErrorCode::kMeshing, "tetra", std::move(message), std::move(where)};
}

Result<TetMesh> attempt_all(const SurfaceMesh& surface, const EdgeGroups& edges, const SizingField& sizing,
                            const FillParams& params, const RunContext& ctx) {
  const std::vector<Eigen::Vector3d> holes = find_hole_seeds(surface, edges);
  std::optional<Error> failure;
  for (const Attempt& attempt : attempts(params)) {
    if (ctx.cancelled()) return cancelled_error("tetra");
    Result<TetgenMesh> filled = run_tetgen(surface, holes, sizing, attempt.options, ctx);
    Result<TetMesh> mesh = filled ? label_tets(surface, *std::move(filled)) : Result<TetMesh>(filled.error());
    if (mesh) {
      if (failure) ctx.warn("tetra", "filled " + attempt.name + ", after: " + failure->message);
      return mesh;
    }
    if (mesh.error().code != ErrorCode::kMeshing) return mesh;
    if (failure) continue;
    if (std::optional<Error> intersection = intersection_error(surface)) return *std::move(intersection);
    failure = mesh.error();
  }
  return *std::move(failure);
}

Result<TetMesh> check_and_fill(const SurfaceMesh& surface, const SizingField& sizing,
                               const FillParams& params, const RunContext& ctx) {
  const Status sizes = check_sizing(sizing);
  if (!sizes) return sizes.error();
  const Status triangles = check_triangles(surface);
  if (!triangles) return triangles.error();
  const EdgeGroups edges(surface);
  const Status closed = check_closed(surface, edges);
  if (!closed) return closed.error();
  warn_of_sharp_edge(surface, edges, ctx);
  return attempt_all(surface, edges, sizing, params, ctx);
}

}  // namespace

Result<TetMesh> fill_tets(const SurfaceMesh& surface, const SizingField& sizing, const FillParams& params,
                          RunContext& ctx) {
  ctx.progress("tetra", 0);
  try {
    Result<TetMesh> mesh = check_and_fill(surface, sizing, params, ctx);
    if (mesh) ctx.progress("tetra", 1);
    return mesh;
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, "tetra", "memory ran out around the filling of the surface", {}};
  }
}

}  // namespace voxtet
