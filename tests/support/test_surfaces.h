// Small closed surfaces made by hand, for stages that take a SurfaceMesh.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "types/sizing_field.h"
#include "types/surface_mesh.h"

namespace voxtet::test {

/// Adds the triangles of `other`, whose points stay apart from those already there.
inline void append(SurfaceMesh& surface, const SurfaceMesh& other) {
  const std::uint32_t shift = static_cast<std::uint32_t>(surface.points.size());
  surface.points.insert(surface.points.end(), other.points.begin(), other.points.end());
  for (const Triangle& t : other.triangles)
    surface.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  surface.sides.insert(surface.sides.end(), other.sides.begin(), other.sides.end());
}

/// A sphere between two labels: an icosahedron with every triangle cut in four `levels` times. Edges are
/// about 1.13 radius / 2^levels. Only + - * / and sqrt: the same points on every platform.
inline SurfaceMesh sphere(const Eigen::Vector3d& centre, double radius, int levels, Label inside,
                          Label outside) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  SurfaceMesh s;
  s.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
              {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  s.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                 {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                 {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (Eigen::Vector3d& p : s.points) p /= p.norm();
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, added] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(s.points.size()));
      if (added) {
        const Eigen::Vector3d sum = s.points[a] + s.points[b];
        s.points.push_back(sum / sum.norm());
      }
      return found->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : s.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    s.triangles = std::move(finer);
  }
  for (Eigen::Vector3d& p : s.points) p = centre + radius * p;
  s.sides.assign(s.triangles.size(), {std::max(inside, outside), std::min(inside, outside)});
  if (inside < outside)
    for (Triangle& t : s.triangles) std::swap(t[1], t[2]);
  return s;
}

/// The boundaries between cubic cells of different labels, each square cut in two. Cells outside are
/// background.
inline SurfaceMesh cells(const std::array<int, 3>& size, double spacing,
                         const std::function<Label(int, int, int)>& label) {
  SurfaceMesh s;
  std::map<std::array<int, 3>, std::uint32_t> ids;
  const auto at = [&](const std::array<int, 3>& c) {
    for (int d = 0; d < 3; ++d)
      if (c[d] < 0 || c[d] >= size[d]) return kBackground;
    return label(c[0], c[1], c[2]);
  };
  const auto id = [&](const std::array<int, 3>& corner) {
    const auto [found, added] = ids.try_emplace(corner, static_cast<std::uint32_t>(s.points.size()));
    if (added) s.points.push_back(Eigen::Vector3d(corner[0], corner[1], corner[2]) * spacing);
    return found->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int k = -1; k < size[2]; ++k)
      for (int j = -1; j < size[1]; ++j)
        for (int i = -1; i < size[0]; ++i) {
          std::array<int, 3> cell{i, j, k}, corner{i, j, k};
          const Label below = at(cell);
          ++cell[axis];
          const Label above = at(cell);
          if (below == above) continue;
          ++corner[axis];
          std::array<int, 3> cu = corner, cv = corner, cuv = corner;
          ++cu[u], ++cuv[u], ++cv[v], ++cuv[v];
          const std::uint32_t a = id(corner), b = id(cu), c = id(cuv), d = id(cv);
          if (below > above)
            s.triangles.insert(s.triangles.end(), {{a, b, c}, {a, c, d}});
          else
            s.triangles.insert(s.triangles.end(), {{a, c, b}, {a, d, c}});
          s.sides.insert(s.sides.end(), 2, {std::max(below, above), std::min(below, above)});
        }
  }
  return s;
}

/// A torus around z, centre line radius `ring`, tube radius `tube`.
inline SurfaceMesh torus(double ring, double tube, int around, int across, Label inside) {
  SurfaceMesh s;
  const auto id = [&](int i, int j) {
    return static_cast<std::uint32_t>((i % around) * across + j % across);
  };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double p = 6.283185307179586 * i / around, q = 6.283185307179586 * j / across;
      const double r = ring + tube * std::cos(q);
      s.points.emplace_back(r * std::cos(p), r * std::sin(p), tube * std::sin(q));
      s.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      s.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  s.sides.assign(s.triangles.size(), {inside, kBackground});
  return s;
}

/// A size sampled at grid points `spacing` apart, from `low` to at least `high`.
inline SizingField sampled_sizing(const Eigen::Vector3d& low, const Eigen::Vector3d& high, double spacing,
                                  const std::function<double(const Eigen::Vector3d&)>& size) {
  SizingField field;
  for (int d = 0; d < 3; ++d) field.size[d] = static_cast<int>(std::ceil((high[d] - low[d]) / spacing)) + 1;
  field.index_to_mm.topLeftCorner<3, 3>() *= spacing;
  field.index_to_mm.topRightCorner<3, 1>() = low;
  field.mm_to_index.topLeftCorner<3, 3>() /= spacing;
  field.mm_to_index.topRightCorner<3, 1>() = -low / spacing;
  for (int k = 0; k < field.size[2]; ++k)
    for (int j = 0; j < field.size[1]; ++j)
      for (int i = 0; i < field.size[0]; ++i)
        field.h_mm.push_back(static_cast<float>(size(low + spacing * Eigen::Vector3d(i, j, k))));
  return field;
}

inline SizingField uniform_sizing(double h) {
  return sampled_sizing({0, 0, 0}, {1, 1, 1}, 1, [h](const Eigen::Vector3d&) { return h; });
}

/// A tetrahedron of label 2 on one of label 1. With an apex below 0 the upper one is inside out and overlaps
/// the lower one, though no triangles cross.
inline SurfaceMesh stacked_tetrahedra(double apex_z) {
  return {{{4, 0, 0}, {-2, 4, 0}, {-2, -4, 0}, {0, 0, apex_z}, {0, 0, -9}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}},
          {{2, 1}, {2, 0}, {2, 0}, {2, 0}, {1, 0}, {1, 0}, {1, 0}}};
}

}  // namespace voxtet::test
