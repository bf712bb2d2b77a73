// What every tetrahedral mesh must fulfil; each test that makes one ends here.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet::test {

struct TetFace {
  std::array<std::uint32_t, 3> corners;  ///< ascending
  std::uint32_t tet = 0;
  bool even = true;  ///< the outward normal follows the ascending corners
};

inline TetFace make_face(std::array<std::uint32_t, 3> c, std::uint32_t tet) {
  bool even = true;
  for (const auto& [i, j] : {std::pair{0, 1}, std::pair{1, 2}, std::pair{0, 1}})
    if (c[i] > c[j]) {
      std::swap(c[i], c[j]);
      even = !even;
    }
  return {c, tet, even};
}

/// All faces of all tets, equal ones side by side.
inline std::vector<TetFace> sorted_faces(const TetMesh& mesh) {
  std::vector<TetFace> faces;
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
    const auto [a, b, c, d] = mesh.tets[t];
    for (const auto& f : {std::array{b, c, d}, std::array{a, d, c}, std::array{a, b, d}, std::array{a, c, b}})
      faces.push_back(make_face(f, t));
  }
  std::sort(faces.begin(), faces.end(), [](const TetFace& p, const TetFace& q) {
    return p.corners != q.corners ? p.corners < q.corners : p.tet < q.tet;
  });
  return faces;
}

inline double tet_volume(const TetMesh& mesh, std::uint32_t t) {
  const auto [a, b, c, d] = mesh.tets[t];
  const Eigen::Vector3d& p = mesh.points[a];
  return (mesh.points[b] - p).dot((mesh.points[c] - p).cross(mesh.points[d] - p)) / 6;
}

/// Positive tets with a label; every point used; no two points alike; no two tets alike.
inline void check_tets_and_points(const TetMesh& mesh) {
  ASSERT_EQ(mesh.labels.size(), mesh.tets.size());
  ASSERT_FALSE(mesh.tets.empty());
  std::vector<bool> used(mesh.points.size(), false);
  std::vector<Tet> sorted = mesh.tets;
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
    for (const std::uint32_t v : mesh.tets[t]) {
      ASSERT_LT(v, mesh.points.size());
      used[v] = true;
    }
    ASSERT_GT(tet_volume(mesh, t), 0) << "tet " << t;
    ASSERT_NE(mesh.labels[t], kBackground) << "tet " << t;
    std::sort(sorted[t].begin(), sorted[t].end());
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0) << "unused points";
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(std::adjacent_find(sorted.begin(), sorted.end()), sorted.end()) << "two tets alike";
  std::vector<std::array<double, 3>> places;
  for (const Eigen::Vector3d& p : mesh.points) {
    ASSERT_TRUE(p.allFinite());
    places.push_back({p.x(), p.y(), p.z()});
  }
  std::sort(places.begin(), places.end());
  EXPECT_EQ(std::adjacent_find(places.begin(), places.end()), places.end()) << "two points alike";
}

/// Each face has one or two tets, on opposite sides; `mesh.faces` are exactly those between different labels
/// or beside background, with the sides their tets have.
inline void check_faces(const TetMesh& mesh) {
  ASSERT_EQ(mesh.face_sides.size(), mesh.faces.size());
  std::map<std::array<std::uint32_t, 3>, std::array<Label, 2>>
      boundary;  // {behind the ascending order, in front}
  const std::vector<TetFace> faces = sorted_faces(mesh);
  for (std::size_t f = 0; f < faces.size();) {
    std::size_t end = f + 1;
    while (end < faces.size() && faces[end].corners == faces[f].corners) ++end;
    ASSERT_LE(end - f, 2U) << "a face of more than two tets";
    std::array<Label, 2> sides{kBackground, kBackground};
    for (std::size_t i = f; i < end; ++i) sides[faces[i].even ? 0 : 1] = mesh.labels[faces[i].tet];
    if (end - f == 2) {
      ASSERT_NE(faces[f].even, faces[f + 1].even) << "two tets on one side of a face";
    }
    if (sides[0] != sides[1]) boundary[faces[f].corners] = sides;
    f = end;
  }
  EXPECT_EQ(boundary.size(), mesh.faces.size());
  for (std::size_t t = 0; t < mesh.faces.size(); ++t) {
    const TetFace face = make_face(mesh.faces[t], 0);
    const auto found = boundary.find(face.corners);
    ASSERT_NE(found, boundary.end()) << "face " << t << " is no boundary";
    const std::array<Label, 2> sides =
        face.even ? found->second : std::array<Label, 2>{found->second[1], found->second[0]};
    ASSERT_EQ(sides, mesh.face_sides[t]) << "face " << t;
    ASSERT_GT(sides[0], sides[1]) << "face " << t;
    boundary.erase(found);
  }
  EXPECT_TRUE(boundary.empty()) << boundary.size() << " boundary faces are not listed";
}

