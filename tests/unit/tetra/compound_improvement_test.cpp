// What only several operations together improve; changes that are taken back.
#include "tetra/optimise/compound_improvement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "base/digest.h"
#include "geometry/topology/label_topology.h"
#include "support/check_tets.h"
#include "support/labelled_mesh.h"
#include "support/test_surfaces.h"
#include "tetra/operations/local_swaps.h"

namespace voxtet::tetra {
namespace {

constexpr int kSteps = 5;

SurfaceMesh interfaces_of(const TetMesh& mesh) {
  return {mesh.points, mesh.faces, mesh.face_sides};
}

/// All operations on a mesh that is its own reference.
struct Workshop {
  explicit Workshop(const TetMesh& mesh, double edge, double envelope = 0.1)
      : reference(interfaces_of(mesh)),
        sizing(test::uniform_sizing(edge)),
        complex(mesh),
        guard(sizing),
        smoother(complex, guard),
        inserter(complex, guard),
        volumes(complex, layers, 1),
        slider(complex, smoother, reference, sizing, envelope, layers, cuts, volumes),
        improver(complex, guard, smoother, inserter, slider, counts) {
    std::vector<std::uint32_t> all(complex.point_count());
    for (std::uint32_t v = 0; v < all.size(); ++v) all[v] = v;
    slider.approach(all);
  }

  std::uint32_t worst() const {
    std::optional<std::uint32_t> found;
    for (std::uint32_t t = 0; t < complex.places(); ++t)
      if (complex.alive(t) && (!found || complex.quality_of(t) < complex.quality_of(*found))) found = t;
    return *found;
  }
  double lowest() const { return complex.quality_of(worst()); }

  /// One operation at a tet; whether there was one that helps.
  bool operate(std::uint32_t t, double goal) {
    if (swap_at(complex, t, guard) != Swap::kNone || inserter.insert(t)) return true;
    for (const std::uint32_t v : Tet(complex.corners(t)))
      if (complex.on_interface(v) ? slider.slide(v, goal) : smoother.smooth(v, goal, kSteps)) return true;
    return false;
  }

