// Meshes of label volumes for the tests of named surfaces.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "base/union_find.h"
#include "geometry/topology/adjacency.h"
#include "io/volume/write_volume.h"
#include "pipeline/session.h"
#include "types/heart_surfaces.h"

namespace voxtet::test {

/// As the pipeline fills them; edges of about `edge_mm`.
inline TetMesh mesh_image(const LabelVolume& image, const std::vector<Label>& labels, double edge_mm,
                          const std::vector<LabelGroup>& merge = {}) {
  Session session;
  const Bytes bytes = write_nifti(image, false).value();
  EXPECT_TRUE(session.load_volume({"image.nii", bytes, {}}).ok());
  Recipe recipe = session.recipe();
  recipe.labels = labels;
  recipe.merge = merge;
  recipe.sizing.edge_mm = edge_mm;
  EXPECT_TRUE(session.set_recipe(recipe).ok());
  RunContext ctx;
  const Status done = session.run(Stage::kTetra, ctx);
  EXPECT_TRUE(done.ok()) << (done.ok() ? "" : done.error().message);
  return done.ok() ? *session.mesh() : TetMesh{};
}

/// Each voxel of a label that is not background as six tetrahedra around its diagonal.
inline TetMesh voxel_mesh(const LabelVolume& image, const std::vector<Label>& labels) {
  TetMesh mesh;
  const std::array<int, 3> n{image.size[0] + 1, image.size[1] + 1, image.size[2] + 1};
  std::vector<std::uint32_t> number(static_cast<std::size_t>(n[0] * n[1] * n[2]), 0xffffffffU);
  const auto point = [&](const std::array<int, 3>& at) {
    std::uint32_t& found = number[static_cast<std::size_t>(at[0] + n[0] * (at[1] + n[1] * at[2]))];
    if (found == 0xffffffffU) {
      found = static_cast<std::uint32_t>(mesh.points.size());
      mesh.points.push_back(image.to_mm({at[0] - 0.5, at[1] - 0.5, at[2] - 0.5}));
    }
    return found;
  };
  image.visit([&](int i, int j, int k, std::size_t voxel) {
    const Label label = image.labels[voxel];
    if (std::find(labels.begin(), labels.end(), label) == labels.end()) return;
    std::array<std::size_t, 3> axes{0, 1, 2};
    do {
      std::array<int, 3> at{i, j, k};
      Tet tet{point(at), 0, 0, 0};
      for (std::size_t s = 0; s < 3; ++s) {
        ++at[axes[s]];
        tet[s + 1] = point(at);
      }
      const Eigen::Vector3d& p = mesh.points[tet[0]];
      if ((mesh.points[tet[1]] - p).cross(mesh.points[tet[2]] - p).dot(mesh.points[tet[3]] - p) < 0)
        std::swap(tet[2], tet[3]);
      mesh.tets.push_back(tet);
      mesh.labels.push_back(label);
    } while (std::next_permutation(axes.begin(), axes.end()));
  });
  add_label_faces(mesh);
  return mesh;
}

inline Eigen::Vector3d centre_of(const TetMesh& mesh, std::size_t face) {
  const auto& [a, b, c] = mesh.faces[face];
  return (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3;
}

/// Half the cross product: as long as the face is large.
inline Eigen::Vector3d area_vector(const TetMesh& mesh, std::size_t face) {
  const auto& [a, b, c] = mesh.faces[face];
  return (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]) / 2;
}

inline double area_of(const TetMesh& mesh, const HeartSurfaces& found, HeartSurface surface) {
  double area = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (found.faces[f] == surface) area += area_vector(mesh, f).norm();
  return area;
}

/// The connected parts, over edges, of the faces of a surface.
inline int count_parts(const TetMesh& mesh, const HeartSurfaces& found, HeartSurface surface) {
  UnionFind joined(mesh.faces.size());
  std::vector<std::pair<Edge, std::uint32_t>> sides;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
    for (std::size_t i = 0; i < 3 && found.faces[f] == surface; ++i) {
      const auto [low, high] = std::minmax(mesh.faces[f][i], mesh.faces[f][(i + 1) % 3]);
      sides.push_back({{low, high}, f});
    }
  std::sort(sides.begin(), sides.end());
  for (std::size_t s = 1; s < sides.size(); ++s)
    if (sides[s].first == sides[s - 1].first) joined.join(sides[s].second, sides[s - 1].second);
  int parts = 0;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
    parts += found.faces[f] == surface && joined.find(f) == f;
  return parts;
}

}  // namespace voxtet::test
