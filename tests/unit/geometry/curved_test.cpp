// Second-order tetrahedra: shared nodes, determinants, boundaries that follow a surface.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "base/digest.h"
#include "geometry/curved/curve_midsides.h"
#include "geometry/curved/jacobian.h"
#include "geometry/curved/label_targets.h"
#include "geometry/curved/midside_nodes.h"
#include "support/labelled_mesh.h"
#include "support/test_surfaces.h"

namespace voxtet {
namespace {

Tet10Points tet10_of(const TetMesh& mesh, const MidsideNodes& nodes, std::size_t t) {
  Tet10Points x;
  for (std::size_t i = 0; i < 4; ++i) x[i] = mesh.points[mesh.tets[t][i]];
  for (std::size_t e = 0; e < 6; ++e) x[4 + e] = nodes.points[nodes.tets[t][e]];
  return x;
}

/// By the derivatives of the shape functions.
double determinant_at(const Tet10Points& x, const Eigen::Vector4d& l) {
  Eigen::Matrix<double, 3, 4> slopes = Eigen::Matrix<double, 3, 4>::Zero();
  for (int i = 0; i < 4; ++i) slopes.col(i) += (4 * l[i] - 1) * x[static_cast<std::size_t>(i)];
  for (std::size_t e = 0; e < 6; ++e) {
    const auto i = static_cast<int>(kMidsidesOfTet[e].first), j = static_cast<int>(kMidsidesOfTet[e].second);
    slopes.col(i) += 4 * l[j] * x[4 + e];
    slopes.col(j) += 4 * l[i] * x[4 + e];
  }
  Eigen::Matrix3d jacobian;
  for (int k = 0; k < 3; ++k) jacobian.col(k) = slopes.col(k + 1) - slopes.col(0);
  return jacobian.determinant();
}

/// The determinant is of degree 3: this rule is exact.
double volume_of(const Tet10Points& x) {
  double sum = -0.8 * determinant_at(x, Eigen::Vector4d::Constant(0.25));
  for (int i = 0; i < 4; ++i) {
    Eigen::Vector4d l = Eigen::Vector4d::Constant(1.0 / 6);
    l[i] = 0.5;
    sum += 0.45 * determinant_at(x, l);
  }
  return sum / 6;
}

double volume_of(const TetMesh& mesh, const MidsideNodes& nodes) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) sum += volume_of(tet10_of(mesh, nodes, t));
  return sum;
}

Eigen::Vector4d random_place(std::mt19937_64& random) {
  Eigen::Vector4d l;
  for (int i = 0; i < 4; ++i) l[i] = 1 + static_cast<double>(random() % 1000000);
  return l / l.sum();
}

/// A ball of radius 10: a cone from its centre to each triangle of an icosahedron cut `levels` times.
TetMesh cone_ball(int levels) {
  const SurfaceMesh shell = test::sphere({1, 2, 3}, 10, levels, 1, 0);
  TetMesh mesh;
  mesh.points = shell.points;
  mesh.points.emplace_back(1, 2, 3);
  const auto centre = static_cast<std::uint32_t>(shell.points.size());
  for (const auto& [a, b, c] : shell.triangles) mesh.tets.push_back({centre, a, b, c});
  mesh.labels.assign(mesh.tets.size(), 1);
  test::add_faces(mesh);
  return mesh;
}

const SurfaceMesh& fine_sphere() {
  static const SurfaceMesh made = test::sphere({1, 2, 3}, 10, 6, 1, 0);
  return made;
}

constexpr double kBallVolume = 4.0 / 3 * 3.14159265358979 * 1000;

TEST(MidsideNodes, AreSharedByAllElementsAtAnEdge) {
  const TetMesh mesh = test::kuhn_cube(3);
  const MidsideNodes nodes = straight_midside_nodes(mesh);
  ASSERT_EQ(nodes.edges.size(), nodes.points.size());
  std::set<std::array<std::uint32_t, 2>> edges;
  const auto expect_ends = [&](const auto& corners, const auto& of_element) {
    for (std::size_t e = 0; e < of_element.size(); ++e) {
      const auto& [i, j] = kMidsidesOfTet[e];
      const auto [low, high] = std::minmax(corners[i], corners[j]);
      EXPECT_EQ(nodes.edges[of_element[e]], (std::array<std::uint32_t, 2>{low, high}));
      edges.insert({low, high});
    }
  };
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) expect_ends(mesh.tets[t], nodes.tets[t]);
  EXPECT_EQ(edges.size(), nodes.edges.size()) << "each edge once, and none besides";
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) expect_ends(mesh.faces[f], nodes.faces[f]);
  for (std::size_t e = 0; e < nodes.edges.size(); ++e)
    EXPECT_EQ(nodes.points[e], (mesh.points[nodes.edges[e][0]] + mesh.points[nodes.edges[e][1]]) / 2);
}