  SurfaceMesh reference;
  SizingField sizing;
  CutPlanes cuts;
  WallLayers layers;
  TetComplex complex;
  SizeGuard guard;
  VertexSmoother smoother;
  VertexInserter inserter;
  VolumeKeeper volumes;
  InterfaceSlider slider;
  OperationCounts counts;
  CompoundImprover improver;
};

TetMesh copy_of(TetComplex complex) {
  return std::move(complex).release();
}

TEST(UndoTo, BringsBackEveryByte) {
  const TetMesh before = test::kuhn_cube(4);
  Workshop shop(before, 2.5);
  const TetComplex::Mark start = shop.complex.mark();
  for (int i = 0; i < 60; ++i) shop.operate(shop.worst(), 1);
  const std::string halfway = digest_of(copy_of(shop.complex));
  const TetComplex::Mark middle = shop.complex.mark();
  EXPECT_GT(middle.changes, 20U);
  EXPECT_GT(middle.points, start.points);
  for (std::uint32_t t = 0; t < shop.complex.places(); ++t)
    if (shop.complex.alive(t)) shop.operate(t, 1);
  EXPECT_NE(digest_of(copy_of(shop.complex)), halfway);
  shop.complex.undo_to(middle);
  EXPECT_EQ(digest_of(copy_of(shop.complex)), halfway);
  shop.complex.undo_to(start);
  EXPECT_EQ(shop.complex.point_count(), before.points.size());
  EXPECT_EQ(digest_of(copy_of(shop.complex)), digest_of(before));
}

TEST(CompoundImprover, HelpsWhereNoOperationDoes) {
  Workshop shop(test::kuhn_cube(4), 2.5);
  const double goal = quality_of_angle(45);
  for (int pass = 0; pass < 4; ++pass)
    for (std::uint32_t t = 0; t < shop.complex.places(); ++t)
      if (shop.complex.alive(t) && shop.complex.quality_of(t) < goal) shop.operate(t, goal);
  std::size_t stuck = 0, helped = 0;
  for (std::uint32_t t = 0; t < shop.complex.places(); ++t) {
    if (!shop.complex.alive(t) || shop.complex.quality_of(t) >= goal || shop.operate(t, goal)) continue;
    ++stuck;
    const double before = shop.complex.quality_of(t);
    if (!shop.improver.improve(t, goal, true)) continue;
    ++helped;
    if (shop.complex.alive(t)) {
      EXPECT_GT(shop.complex.quality_of(t), before);
    }
  }
  EXPECT_GT(helped, 0U) << "of " << stuck;
  test::check_tets(copy_of(shop.complex));
}

TEST(CompoundImprover, NeverLowersTheLowestQualityNorTouchesTopology) {
  const TetMesh before = test::kuhn_cube(3);
  Workshop shop(before, 3);
  const double goal = quality_of_angle(46);
  std::size_t better = 0, refused = 0;
  for (int i = 0; i < 120; ++i) {
    const double lowest = shop.lowest();
    const std::string bytes = digest_of(copy_of(shop.complex));
    // Also where others are worse.
    const std::uint32_t t =
        i % 3 == 0 ? shop.worst() : static_cast<std::uint32_t>(7 * i) % shop.complex.places();
    if (!shop.complex.alive(t) || shop.complex.quality_of(t) >= goal) continue;
    const bool improved = shop.improver.improve(t, goal, i % 2 == 0);
    ++(improved ? better : refused);
    EXPECT_GE(shop.lowest(), lowest);
    EXPECT_EQ(digest_of(copy_of(shop.complex)) == bytes, !improved);
  }
  EXPECT_GT(better, 0U);
  EXPECT_GT(refused, 3U);
  EXPECT_GT(shop.counts.slid, 0U);
  const TetMesh after = copy_of(shop.complex);
  test::check_tets(after);
  EXPECT_EQ(label_topology(interfaces_of(after)), label_topology(interfaces_of(before)));
  EXPECT_EQ(after.faces.size(), before.faces.size());
}

TEST(InterfaceSlider, SlidesAJunctionVertexAlongItsCurveOnly) {
  TetMesh mesh;
  mesh.points = {{0.5, 0, 0}, {-2, 0, 0}, {2, 0, 0}, {-2, 2, 0},  {2, 2, 0},
                 {-2, -2, 0}, {2, -2, 0}, {0, 0, 2}, {0, 2, 0.2}, {0, -2, 0.2}};
  constexpr std::uint32_t kTop = 7, kLeft = 8, kRight = 9;
  for (const auto& [side, far, near, label] :
       {std::tuple{kLeft, 3U, 4U, Label{1}}, std::tuple{kRight, 5U, 6U, Label{2}}}) {
    mesh.tets.insert(mesh.tets.end(),
                     {{0, 1, far, kTop}, {0, far, side, kTop}, {0, side, near, kTop}, {0, near, 2, kTop}});
    mesh.labels.insert(mesh.labels.end(), 4, label);
  }
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t)
    if (test::tet_volume(mesh, t) < 0) std::swap(mesh.tets[t][2], mesh.tets[t][3]);
  test::add_faces(mesh);
  Workshop shop(mesh, 2);
  const double before = shop.lowest();
  ASSERT_TRUE(shop.slider.slide(0, 1));
  EXPECT_GT(shop.lowest(), before);
  const Point at = shop.complex.point(0);
  EXPECT_LT(at.x(), 0.5);
  EXPECT_LE(std::hypot(at.y(), at.z()), 0.1 * 2 + 1e-12) << "in the envelope of the line";
}

TEST(InterfaceSlider, HoldsTheVerticesOfInterfacesThatMeet) {
  // The lower of two pyramids leans, so that its tip would slide; the upper one hangs over it.
  TetMesh mesh;
  mesh.points = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0.5, 0, 1},
                 {-1, -1, 3}, {1, -1, 3}, {1, 1, 3}, {-1, 1, 3}, {0, 0, 1.1}};
  mesh.tets = {{0, 1, 2, 4}, {0, 2, 3, 4}, {5, 6, 7, 9}, {5, 7, 8, 9}};
  mesh.labels.assign(4, 1);
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t)
    if (test::tet_volume(mesh, t) < 0) std::swap(mesh.tets[t][2], mesh.tets[t][3]);
  test::add_faces(mesh);
  Workshop shop(mesh, 2, 0.5);
  const TetComplex::Mark start = shop.complex.mark();
  ASSERT_TRUE(shop.slider.slide(4, 1));
  EXPECT_FALSE(shop.slider.hold_where_interfaces_meet(start)) << "slid apart from each other";
  shop.complex.undo_to(start);

  std::vector<std::uint32_t> star;
  IdSet seen;
  shop.complex.find_star(9, seen, star);
  ASSERT_TRUE(shop.complex.move_point(9, {0.3, 0, 0.5}, star));
  EXPECT_TRUE(shop.slider.hold_where_interfaces_meet(start));
  shop.complex.undo_to(start);
  EXPECT_FALSE(shop.slider.slide(4, 1));
  EXPECT_FALSE(shop.slider.hold_where_interfaces_meet(start)) << "nothing has moved since";
}

}  // namespace
}  // namespace voxtet::tetra
