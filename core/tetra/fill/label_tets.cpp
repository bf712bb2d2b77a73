#include "tetra/fill/label_tets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "geometry/elements/surface_measures.h"
#include "tetra/mesh/meshing_error.h"
#include "tetra/mesh/tet_complex.h"
#include "tetra/mesh/triangle_index.h"

namespace voxtet {
namespace {

using tetra::kNone;
using tetra::TriangleIndex;

constexpr double kFillTolerance = 1e-9;
/// Rounding of a volume that is the sum of cones from afar, relative to the sum of their sizes.
constexpr double kConeRounding = 1e-13;

/// Calls visit(tet, triangle, behind) for every face of a tet that is a triangle of the surface; behind: the
/// tet lies where sides[0] stands.
template <class Visit>
void for_each_boundary_face(const SurfaceMesh& surface, const std::vector<Tet>& tets, Visit&& visit) {
  const TriangleIndex index(surface);
  const std::uint32_t n = static_cast<std::uint32_t>(surface.points.size());
  for (std::uint32_t t = 0; t < tets.size(); ++t) {
    const Tet& tet = tets[t];
    if ((tet[0] >= n) + (tet[1] >= n) + (tet[2] >= n) + (tet[3] >= n) > 1) continue;
    for (const auto& [i, j, k] : kFacetCorners) {
      const Triangle corners{tet[i], tet[j], tet[k]};
      if (corners[0] >= n || corners[1] >= n || corners[2] >= n) continue;
      const auto [triangle, same] = index.find(corners);
      if (triangle != kNone) visit(t, triangle, same);
    }
  }
}

Status check_points(const SurfaceMesh& surface, const FilledParts& filled) {
  const std::size_t kept = surface.points.size();
  for (std::size_t i = 0; i < kept; ++i)
    if (i >= filled.points.size() || filled.points[i] != surface.points[i])
      return meshing_error("point " + std::to_string(i) + " of the surface was merged with another",
                           {{surface.points[i]}, {}});
  std::vector<bool> used(filled.points.size(), false);
  for (const Tet& tet : filled.tets)
    for (const std::uint32_t v : tet) used[v] = true;
  const auto unused = static_cast<std::size_t>(std::find(used.begin(), used.end(), false) - used.begin());
  if (unused == used.size()) return std::monostate{};
  return meshing_error("point " + std::to_string(unused) + " is used by no tetrahedron",
                       {{filled.points[unused]}, {}});
}

/// Each region's label, or the triangles where a region touches two.
Result<std::vector<std::uint32_t>> labels_of_regions(const SurfaceMesh& surface, const FilledParts& filled) {
  const std::uint32_t regions = *std::max_element(filled.regions.begin(), filled.regions.end()) + 1;
  std::vector<std::uint32_t> label(regions, kNone);
  std::vector<std::uint8_t> behind_count(surface.triangles.size(), 0), front_count(behind_count);
  std::vector<bool> leaks(surface.triangles.size(), false);
  for_each_boundary_face(surface, filled.tets, [&](std::uint32_t tet, std::uint32_t t, bool behind) {
    const Label side = surface.sides[t][behind ? 0 : 1];
    std::uint8_t& count = behind ? behind_count[t] : front_count[t];
    if (count < 2) ++count;
    std::uint32_t& known = label[filled.regions[tet]];
    if (known == kNone) known = side;
    if (known != side || side == kBackground) leaks[t] = true;
  });
  if (FaultyTriangles found(surface, leaks); found.count > 0)
    return meshing_error(
        "one connected part of the mesh touches two labels (" + std::to_string(found.count) + " triangles)",
        std::move(found.where));
  std::vector<bool> missing(surface.triangles.size(), false);
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const int wanted_in_front = surface.sides[t][1] == kBackground ? 0 : 1;
    missing[t] = behind_count[t] != 1 || front_count[t] != wanted_in_front;
  }
  if (FaultyTriangles found(surface, missing); found.count > 0)
    return meshing_error(
        std::to_string(found.count) + " triangles of the surface are not faces of the tetrahedra beside them",
        std::move(found.where));
  return label;
}

/// Volumes by label: of the tets, and of what the triangles enclose; and the sizes of the cones whose signed
/// sum the latter is.
struct Volumes {
  std::vector<double> filled, enclosed, cones;
};

/// The triangles with two or more corners in a flat tetrahedron.
Error flat_error(const SurfaceMesh& surface, const TetMesh& mesh, const std::vector<std::uint32_t>& flat) {
  std::vector<bool> corner(mesh.points.size(), false);
  for (const std::uint32_t t : flat)
    for (const std::uint32_t v : mesh.tets[t]) corner[v] = true;
  std::vector<bool> beside(surface.triangles.size());
  for (std::size_t t = 0; t < beside.size(); ++t) {
    const auto [a, b, c] = surface.triangles[t];
    beside[t] = corner[a] + corner[b] + corner[c] >= 2;
  }
  return meshing_error(std::to_string(flat.size()) + " tetrahedra have no volume",
                       FaultyTriangles(surface, beside).where);
}

Result<Volumes> measure(const SurfaceMesh& surface, const TetMesh& mesh) {
  Volumes volumes;
  std::vector<std::uint32_t> flat;
  volumes.filled.assign(0x10000, 0);
  volumes.enclosed.assign(0x10000, 0);
  volumes.cones.assign(0x10000, 0);
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
    const auto [a, b, c, d] = mesh.tets[t];
    const Eigen::Vector3d& p = mesh.points[a];
    const double six = (mesh.points[b] - p).dot((mesh.points[c] - p).cross(mesh.points[d] - p));
    if (!(six > 0)) flat.push_back(t);
    volumes.filled[mesh.labels[t]] += six / 6;
  }
  if (!flat.empty()) return flat_error(surface, mesh, flat);
  const Eigen::Vector3d& origin = surface.points[surface.triangles[0][0]];
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const auto [ia, ib, ic] = surface.triangles[t];
    const Eigen::Vector3d &a = surface.points[ia], &b = surface.points[ib], &c = surface.points[ic];
    // By the triangle's own edges: far from the origin those of the cone would round away small triangles.
    const double cone = (a - origin).dot(triangle_cross(a, b, c)) / 6;
    volumes.enclosed[surface.sides[t][0]] += cone;
    volumes.enclosed[surface.sides[t][1]] -= cone;
    for (const Label side : surface.sides[t]) volumes.cones[side] += std::abs(cone);
  }
  return volumes;
}

