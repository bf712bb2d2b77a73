// Ventricles as truncated ellipsoids, after problem 2 of Land et al., "Verification of cardiac mechanics
// software: benchmark problems and solutions for testing active and passive material behaviour", Proceedings
// of the Royal Society A 471 (2015).
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "geometry/topology/adjacency.h"
#include "types/heart_surfaces.h"
#include "types/tet_mesh.h"

namespace voxtet::test {

/// A shell of ellipsoids of revolution about z, cut off at `base_z`, its apex at the lowest z. Half axes are
/// linear in the depth t, 0 on the inner surface and 1 on the outer one; t may go on beyond 1.
struct Ellipsoid {
  double short_in = 7, short_out = 10, long_in = 17, long_out = 20, base_z = 5;  ///< mm
  double base_slope = 0;  ///< how much higher than base_z the base is outside, linear in t

  double half_short(double t) const { return short_in + t * (short_out - short_in); }
  double half_long(double t) const { return long_in + t * (long_out - long_in); }
  /// The angle u from the apex, 0, along the ellipse; `part` of the way to the base, 0 to 1.
  double along(double t, double part) const {
    return part * (std::acos(-(base_z + t * base_slope) / half_long(t)));
  }
  Eigen::Vector3d at(double t, double u, double v) const {
    const double ring = half_short(t) * std::sin(u);
    return {ring * std::cos(v), ring * std::sin(v), -half_long(t) * std::cos(u)};
  }
  /// t of a place, by bisection.
  double depth(const Eigen::Vector3d& p) const {
    double low = -0.5, high = 3;
    for (int i = 0; i < 60; ++i) {
      const double t = (low + high) / 2;
      const double across = p.head<2>().norm() / half_short(t), up = p.z() / half_long(t);
      (across * across + up * up > 1 ? low : high) = t;
    }
    return low;
  }
  /// sin(alpha) e_u + cos(alpha) e_v, with unit vectors along the curves of constant t and v, to the base,
  /// and of constant t and u, counterclockwise seen from the base.
  Eigen::Vector3d fibre(const Eigen::Vector3d& p, double alpha) const {
    const double t = depth(p), v = std::atan2(p.y(), p.x());
    const double u = std::acos(std::clamp(-p.z() / half_long(t), -1.0, 1.0));
    const Eigen::Vector3d radial(std::cos(v), std::sin(v), 0);
    const Eigen::Vector3d along =
        (half_short(t) * std::cos(u) * radial + half_long(t) * std::sin(u) * Eigen::Vector3d::UnitZ())
            .normalized();
    return std::sin(alpha) * along + std::cos(alpha) * Eigen::Vector3d(-std::sin(v), std::cos(v), 0);
  }
};

struct HeartBody {
  TetMesh mesh;
  HeartSurfaces surfaces;
  std::vector<double> part;  ///< by point: 0 at the apex to 1 at the base, in even steps of u
  /// By point: from 0 to 1 through the wall of its ventricle; points of both are the left one's.
  std::vector<double> depth;
  std::vector<bool> free_wall;  ///< by tetrahedron: whether it was built as the right ventricle's free wall

  Eigen::Vector3d centroid(std::size_t tet) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::uint32_t i : mesh.tets[tet]) sum += mesh.points[i] / 4;
    return sum;
  }
};

/// Builds bodies from prisms over one triangulation of the ellipsoid: a disc of rings, ring i with 6 i
/// points. Points of a ring are numbered counterclockwise.
class HeartBuilder {
 public:
  HeartBuilder(const Ellipsoid& ellipsoid, std::uint32_t rings) : ellipsoid_(ellipsoid), rings_(rings) {
    for (std::uint32_t i = 0; i <= rings; ++i)
      for (std::uint32_t j = 0; j < std::max(1U, 6 * i); ++j) {
        ring_.push_back(i);
        angle_.push_back(i == 0 ? 0 : 2 * std::acos(-1) * j / (6 * i));
      }
    for (std::uint32_t i = 1; i <= rings; ++i)
      for (std::uint32_t side = 0; side < 6; ++side)
        for (std::uint32_t j = 0; j < i; ++j) {
          triangles_.push_back({on(i, side * i + j), on(i, side * i + j + 1), on(i - 1, side * (i - 1) + j)});
          if (j + 1 < i)
            triangles_.push_back(
                {on(i, side * i + j + 1), on(i - 1, side * (i - 1) + j + 1), on(i - 1, side * (i - 1) + j)});
        }
  }

