#include "walls/count_layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "support/slab_wall.h"

namespace voxtet {
namespace {

using test::kSlabThickness;
using test::slab;

LayerCount count(const TetMesh& mesh, std::uint32_t target) {
  const WallField field = test::slab_wall();
  const std::vector<LayeredWall> walls{{field, target}};
  return count_layers(mesh, walls).counts.at(0);
}

double area(const LayerShares& shares) {
  return std::accumulate(shares.area_mm2.begin(), shares.area_mm2.end(), 0.0);
}

TEST(CountLayers, BothWaysFindTheLayersThatAreThere) {
  for (const std::uint32_t layers : {1U, 2U, 3U, 4U}) {
    const LayerCount found = count(slab(12, static_cast<int>(layers)), layers);
    EXPECT_EQ(found.target_layers, layers);
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
  EXPECT_LT((few.places[0].centre_mm - Eigen::Vector3d(10, 10, kSlabThickness)).norm(), 1);
}

TEST(CountLayers, TellsEachTetrahedronItsLayerAndHowManyThereAre) {
  for (const std::uint32_t layers : {1U, 2U, 3U, 4U}) {
    const TetMesh mesh = slab(12, static_cast<int>(layers));
    const WallField field = test::slab_wall();
    const FoundLayers found = count_layers(mesh, std::vector<LayeredWall>{{field, layers}});
    const std::vector<float>& layer = find_field(found.fields, "layer")->values;
    const std::vector<float>& across = find_field(found.fields, "layers_across")->values;
    ASSERT_EQ(layer.size(), mesh.tets.size());
    ASSERT_EQ(across.size(), mesh.tets.size());
    std::size_t counted = 0;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      double lowest = kSlabThickness;
      for (const std::uint32_t v : mesh.tets[t]) lowest = std::min(lowest, mesh.points[v].z());
      EXPECT_EQ(layer[t], 1 + std::round(lowest * layers / kSlabThickness)) << layers;
      if (std::isnan(across[t])) continue;
      EXPECT_EQ(across[t], layers);
      ++counted;
    }
    EXPECT_GT(counted, mesh.tets.size() / 4);
    EXPECT_LT(counted, mesh.tets.size());
  }
}

TEST(CountLayers, MapsNothingOutsideOfWalls) {
  TetMesh mesh = slab(4, 2);
  const WallField field = test::slab_wall();
  EXPECT_TRUE(count_layers(mesh, {}).fields.empty());
  for (Eigen::Vector3d& p : mesh.points) p.x() += 500;
  for (const Field& found : count_layers(mesh, std::vector<LayeredWall>{{field, 2}}).fields) {
    EXPECT_EQ(found.values.size(), mesh.tets.size());
    EXPECT_TRUE(
        std::all_of(found.values.begin(), found.values.end(), [](float value) { return std::isnan(value); }));
  }
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
