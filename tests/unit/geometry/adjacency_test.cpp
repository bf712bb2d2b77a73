#include "geometry/topology/adjacency.h"

#include <gtest/gtest.h>

#include "support/check_tets.h"
#include "support/labelled_mesh.h"

namespace voxtet {
namespace {

TEST(Adjacency, FindsEdgesAndFacesOfTwoTetsOnce) {
  const std::vector<Tet> tets{{3, 1, 2, 0}, {1, 2, 3, 4}};
  const std::vector<Edge> edges = tet_edges(tets, 5);
  EXPECT_EQ(edges,
            (std::vector<Edge>{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {1, 4}, {2, 3}, {2, 4}, {3, 4}}));
  const std::vector<TetFace> faces = tet_faces(tets, 5);
  ASSERT_EQ(faces.size(), 7U);
  for (const TetFace& face : faces) {
    const bool shared = face.corners == Triangle{1, 2, 3};
    EXPECT_EQ(face.count, shared ? 2U : 1U);
    EXPECT_EQ(face.second, shared ? 1U : TetFace::kNoTet);
  }
}

TEST(Adjacency, CountsFacesOfBrokenMeshes) {
  const std::vector<Tet> tets{{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 1, 2, 5}};
  const std::vector<TetFace> faces = tet_faces(tets, 6);
  EXPECT_EQ(faces.front().corners, (Triangle{0, 1, 2}));
  EXPECT_EQ(faces.front().count, 3U);
}

TEST(EdgeHops, CountsTheFewestEdges) {
  // A ring of five with a tail, and a point apart.
  const std::vector<Edge> edges{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {0, 4}, {2, 5}};
  const std::vector<std::uint32_t> from_0{0, 1, 2, 2, 1, 3, kUnreached};
  EXPECT_EQ(edge_hops(edges, {true, false, false, false, false, false, false}), from_0);
  const std::vector<std::uint32_t> from_both{0, 1, 1, 2, 1, 0, kUnreached};
  EXPECT_EQ(edge_hops(edges, {true, false, false, false, false, true, false}), from_both);
}

TEST(EdgeHops, OfPointsWithoutAWayAddUp) {
  EXPECT_GT(kUnreached + kUnreached + 10, kUnreached);
}

TEST(AddLabelFaces, FindsTheFacesBetweenLabelsOutwardFromTheGreater) {
  TetMesh mesh = test::kuhn_cube(4);
  const std::size_t count = mesh.faces.size();
  add_label_faces(mesh);
  ASSERT_EQ(mesh.faces.size(), count);
  test::check_tets(mesh);
}

}  // namespace
}  // namespace voxtet