Status check_volumes(const SurfaceMesh& surface, const TetMesh& mesh) {
  const Result<Volumes> volumes = measure(surface, mesh);
  if (!volumes) return volumes.error();
  for (std::size_t label = 1; label < volumes->filled.size(); ++label) {
    const double filled = volumes->filled[label], enclosed = volumes->enclosed[label];
    const double tolerance = kFillTolerance * std::abs(enclosed) + kConeRounding * volumes->cones[label];
    if (std::abs(filled - enclosed) <= tolerance) continue;
    return meshing_error("the tetrahedra of label " + std::to_string(label) + " fill " +
                         std::to_string(filled) + " mm3, its boundary encloses " + std::to_string(enclosed) +
                         " mm3");
  }
  return std::monostate{};
}

}  // namespace

Result<TetMesh> label_tets(const SurfaceMesh& surface, FilledParts filled) {
  const Status points = check_points(surface, filled);
  if (!points) return points.error();
  const Result<std::vector<std::uint32_t>> label = labels_of_regions(surface, filled);
  if (!label) return label.error();
  TetMesh mesh;
  mesh.labels.reserve(filled.tets.size());
  for (const std::uint32_t region : filled.regions) {
    if ((*label)[region] == kNone)
      return meshing_error("a part of the mesh touches no triangle of the surface");
    mesh.labels.push_back(static_cast<Label>((*label)[region]));
  }
  mesh.points = std::move(filled.points);
  mesh.tets = std::move(filled.tets);
  mesh.faces = surface.triangles;
  mesh.face_sides = surface.sides;
  const Status volumes = check_volumes(surface, mesh);
  if (!volumes) return volumes.error();
  return mesh;
}

}  // namespace voxtet
