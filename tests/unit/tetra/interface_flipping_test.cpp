// Flat tets on an interface that go over to the other side.
#include "tetra/interfaces/interface_flipping.h"

#include <gtest/gtest.h>

#include "geometry/topology/label_topology.h"
#include "support/check_tets.h"
#include "support/labelled_mesh.h"
#include "support/test_surfaces.h"

namespace voxtet::tetra {
namespace {

using Eigen::Vector3d;

constexpr std::uint32_t kP = 0, kQ = 1, kA = 2, kB = 3, kC = 4, kD = 5;
constexpr double kEdge = 2;

/// Makes all tets positive and lists the interfaces.
void complete(TetMesh& mesh) {
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t)
    if (test::tet_volume(mesh, t) < 0) std::swap(mesh.tets[t][2], mesh.tets[t][3]);
  mesh.faces.clear();
  mesh.face_sides.clear();
  test::add_faces(mesh);
}

/// Three tets of label 1 around the edge pq, of which the one of a and b is flat, 0.1 high; with a lid, two
/// of label 2 above it.
TetMesh flat_on_top(bool lid) {
  TetMesh mesh;
  mesh.points = {{-1, 0, 0}, {1, 0, 0}, {0, 1, 0.1}, {0, -1, 0.1}, {0, 0, -1}};
  mesh.tets = {{kP, kQ, kA, kB}, {kP, kQ, kB, kC}, {kP, kQ, kC, kA}};
  mesh.labels = {1, 1, 1};
  if (lid) {
    mesh.points.emplace_back(0, 0, 1.5);
    mesh.tets.insert(mesh.tets.end(), {{kA, kB, kP, kD}, {kB, kA, kQ, kD}});
    mesh.labels.insert(mesh.labels.end(), {2, 2});
  }
  complete(mesh);
  return mesh;
}

struct Flipped {
  std::size_t flips;
  TetMesh mesh;
};

/// Such a tet is much of so small a mesh: volumes may change by `limit` of what they are.
Flipped flipped(const TetMesh& mesh, double envelope, double limit = 1) {
  const SizingField sizing = test::uniform_sizing(kEdge);
  const SizeGuard guard(sizing);
  const SurfaceMesh reference{mesh.points, mesh.faces, mesh.face_sides};
  TetComplex complex(mesh);
  const WallLayers layers;
  const VolumeKeeper volumes(complex, layers, limit);
  InterfaceFlipper flipper(complex, reference, sizing, guard, envelope, volumes);
  const std::size_t flips = flipper.flip(std::vector<std::uint32_t>{0});
  return {flips, std::move(complex).release()};
}

TEST(InterfaceFlipping, TakesAFlatTetOffTheBoundary) {
  const TetMesh before = flat_on_top(false);
  const Flipped after = flipped(before, 0.1);
  EXPECT_EQ(after.flips, 1U);
  EXPECT_EQ(after.mesh.tets.size(), 2U);
  EXPECT_EQ(after.mesh.points.size(), 5U);
  EXPECT_EQ(after.mesh.faces.size(), before.faces.size());
  test::check_tets(after.mesh);
}

TEST(InterfaceFlipping, GivesAFlatTetToTheLabelAboveWhereAnEdgeGoes) {
  const TetMesh before = flat_on_top(true);
  const Flipped after = flipped(before, 0.1);
  EXPECT_EQ(after.flips, 1U);
  EXPECT_EQ(after.mesh.labels, (std::vector<Label>{2, 1, 1, 2}));
  test::check_tets(after.mesh);
  EXPECT_EQ(label_topology({after.mesh.points, after.mesh.faces, after.mesh.face_sides}),
            label_topology({before.points, before.faces, before.face_sides}));
}

TEST(InterfaceFlipping, StaysInTheEnvelope) {
  EXPECT_EQ(flipped(flat_on_top(false), 0.02).flips, 0U);
  EXPECT_EQ(flipped(flat_on_top(true), 0.02).flips, 0U);
}

TEST(InterfaceFlipping, KeepsVolumes) {
  for (const bool lid : {false, true}) {
    EXPECT_EQ(flipped(flat_on_top(lid), 0.1, 0.01).flips, 0U);
    EXPECT_EQ(flipped(flat_on_top(lid), 0.1, 0.5).flips, 1U);
  }
}

TEST(InterfaceFlipping, LeavesAnEdgeThatThreeLabelsShare) {
  TetMesh mesh = flat_on_top(true);
  mesh.labels.back() = 3;
  complete(mesh);
  EXPECT_EQ(flipped(mesh, 0.1).flips, 0U);
}

TEST(InterfaceFlipping, TakesATipOffWithItsVertex) {
  TetMesh mesh = flat_on_top(false);
  mesh.tets.erase(mesh.tets.begin() + 1);
  mesh.labels.pop_back();
  complete(mesh);
  const Flipped after = flipped(mesh, 0.5);
  EXPECT_EQ(after.flips, 1U);
  EXPECT_EQ(after.mesh.tets.size(), 1U);
  EXPECT_EQ(after.mesh.points.size(), 4U) << "b is gone";
  EXPECT_EQ(after.mesh.faces.size(), 4U);
  test::check_tets(after.mesh);
}

}  // namespace
}  // namespace voxtet::tetra