  const std::vector<Triangle>& triangles() const { return triangles_; }
  double part(std::uint32_t vertex) const { return static_cast<double>(ring_[vertex]) / rings_; }
  double angle(std::uint32_t vertex) const { return angle_[vertex]; }  ///< 0 to 2 pi

  /// A point at t = t_of(vertex) for each of the wanted vertices of the triangulation; the others get those
  /// of `shared`. `depth` is that of the sheet in its wall.
  template <class DepthOf>
  std::vector<std::uint32_t> add_sheet(const std::vector<bool>& wanted, std::vector<std::uint32_t> shared,
                                       double depth, DepthOf&& t_of) {
    shared.resize(ring_.size());
    for (std::uint32_t vertex = 0; vertex < ring_.size(); ++vertex) {
      if (!wanted[vertex]) continue;
      shared[vertex] = static_cast<std::uint32_t>(body_.mesh.points.size());
      const double t = t_of(vertex);
      // Rounded, because the last bits of sin and cos differ between platforms.
      body_.mesh.points.push_back(
          ellipsoid_.at(t, ellipsoid_.along(t, part(vertex)), angle_[vertex]).unaryExpr([](double x) {
            return std::round(x * 1e6) / 1e6 + 0.0;
          }));
      body_.depth.push_back(depth);
      body_.part.push_back(part(vertex));
    }
    return shared;
  }

  /// The prism over a triangle between two sheets, cut into three tetrahedra; its quadrilaterals are cut from
  /// the lower vertex on the inner sheet to the higher one on the outer sheet.
  void add_prism(Triangle t, const std::vector<std::uint32_t>& in, const std::vector<std::uint32_t>& out,
                 bool free_wall = false) {
    std::sort(t.begin(), t.end());
    const auto [a, b, c] = t;
    add_tet({in[a], in[b], in[c], out[c]});
    add_tet({in[a], in[b], out[b], out[c]});
    add_tet({in[a], out[a], out[b], out[c]});
    body_.free_wall.resize(body_.mesh.tets.size(), free_wall);
  }

  void name(const Triangle& t, const std::vector<std::uint32_t>& sheet, HeartSurface surface) {
    named_[sorted({sheet[t[0]], sheet[t[1]], sheet[t[2]]})] = surface;
  }

  /// Faces that were not named are of the base where all their points are, or of the epicardium.
  HeartBody finish(std::uint32_t apex) {
    TetMesh& mesh = body_.mesh;
    mesh.labels.assign(mesh.tets.size(), 1);
    add_label_faces(mesh);
    for (const Triangle& face : mesh.faces) {
      const auto found = named_.find(sorted(face));
      const bool base = std::all_of(face.begin(), face.end(), [&](auto i) { return body_.part[i] == 1; });
      body_.surfaces.faces.push_back(base                    ? HeartSurface::kBase
                                     : found == named_.end() ? HeartSurface::kEpicardium
                                                             : found->second);
    }
    body_.surfaces.wall.assign(mesh.tets.size(), true);
    body_.surfaces.apex = apex;
    return std::move(body_);
  }

 private:
  static Triangle sorted(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
  }
  std::uint32_t on(std::uint32_t ring, std::uint32_t j) const {
    return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1) + j % (6 * ring);
  }
  /// Without those that are flat because their sheets share points.
  void add_tet(Tet tet) {
    Tet ordered = tet;
    std::sort(ordered.begin(), ordered.end());
    if (std::adjacent_find(ordered.begin(), ordered.end()) != ordered.end()) return;
    const auto& points = body_.mesh.points;
    const Eigen::Vector3d& p = points[tet[0]];
    if ((points[tet[1]] - p).cross(points[tet[2]] - p).dot(points[tet[3]] - p) < 0) std::swap(tet[2], tet[3]);
    body_.mesh.tets.push_back(tet);
  }

  Ellipsoid ellipsoid_;
  std::uint32_t rings_;
  std::vector<std::uint32_t> ring_;
  std::vector<double> angle_;
  std::vector<Triangle> triangles_;
  HeartBody body_;
  std::map<Triangle, HeartSurface> named_;
};

