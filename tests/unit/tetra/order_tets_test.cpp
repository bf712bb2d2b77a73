#include "tetra/fill/order_tets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <utility>

namespace voxtet::tetra {
namespace {

using Eigen::Vector3d;

/// Tets of neighbouring points of a grid, all of it shuffled but for the first points.
TetMesh shuffled_mesh(int n, std::size_t fixed) {
  std::mt19937 random(5);
  std::vector<std::array<int, 3>> cells;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) cells.push_back({i, j, k});
  std::shuffle(cells.begin(), cells.end(), random);
  TetMesh mesh;
  std::vector<std::uint32_t> number(cells.size());
  const auto at = [&](int i, int j, int k) -> std::uint32_t& {
    return number[static_cast<std::size_t>(i + n * (j + n * k))];
  };
  for (const auto& [i, j, k] : cells) {
    at(i, j, k) = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.emplace_back(i, j, k);
  }
  for (const auto& [i, j, k] : cells) {
    if (i + 1 == n || j + 1 == n || k + 1 == n) continue;
    mesh.tets.push_back({at(i, j, k), at(i + 1, j, k), at(i, j + 1, k), at(i, j, k + 1)});
    mesh.labels.push_back(static_cast<Label>(1 + (i + j + k) % 3));
  }
  for (std::uint32_t v = 0; v + 2 < fixed; ++v) {
    mesh.faces.push_back({v, v + 1, v + 2});
    mesh.face_sides.push_back({1, 0});
  }
  return mesh;
}

/// What does not depend on the order: the corners' places and the label of each tet.
std::set<std::pair<std::vector<double>, Label>> content(const TetMesh& mesh) {
  std::set<std::pair<std::vector<double>, Label>> tets;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    std::vector<double> places;
    for (const std::uint32_t v : mesh.tets[t])
      places.insert(places.end(), mesh.points[v].begin(), mesh.points[v].end());
    tets.insert({places, mesh.labels[t]});
  }
  return tets;
}

/// Mean distance of the first corners of tets that follow each other.
double mean_way(const TetMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 1; t < mesh.tets.size(); ++t)
    sum += (mesh.points[mesh.tets[t][0]] - mesh.points[mesh.tets[t - 1][0]]).norm();
  return sum / static_cast<double>(mesh.tets.size());
}

TEST(OrderTets, KeepsTheMeshAndBringsNeighboursTogether) {
  constexpr std::size_t kFixed = 200;
  const TetMesh before = shuffled_mesh(12, kFixed);
  TetMesh mesh = before;
  order_along_curve(mesh, kFixed);
  EXPECT_EQ(content(mesh), content(before));
  EXPECT_TRUE(std::equal(before.points.begin(), before.points.begin() + kFixed, mesh.points.begin()));
  EXPECT_EQ(mesh.faces, before.faces);
  EXPECT_EQ(mesh.face_sides, before.face_sides);
  EXPECT_GT(mean_way(before), 6);
  EXPECT_LT(mean_way(mesh), 2);
  double way = 0;
  for (std::size_t v = kFixed + 1; v < mesh.points.size(); ++v)
    way += (mesh.points[v] - mesh.points[v - 1]).norm();
  EXPECT_LT(way / static_cast<double>(mesh.points.size()), 2);
}

TEST(OrderTets, TakesEmptyMeshesAndThoseWithoutFreePoints) {
  TetMesh empty;
  order_along_curve(empty, 0);
  EXPECT_TRUE(empty.tets.empty());
  const TetMesh before = shuffled_mesh(3, 0);
  TetMesh mesh = before;
  order_along_curve(mesh, mesh.points.size());
  EXPECT_EQ(mesh.points, before.points);
  EXPECT_EQ(content(mesh), content(before));
}

}  // namespace
}  // namespace voxtet::tetra
