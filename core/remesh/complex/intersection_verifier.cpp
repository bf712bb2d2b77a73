#include "remesh/complex/intersection_verifier.h"

#include <algorithm>

#include "geometry/intersect/exact_intersections.h"

namespace voxtet::remesh {
namespace {

constexpr int kAcross = 128;
/// Columns that are longer lose what they list twice.
constexpr std::size_t kLong = 128;

Eigen::AlignedBox3d box_in(const ComplexMesh& mesh, std::uint32_t t) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.corners(mesh.triangle(t))) box.extend(p);
  return box;
}

void drop_doubles(std::vector<std::uint32_t>& triangles) {
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
}

}  // namespace

IntersectionVerifier::IntersectionVerifier(const ComplexMesh& mesh)
    : columns_(static_cast<std::size_t>(kAcross) * kAcross) {
  Eigen::AlignedBox3d all;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) all.extend(mesh.point(v));
  low_ = all.min();
  per_mm_ = kAcross / std::max(all.diagonal().head<2>().maxCoeff(), 1e-300);
  for (std::uint32_t t = 0; t < mesh.slot_count(); ++t)
    if (mesh.alive(t)) list(mesh, t);
}

template <class Visit>
void IntersectionVerifier::for_columns(const Eigen::AlignedBox3d& box, Visit&& visit) {
  const auto column = [this](double x, int d) {
    return static_cast<std::size_t>(std::clamp((x - low_[d]) * per_mm_, 0.0, kAcross - 1.0));
  };
  for (std::size_t j = column(box.min().y(), 1); j <= column(box.max().y(), 1); ++j)
    for (std::size_t i = column(box.min().x(), 0); i <= column(box.max().x(), 0); ++i)
      visit(columns_[i + kAcross * j]);
}

void IntersectionVerifier::list(const ComplexMesh& mesh, std::uint32_t t) {
  for_columns(box_in(mesh, t), [t](std::vector<std::uint32_t>& column) { column.push_back(t); });
}

std::size_t IntersectionVerifier::intersections_around(const ComplexMesh& mesh,
                                                       const std::vector<std::uint32_t>& triangles) {
  Eigen::AlignedBox3d all;
  for (const std::uint32_t t : triangles) {
    list(mesh, t);
    all.extend(box_in(mesh, t));
  }
  std::vector<std::uint32_t> near;
  for_columns(all, [&](std::vector<std::uint32_t>& column) {
    if (column.size() > kLong) drop_doubles(column);
    near.insert(near.end(), column.begin(), column.end());
  });
  drop_doubles(near);
  SurfaceMesh around;
  std::vector<std::uint32_t> vertices;
  for (const std::uint32_t t : near) {
    if (!mesh.alive(t) || !box_in(mesh, t).intersects(all)) continue;
    around.triangles.push_back(mesh.triangle(t));
    for (const std::uint32_t v : mesh.triangle(t)) vertices.push_back(v);
  }
  drop_doubles(vertices);
  for (const std::uint32_t v : vertices) around.points.push_back(mesh.point(v));
  for (Triangle& corners : around.triangles)
    for (std::uint32_t& v : corners)
      v = static_cast<std::uint32_t>(std::lower_bound(vertices.begin(), vertices.end(), v) -
                                     vertices.begin());
  return count_self_intersections(around);
}

}  // namespace voxtet::remesh