/// Each label's volume equals that enclosed by its faces, to 1e-9.
inline void check_label_volumes(const TetMesh& mesh) {
  std::map<Label, double> filled, enclosed;
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) filled[mesh.labels[t]] += tet_volume(mesh, t);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    // Relative to a point of the mesh and by the face's own edges: exact enough for specks far from 0.
    const auto [a, b, c] = mesh.faces[f];
    const Eigen::Vector3d &p = mesh.points[a], ab = mesh.points[b] - p, ac = mesh.points[c] - p;
    const double cone = (p - mesh.points[0]).dot(ab.cross(ac)) / 6;
    enclosed[mesh.face_sides[f][0]] += cone;
    enclosed[mesh.face_sides[f][1]] -= cone;
  }
  for (const auto& [label, volume] : filled)
    EXPECT_NEAR(enclosed[label] / volume, 1, 1e-9) << "label " << label;
}

inline void check_tets(const TetMesh& mesh) {
  check_tets_and_points(mesh);
  check_faces(mesh);
  check_label_volumes(mesh);
}

/// Also: the mesh's boundary is this surface, its points first and unmoved.
inline void check_tets(const TetMesh& mesh, const SurfaceMesh& surface) {
  check_tets(mesh);
  ASSERT_GE(mesh.points.size(), surface.points.size());
  EXPECT_TRUE(std::equal(surface.points.begin(), surface.points.end(), mesh.points.begin()));
  const auto key = [](const std::vector<Triangle>& triangles, const std::vector<Sides>& sides) {
    std::vector<std::array<std::uint32_t, 5>> all;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      Triangle c = triangles[t];
      std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
      all.push_back({c[0], c[1], c[2], sides[t][0], sides[t][1]});
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  EXPECT_EQ(key(mesh.faces, mesh.face_sides), key(surface.triangles, surface.sides));
}

/// Smallest dihedral angle of the mesh, degrees.
inline double smallest_dihedral_deg(const TetMesh& mesh) {
  double largest_cosine = -1;
  for (const Tet& tet : mesh.tets) {
    std::array<Eigen::Vector3d, 4> normal;
    const auto [a, b, c, d] = tet;
    const std::array<std::array<std::uint32_t, 3>, 4> faces{{{b, c, d}, {a, d, c}, {a, b, d}, {a, c, b}}};
    for (std::size_t f = 0; f < 4; ++f) {
      const Eigen::Vector3d& p = mesh.points[faces[f][0]];
      normal[f] = (mesh.points[faces[f][1]] - p).cross(mesh.points[faces[f][2]] - p).normalized();
    }
    for (std::size_t f = 0; f < 4; ++f)
      for (std::size_t g = f + 1; g < 4; ++g)
        largest_cosine = std::max(largest_cosine, -normal[f].dot(normal[g]));
  }
  return std::acos(std::clamp(largest_cosine, -1.0, 1.0)) * 57.29577951308232;
}

}  // namespace voxtet::test