TEST(DeterminantBounds, AreThatOfTheTetrahedronWhereItIsStraight) {
  const TetMesh mesh = test::kuhn_cube(2);
  const MidsideNodes nodes = straight_midside_nodes(mesh);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Tet10Points x = tet10_of(mesh, nodes, t);
    const double six_volumes = (x[1] - x[0]).dot((x[2] - x[0]).cross(x[3] - x[0]));
    const DeterminantBounds bounds = determinant_bounds(x);
    EXPECT_NEAR(bounds.least / six_volumes, 1, 1e-12);
    EXPECT_NEAR(bounds.greatest / six_volumes, 1, 1e-12);
  }
}

TEST(DeterminantBounds, HoldEveryValueAndAreTight) {
  std::mt19937_64 random(20);
  for (int element = 0; element < 50; ++element) {
    Tet10Points x{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0),
                  Eigen::Vector3d(0, 0, 1)};
    for (std::size_t e = 0; e < 6; ++e) {
      Eigen::Vector3d shift;
      for (int d = 0; d < 3; ++d) shift[d] = 0.3 * (static_cast<double>(random() % 1000000) / 1e6 - 0.5);
      x[4 + e] = (x[kMidsidesOfTet[e].first] + x[kMidsidesOfTet[e].second]) / 2 + shift;
    }
    const DeterminantBounds bounds = determinant_bounds(x);
    double least = 1e9;
    for (int i = 0; i < 4; ++i) least = std::min(least, determinant_at(x, Eigen::Vector4d::Unit(i)));
    for (int sample = 0; sample < 20000; ++sample) {
      const double value = determinant_at(x, random_place(random));
      EXPECT_GE(value, bounds.least - 1e-12) << element;
      EXPECT_LE(value, bounds.greatest + 1e-12) << element;
      least = std::min(least, value);
    }
    EXPECT_LT(least - bounds.least, 0.1) << element << ": of a straight determinant of 1";
  }
}

TEST(DeterminantBounds, FindAnElementThatIsTurnedInsideOutBetweenItsNodes) {
  Tet10Points x{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0),
                Eigen::Vector3d(0, 0, 1)};
  for (std::size_t e = 0; e < 6; ++e)
    x[4 + e] = (x[kMidsidesOfTet[e].first] + x[kMidsidesOfTet[e].second]) / 2;
  x[4] = {0.2, 0, 0};  // beyond a quarter of the edge the map folds
  EXPECT_LT(determinant_bounds(x).least, 0);
  x[4] = {0.3, 0, 0};
  EXPECT_GT(determinant_bounds(x).least, 0);
}

TEST(CurveMidsides, BringsTheVolumeOfABallNearerToTheTruth) {
  for (const int levels : {1, 2, 3}) {
    const TetMesh mesh = cone_ball(levels);
    const CurvedNodes curved = curve_midsides(mesh, fine_sphere(), 2);
    const double first = std::abs(volume_of(mesh, straight_midside_nodes(mesh)) - kBallVolume);
    const double second = std::abs(volume_of(mesh, curved.nodes) - kBallVolume);
    EXPECT_LT(second, first / 10) << levels;
    EXPECT_EQ(curved.moved, 30U << (2U * static_cast<unsigned>(levels))) << "edges of the icosahedron, cut";
    EXPECT_EQ(curved.pulled_back + curved.held, 0U);
    EXPECT_LT(curved.curved.mean_mm, curved.straight.mean_mm / 5);
    EXPECT_LT(curved.curved.max_mm, curved.straight.max_mm / 5);
  }
}

TEST(CurveMidsides, LeavesEdgesInsideOfALabelStraight) {
  const TetMesh mesh = cone_ball(2);
  const CurvedNodes curved = curve_midsides(mesh, fine_sphere(), 1);
  const MidsideNodes straight = straight_midside_nodes(mesh);
  for (std::size_t e = 0; e < straight.edges.size(); ++e) {
    const bool inside = straight.edges[e][1] + 1 == mesh.points.size();
    EXPECT_EQ(curved.nodes.points[e] == straight.points[e], inside);
    if (!inside) {
      EXPECT_NEAR((curved.nodes.points[e] - mesh.points.back()).norm(), 10, 0.01);
    }
  }
}

/// The ball's surface as a shell of 0.6 mm. Its edges' middles are 0.4 mm below the sphere, and derivatives
/// at corners change by four times as much.
TetMesh thin_shell() {
  const SurfaceMesh outer = test::sphere({1, 2, 3}, 10, 1, 1, 0),
                    inner = test::sphere({1, 2, 3}, 9.4, 1, 1, 0);
  TetMesh mesh;
  mesh.points = inner.points;
  mesh.points.insert(mesh.points.end(), outer.points.begin(), outer.points.end());
  const auto up = static_cast<std::uint32_t>(inner.points.size());
  for (Triangle t : inner.triangles) {
    std::sort(t.begin(), t.end());
    const auto [a, b, c] = t;
    for (Tet tet : {Tet{a, b, c, c + up}, Tet{a, b, b + up, c + up}, Tet{a, a + up, b + up, c + up}}) {
      const Eigen::Vector3d& p = mesh.points[tet[0]];
      if ((mesh.points[tet[1]] - p).dot((mesh.points[tet[2]] - p).cross(mesh.points[tet[3]] - p)) < 0)
        std::swap(tet[2], tet[3]);
      mesh.tets.push_back(tet);
    }
  }
  mesh.labels.assign(mesh.tets.size(), 1);
  test::add_faces(mesh);
  return mesh;
}