/// A single ventricle in so many layers, with so many rings from apex to base.
inline HeartBody left_ventricle(std::uint32_t layers, std::uint32_t rings, const Ellipsoid& ellipsoid = {}) {
  HeartBuilder build(ellipsoid, rings);
  const std::vector<bool> all(1 + 3 * rings * (rings + 1), true);
  std::vector<std::vector<std::uint32_t>> sheets;
  for (std::uint32_t k = 0; k <= layers; ++k)
    sheets.push_back(
        build.add_sheet(all, {}, 1.0 * k / layers, [&](std::uint32_t) { return 1.0 * k / layers; }));
  for (const Triangle& t : build.triangles()) {
    for (std::uint32_t k = 0; k < layers; ++k) build.add_prism(t, sheets[k], sheets[k + 1]);
    build.name(t, sheets.front(), HeartSurface::kLvEndocardium);
  }
  return build.finish(sheets.back()[0]);
}

/// Two ventricles: the right one's free wall, 0.6 of the left wall's thickness, bulges from the left one on
/// the side of +x, above a quarter of the way to the base.
inline HeartBody two_ventricles(std::uint32_t layers, std::uint32_t rings) {
  HeartBuilder build({}, rings);
  const std::vector<bool> all(1 + 3 * rings * (rings + 1), true);
  std::vector<std::vector<std::uint32_t>> sheets;
  for (std::uint32_t k = 0; k <= layers; ++k)
    sheets.push_back(
        build.add_sheet(all, {}, 1.0 * k / layers, [&](std::uint32_t) { return 1.0 * k / layers; }));

  // How wide the right cavity is, in thicknesses of the wall, and negative beyond its rim.
  const auto gap = [&](std::uint32_t vertex) {
    const double side = std::cos(build.angle(vertex)) - 0.2, up = build.part(vertex) - 0.25;
    return 4 * std::min(side, 1.5 * up);
  };
  constexpr double kRim = -0.75, kFreeWall = 0.6;
  std::vector<bool> wide, near;
  for (std::uint32_t vertex = 0; vertex < all.size(); ++vertex) {
    wide.push_back(gap(vertex) > 0.2);
    near.push_back(gap(vertex) > kRim);
  }
  std::vector<std::vector<std::uint32_t>> free_wall{
      build.add_sheet(wide, sheets.back(), 0, [&](std::uint32_t v) { return 1 + gap(v); })};
  for (std::uint32_t k = 1; k <= layers; ++k)
    free_wall.push_back(build.add_sheet(near, {}, 1.0 * k / layers, [&](std::uint32_t v) {
      return 1 + (wide[v] ? gap(v) : 0) + kFreeWall * k / layers;
    }));

  for (const Triangle& t : build.triangles()) {
    for (std::uint32_t k = 0; k < layers; ++k) build.add_prism(t, sheets[k], sheets[k + 1]);
    build.name(t, sheets.front(), HeartSurface::kLvEndocardium);
    if (!std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return near[v]; })) continue;
    for (std::uint32_t k = 0; k < layers; ++k) build.add_prism(t, free_wall[k], free_wall[k + 1], true);
    if (std::none_of(t.begin(), t.end(), [&](std::uint32_t v) { return wide[v]; })) continue;
    build.name(t, sheets.back(), HeartSurface::kRvSeptum);
    build.name(t, free_wall.front(), HeartSurface::kRvEndocardium);
  }
  HeartBody body = build.finish(sheets.back()[0]);
  body.surfaces.right = true;
  return body;
}

}  // namespace voxtet::test
