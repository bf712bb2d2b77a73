#include "geometry/grid/rasterise.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "support/labelled_mesh.h"

namespace voxtet {
namespace {

using Eigen::Vector3d;

TEST(Rasterise, GivesFlatTetsNoCentre) {
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 4, 0}};
  mesh.tets = {{0, 1, 2, 3}};
  mesh.labels = {1};
  LabelVolume grid;
  grid.size = {5, 5, 5};
  grid.labels.assign(grid.voxel_count(), 0);
  const std::vector<Label> labels = rasterise(mesh, mesh.labels, grid);
  EXPECT_EQ(std::count(labels.begin(), labels.end(), Label{1}), 0);
}

TEST(Rasterise, CountsEveryVoxelCentreOnceOnObliqueGrids) {
  const TetMesh mesh = test::kuhn_cube(4);
  LabelVolume grid;
  grid.size = {40, 40, 40};
  grid.labels.assign(grid.voxel_count(), 0);
  const double c = 0.8, s = 0.6;
  grid.index_to_mm.topLeftCorner<3, 3>() << -0.5 * c, 0.5 * s, 0, 0.5 * s, 0.5 * c, 0, 0, 0, 0.5;
  grid.index_to_mm.topRightCorner<3, 1>() = Vector3d(-5, 20, 3) - grid.linear() * Vector3d(19.5, 19.5, 19.5);
  const std::vector<Label> labels = rasterise(mesh, mesh.labels, grid);
  double covered = 0, volume = 0;
  for (const Label label : labels) covered += label != 0 ? grid.voxel_mm3() : 0;
  for (const Tet& t : mesh.tets)
    volume += (mesh.points[t[1]] - mesh.points[t[0]])
                  .dot((mesh.points[t[2]] - mesh.points[t[0]]).cross(mesh.points[t[3]] - mesh.points[t[0]])) /
              6;
  EXPECT_NEAR(covered / volume, 1, 0.01);
}

}  // namespace
}  // namespace voxtet