TEST(CurveMidsides, PullsNodesBackWhereElementsWouldFold) {
  const TetMesh mesh = thin_shell();
  SurfaceMesh both = test::sphere({1, 2, 3}, 10, 5, 1, 0);
  test::append(both, test::sphere({1, 2, 3}, 9.4, 5, 0, 1));
  const CurvedNodes curved = curve_midsides(mesh, both, 1);
  EXPECT_GT(curved.pulled_back, 0U);
  EXPECT_GT(curved.moved, 0U);
  EXPECT_GT(curved.min_scaled_jacobian, 0);
  const MidsideNodes straight = straight_midside_nodes(mesh);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    EXPECT_GT(determinant_bounds(tet10_of(mesh, curved.nodes, t)).least,
              0.99 * kLeastDeterminant * determinant_bounds(tet10_of(mesh, straight, t)).least);
}

TEST(CurveMidsides, LeavesTheRimsOfABoxStraightAndItsSidesFlat) {
  TetMesh mesh = test::kuhn_cube(3);
  mesh.labels.assign(mesh.tets.size(), 1);
  mesh.faces.clear();
  mesh.face_sides.clear();
  test::add_faces(mesh);
  const SurfaceMesh own{mesh.points, mesh.faces, mesh.face_sides};
  const CurvedNodes curved = curve_midsides(mesh, own, 1);
  const MidsideNodes straight = straight_midside_nodes(mesh);
  for (std::size_t e = 0; e < straight.points.size(); ++e)
    EXPECT_LT((curved.nodes.points[e] - straight.points[e]).norm(), 1e-12);
}

TEST(LabelTargets, OfJunctionsAreOnTheJunctionOfTheSurface) {
  // Three interfaces meet at the edge 01; in the surface it has a bend, between its interfaces.
  const TetMesh mesh = test::two_tets();
  const MidsideNodes nodes = straight_midside_nodes(mesh);
  const Eigen::Vector3d bend(0.5, -0.05, 0.02);
  SurfaceMesh surface{mesh.points, {}, {}};
  surface.points.push_back(bend);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    Triangle face = mesh.faces[f];
    for (int turn = 0; turn < 3 && std::max(face[0], face[1]) > 1; ++turn)
      std::rotate(face.begin(), face.begin() + 1, face.end());
    if (std::max(face[0], face[1]) > 1) {
      surface.triangles.push_back(face);
      surface.sides.push_back(mesh.face_sides[f]);
      continue;
    }
    for (const Triangle& half : {Triangle{face[0], 5, face[2]}, Triangle{5, face[1], face[2]}}) {
      surface.triangles.push_back(half);
      surface.sides.push_back(mesh.face_sides[f]);
    }
  }
  const std::vector<Eigen::Vector3d> targets = label_targets(mesh, nodes, surface, 1);
  for (std::size_t e = 0; e < nodes.edges.size(); ++e) {
    if (nodes.edges[e] != std::array<std::uint32_t, 2>{0, 1}) {
      EXPECT_LT((targets[e] - nodes.points[e]).norm(), 1e-12) << "the others are as they were";
      continue;
    }
    const double part = targets[e].x() / bend.x();
    EXPECT_LT((targets[e] - (part <= 1 ? part : 2 - part) * Eigen::Vector3d(0, bend.y(), bend.z()) -
               Eigen::Vector3d(targets[e].x(), 0, 0))
                  .norm(),
              1e-12)
        << "on one half of the bent edge";
    EXPECT_GT((targets[e] - nodes.points[e]).norm(), 0.04);
  }
}

TEST(CurveMidsides, SameBytesOnEveryPlatformAndForAnyNumberOfThreads) {
  const TetMesh mesh = cone_ball(2);
  const auto digest = [&](int threads) {
    const CurvedNodes curved = curve_midsides(mesh, test::sphere({1, 2, 3}, 10, 4, 1, 0), threads);
    Sha256 sha;
    for (const Eigen::Vector3d& p : curved.nodes.points) sha.update_values(p.data(), 3);
    return sha.hex();
  };
  EXPECT_EQ(digest(1), "d3b6dce929d0853904d76c532bcc9f549d9c829a7d11b62408e05e715b7765c7");
  EXPECT_EQ(digest(1), digest(3));
}

}  // namespace
}  // namespace voxtet
