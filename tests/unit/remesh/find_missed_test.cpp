// Where an adapted surface fails to follow the label surface.
#include "remesh/delaunay/find_missed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/label_bodies.h"
#include "support/label_surface.h"
#include "support/test_surfaces.h"

namespace voxtet::remesh {
namespace {

using Eigen::Vector3d;

constexpr double kLimit = 0.45, kSeparation = 0.5, kBallRadius = 4;
const Vector3d kFirstCentre(7, 8, 8), kSecondCentre(20, 8, 8);

LabelVolume two_balls(Label second) {
  return test::make_volume(28, 17, 17, [&](int i, int j, int k) {
    const Vector3d p(i, j, k);
    return (p - kFirstCentre).norm() <= kBallRadius    ? 1
           : (p - kSecondCentre).norm() <= kBallRadius ? int{second}
                                                       : 0;
  });
}

SurfaceMesh both(Label second) {
  SurfaceMesh surface = test::sphere(kFirstCentre, kBallRadius, 3, 1, 0);
  test::append(surface, test::sphere(kSecondCentre, kBallRadius, 3, second, 0));
  return surface;
}

std::vector<Vector3d> missed_by(const SurfaceMesh& surface, const LabelVolume& volume,
                                const SurfaceMesh& reference) {
  const LabelField field(volume, reference);
  return MissedPlaces(reference, field).of(surface, {kLimit, kSeparation});
}

TEST(MissedPlaces, AreNoneOfASurfaceThatIsTheReference) {
  const SurfaceMesh reference = both(1);
  EXPECT_TRUE(missed_by(reference, two_balls(1), reference).empty());
}

TEST(MissedPlaces, CoverABodyThatTheSurfaceLacks) {
  for (const Label second : std::vector<Label>{1, 2, 65535}) {
    const SurfaceMesh reference = both(second), one = test::sphere(kFirstCentre, kBallRadius, 3, 1, 0);
    const std::vector<Vector3d> missed = missed_by(one, two_balls(second), reference);
    EXPECT_GT(missed.size(), 100U) << second;
    Vector3d low = missed.front(), high = missed.front();
    for (std::size_t p = 0; p < missed.size(); ++p) {
      EXPECT_NEAR((missed[p] - kSecondCentre).norm(), kBallRadius, 0.15);
      low = low.cwiseMin(missed[p]);
      high = high.cwiseMax(missed[p]);
      for (std::size_t q = 0; q < p; ++q) EXPECT_GE((missed[p] - missed[q]).norm(), kSeparation);
    }
    EXPECT_GT((high - low).minCoeff(), 1.8 * kBallRadius) << second;
  }
}

TEST(MissedPlaces, AreWhereTheSurfaceIsFartherThanTheLimit) {
  const SurfaceMesh reference = both(1);
  SurfaceMesh dented = reference;
  const Vector3d top = kFirstCentre + Vector3d(0, 0, kBallRadius);
  for (Vector3d& p : dented.points)
    if ((p - top).norm() < 1.5) p.z() -= 1;
  const std::vector<Vector3d> missed = missed_by(dented, two_balls(1), reference);
  ASSERT_FALSE(missed.empty());
  for (const Vector3d& p : missed) EXPECT_LT((p - top).norm(), 2);
}

TEST(MissedPlaces, AreTheSameWhateverSurfaceWasLookedAtBefore) {
  const SurfaceMesh reference = both(2), one = test::sphere(kFirstCentre, kBallRadius, 3, 1, 0);
  SurfaceMesh dented = reference, shuffled = reference;
  for (Vector3d& p : dented.points)
    if (p.z() > kFirstCentre.z() + 0.8 * kBallRadius) p.z() -= 1;
  std::reverse(shuffled.triangles.begin(), shuffled.triangles.end());
  std::reverse(shuffled.sides.begin(), shuffled.sides.end());
  const LabelField field(two_balls(2), reference);
  MissedPlaces places(reference, field);
  for (const SurfaceMesh* surface :
       std::vector<const SurfaceMesh*>{&reference, &dented, &one, &shuffled, &one, &dented, &reference})
    EXPECT_EQ(places.of(*surface, {kLimit, kSeparation}),
              MissedPlaces(reference, field).of(*surface, {kLimit, kSeparation}));
}

TEST(MissedPlaces, DoNotTakeTheInterfaceOfOtherLabelsForTheirOwn) {
  const SurfaceMesh reference = both(1);
  SurfaceMesh wrong = reference;
  for (std::size_t t = wrong.sides.size() / 2; t < wrong.sides.size(); ++t) wrong.sides[t] = {3, 0};
  const std::vector<Vector3d> missed = missed_by(wrong, two_balls(1), reference);
  EXPECT_GT(missed.size(), 100U);
  for (const Vector3d& p : missed) EXPECT_NEAR((p - kSecondCentre).norm(), kBallRadius, 0.15);
}

TEST(MissedPlaces, AreTheWallsOfANarrowTunnelWhoseLidsAreNear) {
  // A plate of 2 voxels with a hole of one voxel; the surface is the plate's without it.
  const auto plate = [](bool hole) {
    return test::make_volume(13, 13, 8, [&](int i, int j, int k) {
      const bool body = i > 1 && i < 11 && j > 1 && j < 11 && (k == 3 || k == 4);
      return body && !(hole && i == 6 && j == 6) ? 1 : 0;
    });
  };
  const LabelVolume volume = plate(true);
  const SurfaceMesh reference = test::label_surface(volume), lidded = test::label_surface(plate(false));
  const LabelField field(volume, reference);
  constexpr double kWide = 1.5;  // farther than any wall is from a lid
  EXPECT_TRUE(MissedPlaces(reference, field).of(lidded, {kWide, 0.2}).empty());
  const std::vector<Vector3d> missed = MissedPlaces(reference, field).of(lidded, {kWide, 0.2, {1}});
  EXPECT_GE(missed.size(), 4U) << "one a wall";
  for (const Vector3d& p : missed) {
    EXPECT_LT((p - Vector3d(6, 6, p.z())).norm(), 1) << p.transpose();
    EXPECT_TRUE(p.z() > 2.4 && p.z() < 4.6) << p.transpose();
  }
  EXPECT_TRUE(MissedPlaces(reference, field).of(lidded, {kWide, 0.2, {2}}).empty()) << "another label";
}

/// A slab of two labels that meet at x = `border`.
SurfaceMesh slab(int border) {
  return test::cells({8, 4, 1}, 1, [&](int i, int, int) { return Label(i < border ? 1 : 2); });
}

TEST(MissedJunctions, AreNoneOfTheSameCurves) {
  const SurfaceMesh surface = slab(4);
  EXPECT_FALSE(junction_edges(surface).empty());
  EXPECT_TRUE(missed_junctions(surface, junction_edges(surface), surface, 0.1).empty());
}

TEST(MissedJunctions, LieOnTheCurveOfTheReferenceWhereTheSurfaceHasAnother) {
  const SurfaceMesh reference = slab(4), shifted = slab(5);
  const std::vector<Edge> edges = junction_edges(reference);
  EXPECT_TRUE(missed_junctions(reference, edges, shifted, 1.01).empty());
  const std::vector<Vector3d> missed = missed_junctions(reference, edges, shifted, 0.9);
  EXPECT_EQ(missed.size(), 2 * edges.size()) << "every edge of both";
  for (const Vector3d& p : missed) EXPECT_EQ(p.x(), 4);
}

TEST(MissedJunctions, AreAllWhereTheSurfaceHasNone) {
  const SurfaceMesh reference = slab(4);
  const std::vector<Edge> edges = junction_edges(reference);
  EXPECT_EQ(missed_junctions(reference, edges, slab(8), 0.5).size(), edges.size());
  EXPECT_TRUE(missed_junctions(slab(8), {}, reference, 0.5).empty()) << "no curve to lie on";
}

}  // namespace
}  // namespace voxtet::remesh
