#include "quality/count_layers.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/adjacency.h"

namespace voxtet {
namespace {

constexpr double kThickness = 6;

/// A slab of `nx` x `nx` x `layers` bricks, 0 to 20 mm wide and `kThickness` high, each brick cut into the
/// six tetrahedra around its diagonal. Edges never go through a layer of bricks.
TetMesh slab(int nx, int layers) {
  TetMesh mesh;
  const auto point = [&](int i, int j, int k) {
    return static_cast<std::uint32_t>(i + (nx + 1) * (j + (nx + 1) * k));
  };
  for (int k = 0; k <= layers; ++k)
    for (int j = 0; j <= nx; ++j)
      for (int i = 0; i <= nx; ++i)
        mesh.points.emplace_back(20.0 * i / nx, 20.0 * j / nx, kThickness * k / layers);
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < nx; ++j)
      for (int i = 0; i < nx; ++i) {
        std::array<int, 3> axes{0, 1, 2};
        do {
          std::array<int, 3> at{i, j, k};
          Tet tet{point(i, j, k), 0, 0, 0};
          for (std::size_t s = 0; s < 3; ++s) {
            ++at[static_cast<std::size_t>(axes[s])];
            tet[s + 1] = point(at[0], at[1], at[2]);
          }
          const Eigen::Vector3d& p = mesh.points[tet[0]];
          if ((mesh.points[tet[1]] - p).cross(mesh.points[tet[2]] - p).dot(mesh.points[tet[3]] - p) < 0)
            std::swap(tet[2], tet[3]);
          mesh.tets.push_back(tet);
        } while (std::next_permutation(axes.begin(), axes.end()));
      }
  mesh.labels.assign(mesh.tets.size(), 1);
  add_label_faces(mesh);
  return mesh;
}

/// The wall of the slab: the potential rises with z.
WallField wall() {
  WallField field;
  field.wall = {1};
  field.size = {25, 25, 11};
  field.index_to_mm.topRightCorner<3, 1>() << -2, -2, -2;
  field.mm_to_index = field.index_to_mm.inverse();
  for (int k = 0; k < 11; ++k)
    for (int n = 0; n < 25 * 25; ++n) {
      field.thickness_mm.push_back(kThickness);
      field.potential.push_back(static_cast<float>((k - 2) / kThickness));
      field.in_wall.push_back(k >= 2 && k <= 8);
    }
  return field;
}

LayerCount count(const TetMesh& mesh, std::uint32_t wished) {
  const WallField field = wall();
  const std::vector<LayeredWall> walls{{field, wished}};
  return count_layers(mesh, walls).counts.at(0);
}

double area(const LayerShares& shares) {
  return std::accumulate(shares.area_mm2.begin(), shares.area_mm2.end(), 0.0);
}

TEST(CountLayers, BothWaysFindTheLayersThatAreThere) {
  for (const std::uint32_t layers : {1U, 2U, 3U, 4U}) {
    const LayerCount found = count(slab(12, static_cast<int>(layers)), layers);
    EXPECT_EQ(found.wished, layers);
    EXPECT_DOUBLE_EQ(found.by_edges.exact, 1) << layers;
    EXPECT_DOUBLE_EQ(found.by_edges.at_least, 1) << layers;
    EXPECT_DOUBLE_EQ(found.by_lines.exact, 1) << layers;
    ASSERT_EQ(found.by_edges.area_mm2.size(), layers + 1);
    // Two edges off the rim there is a good half of the slab left, along lines a little less.
    EXPECT_GT(area(found.by_edges), 100) << layers;
    EXPECT_LT(area(found.by_edges), 400) << layers;
    EXPECT_GT(area(found.by_lines), 80) << layers;
  }
}

TEST(CountLayers, TooFewAndTooManyAreNotExact) {
  const LayerCount few = count(slab(12, 2), 3);
  EXPECT_DOUBLE_EQ(few.by_edges.exact, 0);
  EXPECT_DOUBLE_EQ(few.by_edges.at_least, 0);
  // A brick's tetrahedra have their centroids at three heights: two layers of them fill no eight sheets.
  EXPECT_DOUBLE_EQ(count(slab(12, 2), 8).by_lines.at_least, 0);
  const LayerCount many = count(slab(12, 4), 2);
  EXPECT_DOUBLE_EQ(many.by_edges.exact, 0);
  EXPECT_DOUBLE_EQ(many.by_edges.at_least, 1);
}

TEST(CountLayers, SaysWhereTheNumberIsAnother) {
  EXPECT_TRUE(count(slab(12, 2), 2).places.empty());
  const LayerCount few = count(slab(12, 2), 3);
  ASSERT_EQ(few.places.size(), 1U);
  EXPECT_NEAR(few.places[0].area_mm2, area(few.by_edges), 1e-9);
  EXPECT_EQ(few.places[0].fewest, 2U);
  EXPECT_EQ(few.places[0].most, 2U);
  EXPECT_LT((few.places[0].centre_mm - Eigen::Vector3d(10, 10, kThickness)).norm(), 1);
}

TEST(CountLayers, TellsEachTetrahedronItsLayerAndHowManyThereAre) {
  for (const std::uint32_t layers : {1U, 2U, 3U, 4U}) {
    const TetMesh mesh = slab(12, static_cast<int>(layers));
    const WallField field = wall();
    const LayerMap map = count_layers(mesh, std::vector<LayeredWall>{{field, layers}}).map;
    ASSERT_EQ(map.layer.size(), mesh.tets.size());
    ASSERT_EQ(map.layers_across.size(), mesh.tets.size());
    std::size_t counted = 0;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      double lowest = kThickness;
      for (const std::uint32_t v : mesh.tets[t]) lowest = std::min(lowest, mesh.points[v].z());
      EXPECT_EQ(map.layer[t], 1 + std::round(lowest * layers / kThickness)) << layers;
      if (map.layers_across[t] < 0) continue;
      EXPECT_EQ(map.layers_across[t], layers);
      ++counted;
    }
    EXPECT_GT(counted, mesh.tets.size() / 4);
    EXPECT_LT(counted, mesh.tets.size());
  }
}

TEST(CountLayers, MapsNothingOutsideOfWalls) {
  TetMesh mesh = slab(4, 2);
  const WallField field = wall();
  const std::vector<float> none(mesh.tets.size(), -1);
  EXPECT_TRUE(count_layers(mesh, {}).map.layer.empty());
  for (Eigen::Vector3d& p : mesh.points) p.x() += 500;
  const LayerMap map = count_layers(mesh, std::vector<LayeredWall>{{field, 2}}).map;
  EXPECT_EQ(map.layer, none);
  EXPECT_EQ(map.layers_across, none);
}

TEST(CountLayers, CountsNothingWhereTheMeshHasNoSuchWall) {
  TetMesh mesh = slab(4, 1);
  for (Eigen::Vector3d& p : mesh.points) p.x() += 500;
  const LayerCount found = count(mesh, 1);
  EXPECT_EQ(area(found.by_edges), 0);
  EXPECT_EQ(area(found.by_lines), 0);
  EXPECT_EQ(found.by_edges.exact, 0);
}

}  // namespace
}  // namespace voxtet
