// What changes the labels of a complex: islands removed, pinches mended, wedges removed.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "field_of.h"
#include "geometry/topology/label_topology.h"
#include "lattice_complex.h"
#include "remesh/cells/cell_stars.h"
#include "remesh/cells/cut_folds.h"
#include "remesh/cells/extract_interface.h"
#include "remesh/cells/make_two_manifold.h"
#include "remesh/cells/mend_contacts.h"
#include "remesh/cells/remove_islands.h"
#include "remesh/cells/remove_wedges.h"
#include "remesh/delaunay/delaunay_refiner.h"
#include "remesh/delaunay/seed_interfaces.h"
#include "support/check_surface.h"
#include "support/label_bodies.h"
#include "support/label_surface.h"
#include "support/random_labels.h"
#include "support/test_random.h"
#include "support/test_surfaces.h"
#include "surface_report.h"

namespace voxtet::remesh {
namespace {

using Eigen::Vector3d;

std::size_t all_defects(const LabelledCells& cells) {
  CellStars::Cells points(cells.points.size());
  std::iota(points.begin(), points.end(), 0U);
  return CellStars(cells).defects(points);
}

/// The refined complex of a field before anything is mended.
LabelledCells refined(const LabelVolume& volume, const LabelField& field, double edge_mm) {
  const SizingField sizing = test::uniform_sizing(edge_mm);
  const Seeds seeds = seed_interfaces(field, test::label_surface(volume), sizing, {});
  DelaunayRefiner refiner(field, sizing, {30, 0.5 * field.grid().smallest_spacing_mm(), 1 / 1.3});
  refiner.insert(seeds.points, 0.25 * field.grid().smallest_spacing_mm());
  RunContext ctx;
  EXPECT_TRUE(refiner.refine(ctx, seeds.predicted_vertices));
  return refiner.cells();
}

LabelledCells cubes(const std::vector<std::array<int, 3>>& labelled) {
  return test::lattice_complex(5, 0.4, 0, [&](int i, int j, int k) {
    return std::find(labelled.begin(), labelled.end(), std::array{i, j, k}) != labelled.end() ? 1 : 0;
  });
}

TEST(LatticeComplex, IsAPositiveComplexWithMutualNeighbours) {
  const LabelledCells cells = cubes({});
  double volume = 0;
  for (std::uint32_t c = 0; c < cells.vertices.size(); ++c) {
    const auto& v = cells.vertices[c];
    const Vector3d &a = cells.points[v[0]], &b = cells.points[v[1]];
    const double six = (b - a).dot((cells.points[v[2]] - a).cross(cells.points[v[3]] - a));
    EXPECT_GT(six, 0);
    volume += six / 6;
    for (const std::uint32_t n : cells.neighbours[c])
      if (n != LabelledCells::kNone) {
        const auto& back = cells.neighbours[n];
        EXPECT_NE(std::find(back.begin(), back.end(), c), back.end());
      }
  }
  EXPECT_NEAR(volume, 8, 1e-12);
}

TEST(CellStars, CountTheGroupsOfALabelAroundEachPoint) {
  EXPECT_EQ(all_defects(cubes({{2, 2, 2}})), 0U);
  EXPECT_EQ(all_defects(cubes({{2, 2, 2}, {3, 2, 2}})), 0U);
  // Cubes that share an edge: at its two ends the label falls into two groups, all else stays one; along the
  // edge's inside there are no points.
  EXPECT_GT(all_defects(cubes({{2, 2, 2}, {3, 3, 2}})), 0U);
  const LabelledCells touching = cubes({{1, 1, 1}, {2, 2, 2}});
  const std::uint32_t point = 2 + 6 * (2 + 6 * 2);
  const CellStars stars(touching);
  EXPECT_EQ(stars.labels_at(point), (std::vector<Label>{0, 1}));
  EXPECT_EQ(stars.groups_at(point, 1, false).size(), 2U);
  EXPECT_EQ(stars.groups_at(point, 1, true).size(), 1U);
  EXPECT_EQ(stars.groups_at(point, 0, false).size(), 1U);
  EXPECT_EQ(stars.groups_at(point, 0, true).size(), 2U);
  EXPECT_EQ(stars.defects(point), 2U);
  EXPECT_EQ(all_defects(touching), 2U);
  EXPECT_EQ(stars.points_of({0}).size(), 4U);
}

TEST(CellStars, SeeAHollowInALabelsStar) {
  const LabelledCells hollow = test::lattice_complex(
      5, 0.4, 0, [](int i, int j, int k) { return i == 2 && j == 2 && k == 2 ? 0 : 1; });
  EXPECT_EQ(all_defects(hollow), 0U);
  const LabelledCells gaps = test::lattice_complex(5, 0.4, 0, [](int i, int j, int k) {
    return (i == 1 && j == 1 && k == 1) || (i == 2 && j == 2 && k == 2) ? 0 : 1;
  });
  EXPECT_EQ(all_defects(gaps), 2U);
}

TEST(MakeTwoManifold, PartsCellsThatTouchAtAnEdgeOrAPoint) {
  // The field's body is elsewhere: nothing of the cubes lies deep in their label.
  const LabelField field = field_of(test::ball_volume(20, 14, 3.5));
  for (const auto& labelled : std::vector<std::vector<std::array<int, 3>>>{
           {{1, 1, 1}, {2, 2, 2}},
           {{2, 2, 2}, {3, 3, 2}},
           {{1, 1, 2}, {2, 2, 2}, {1, 2, 1}},
           {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {3, 1, 1}, {1, 3, 3}}}) {
    LabelledCells cells = cubes(labelled);
    ASSERT_GT(all_defects(cells), 0U);
    const std::vector<Label> before = cells.labels;
    const std::size_t changed = make_two_manifold(cells, field, find_pinches(cells));
    EXPECT_EQ(all_defects(cells), 0U);
    EXPECT_NE(std::find(cells.labels.begin(), cells.labels.end(), 1), cells.labels.end());
    std::size_t differing = 0;
    for (std::size_t c = 0; c < before.size(); ++c) differing += before[c] != cells.labels[c];
    EXPECT_GT(changed, 0U);
    EXPECT_LE(differing, changed);
    EXPECT_TRUE(test::is_valid_surface(extract_interface(cells)));
  }
}

TEST(MakeTwoManifold, LeavesAManifoldAlone) {
  const LabelField field = field_of(test::ball_volume(20, 14, 3.5));
  LabelledCells cells = cubes({{2, 2, 2}, {3, 2, 2}});
  const std::vector<Label> before = cells.labels;
  EXPECT_EQ(make_two_manifold(cells, field, find_pinches(cells)), 0U);
  EXPECT_EQ(cells.labels, before);
}

TEST(MakeTwoManifold, ChangesNothingThatLiesDeepInItsLabel) {
  // Two bodies of many voxels that touch in an edge: cubes of two voxels, so every cell there is deep.
  const LabelVolume volume =
      test::make_volume(20, 20, 20, [](int i, int j, int) { return (i < 10) == (j < 10) ? 1 : 2; });
  const LabelField field = field_of(volume);
  LabelledCells cells =
      test::lattice_complex(4, 5, -0.5, [](int i, int j, int) { return (i < 2) == (j < 2) ? 1 : 2; });
  const std::vector<Label> before = cells.labels;
  ASSERT_GT(all_defects(cells), 0U);
  EXPECT_EQ(make_two_manifold(cells, field, find_pinches(cells)), 0U);
  EXPECT_EQ(cells.labels, before);
}

TEST(MakeTwoManifold, LeavesFewPinchesOfATriangulationAsCoarseAsTheBodies) {
  std::size_t before = 0, after = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    test::TestRandom random(seed);
    test::LabelPainter paint({16, 16, 16}, 3, random);
    paint.blobs(0);
    const LabelVolume volume = paint.take();
    const LabelField field = field_of(volume);
    LabelledCells cells = refined(volume, field, 3);
    remove_islands(cells, field, find_pieces(field));
    before += all_defects(cells);
    make_two_manifold(cells, field, find_pinches(cells));
    const std::size_t mended = all_defects(cells);
    after += mended;
    remove_wedges(cells);
    EXPECT_LE(all_defects(cells), mended) << seed;
  }
  RecordProperty("before", static_cast<int>(before));
  RecordProperty("after", static_cast<int>(after));
  EXPECT_GT(before, 0U);
  EXPECT_LE(10 * after, before);
}

TEST(RemoveWedges, AddsNoPinchesAndBluntsWedges) {
  const SizingField sizing = test::uniform_sizing(2);
  double sharpest_before = 180, sharpest_after = 180;
  int manifolds = 0;
  for (int n = 0; n < 6; ++n) {
    const LabelVolume volume = test::heart_volume(26 + n, 22, 22 + n);
    const LabelField field = field_of(volume);
    LabelledCells cells = refined(volume, field, 2);
    remove_islands(cells, field, find_pieces(field));
    make_two_manifold(cells, field, find_pinches(cells));
    const std::size_t mended = all_defects(cells);
    const std::vector<Label> labels = test::labels_of(extract_interface(cells));
    sharpest_before =
        std::min(sharpest_before, test::report_on(extract_interface(cells), sizing).least_dihedral_deg);
    remove_wedges(cells);
    sharpest_after =
        std::min(sharpest_after, test::report_on(extract_interface(cells), sizing).least_dihedral_deg);
    EXPECT_LE(all_defects(cells), mended);
    EXPECT_EQ(test::labels_of(extract_interface(cells)), labels);
    if (mended > 0) continue;
    ++manifolds;
    EXPECT_TRUE(test::is_valid_surface(extract_interface(cells)));
  }
  EXPECT_GE(manifolds, 4);
  EXPECT_LT(sharpest_before, kSharpSectorDeg);
  EXPECT_GT(sharpest_after, sharpest_before);
}

TEST(RemoveIslands, DropsWhatHoldsNoVoxelOfItsLabelUnlessItIsAllThatThereIs) {
  // Cubes of half a voxel; those with three odd numbers hold a voxel centre.
  const LabelVolume volume = test::make_volume(
      10, 10, 10, [](int i, int j, int k) { return i < 4 || (i == 8 && j == 8 && k == 8) ? 1 : 0; });
  for (const bool mirrored : {false, true}) {
    LabelVolume framed = volume;
    if (mirrored) framed.index_to_mm.topLeftCorner<3, 3>() << 0, 1, 0, 1, 0, 0, 0, 0, 1;
    const LabelField field = field_of(framed);
    LabelledCells cells = test::lattice_complex(20, 0.5, -0.6, [&](int i, int j, int k) {
      const std::array<int, 3> cube{i, j, k};
      if (mirrored) std::swap(i, j);
      if (cube == std::array{12, 14, 6}) return 1;   // no centre in it
      if (cube == std::array{13, 13, 3}) return 1;   // a centre of background in it
      if (cube == std::array{17, 17, 17}) return 1;  // the centre of the lone voxel
      if (cube == std::array{16, 14, 4}) return 2;   // nothing else has this label
      return i < 8 ? 1 : 0;
    });
    const auto label_of = [&](int i, int j, int k) {
      return cells.labels[6 * static_cast<std::size_t>(i + 20 * (j + 20 * k))];
    };
    std::vector<InterfaceFacet> torn;
    EXPECT_EQ(remove_islands(cells, field, find_pieces(field), &torn), 12U);
    EXPECT_TRUE(torn.empty()) << "neither holds a voxel of its label";
    EXPECT_EQ(label_of(12, 14, 6), 0);
    EXPECT_EQ(label_of(13, 13, 3), 0);
    EXPECT_EQ(label_of(17, 17, 17), 1);
    EXPECT_EQ(label_of(16, 14, 4), 2);
    EXPECT_EQ(remove_islands(cells, field, find_pieces(field)), 0U);
  }
}

TEST(RemoveIslands, KeepsOneIslandBesideTheCentreOfALoneVoxel) {
  const LabelVolume volume = test::make_volume(
      8, 8, 8, [](int i, int j, int k) { return i < 2 || (i == 4 && j == 3 && k == 3) ? 1 : 0; });
  const LabelField field = field_of(volume);
  const std::array<int, 3> before{13, 9, 9}, centre{14, 9, 9}, behind{15, 9, 9}, away{15, 14, 14};
  const auto remaining = [&](const std::vector<std::array<int, 3>>& islands) {
    LabelledCells cells = test::lattice_complex(20, 0.2, 1.05, [&](int i, int j, int k) {
      const bool in_island = std::find(islands.begin(), islands.end(), std::array{i, j, k}) != islands.end();
      return i < 2 || in_island ? 1 : 0;
    });
    remove_islands(cells, field, find_pieces(field));
    std::vector<std::array<int, 3>> kept;
    for (const auto& [i, j, k] : islands)
      if (cells.labels[6 * static_cast<std::size_t>(i + 20 * (j + 20 * k))] == 1) kept.push_back({i, j, k});
    return kept;
  };
  using Islands = std::vector<std::array<int, 3>>;
  EXPECT_EQ(remaining({centre}), Islands{centre});
  EXPECT_EQ(remaining({behind}), Islands{behind});
  EXPECT_EQ(remaining({before, behind}).size(), 1U) << "there is one voxel";
  EXPECT_EQ(remaining({away}), Islands{}) << "background lies between it and the voxel";
}

TEST(RemoveIslands, GivesAnIslandToTheLabelWithMostOfItsRim) {
  const LabelledCells cells = test::lattice_complex(3, 1, 0, [](int i, int j, int k) {
    return i == 1 && j == 1 && k == 1 ? 5 : i < 2 ? 3 : 4;
  });
  std::vector<std::uint32_t> group;
  for (std::uint32_t c = 0; c < cells.labels.size(); ++c)
    if (cells.labels[c] == 5) group.push_back(c);
  EXPECT_EQ(label_around(cells, group), 3);
}

TEST(RemoveIslands, TellsTheMouthOfAChannelThatWasClosedByALid) {
  // A channel one voxel wide leads from a face of the body to its middle; a layer of cells closes it.
  const LabelVolume volume = test::make_volume(10, 10, 10, [](int i, int j, int k) {
    const bool body = i > 1 && i < 8 && j > 1 && j < 8 && k > 1 && k < 8;
    return body && !(j == 5 && k == 5 && i < 5) ? 1 : 0;
  });
  const LabelField field = field_of(volume);
  constexpr int kLid = 5;
  LabelledCells cells = test::lattice_complex(20, 0.5, -0.6, [&](int i, int j, int k) {
    const auto at = [](int n) { return (n - 1) / 2; };  // two cubes a voxel
    const bool body = at(i) > 1 && at(i) < 8 && at(j) > 1 && at(j) < 8 && at(k) > 1 && at(k) < 8;
    return body && !(at(j) == 5 && at(k) == 5 && at(i) < 5 && i != kLid) ? 1 : 0;
  });
  std::vector<InterfaceFacet> torn;
  EXPECT_GT(remove_islands(cells, field, find_pieces(field), &torn), 0U);
  ASSERT_FALSE(torn.empty());
  for (const InterfaceFacet& facet : torn) {
    const std::uint32_t lid = cells.neighbours[facet.cell][facet.corner];
    EXPECT_EQ(static_cast<int>(lid / 6 % 20), kLid);
    EXPECT_EQ(static_cast<int>(facet.cell / 6 % 20), kLid + 1);
  }
}

/// In background, labels 3 and 4 touch in a strip one cube wide between 1 and 2.
LabelledCells four_around_a_strip() {
  return test::lattice_complex(7, 1, 0, [](int i, int j, int k) {
    if (std::min({i, j, k}) < 1 || std::max({i, j, k}) > 5) return 0;
    return i < 3 ? 1 : i > 3 ? 2 : j < 3 ? 3 : 4;
  });
}

TEST(MendContacts, LetsLabelsTouchThatHaveAStripBetween) {
  LabelledCells cells = four_around_a_strip();
  TopologyLedger wanted = label_topology(extract_interface(cells));
  wanted.contacts.push_back({1, 2});
  std::sort(wanted.contacts.begin(), wanted.contacts.end());
  EXPECT_GT(mend_contacts(cells, wanted.contacts, {{{1, 2}, {Vector3d(3.5, 3, 3.5)}}}, 0.1), 0U);
  EXPECT_EQ(label_topology(extract_interface(cells)), wanted);
  EXPECT_EQ(all_defects(cells), 0U);
}

TEST(MendContacts, PartsLabelsThatAreNotToTouch) {
  LabelledCells cells = four_around_a_strip();
  const TopologyLedger wanted = label_topology(extract_interface(cells));
  TopologyLedger other = wanted;
  other.contacts.push_back({1, 2});
  std::sort(other.contacts.begin(), other.contacts.end());
  mend_contacts(cells, other.contacts, {{{1, 2}, {Vector3d(3.5, 3, 3.5)}}}, 0.1);
  ASSERT_EQ(label_topology(extract_interface(cells)), other);
  EXPECT_GT(mend_contacts(cells, wanted.contacts, {}, 0.1), 0U);
  EXPECT_EQ(label_topology(extract_interface(cells)), wanted);
  EXPECT_EQ(all_defects(cells), 0U);
}

TEST(MendContacts, ChangesNothingOnceCancelled) {
  LabelledCells cells = four_around_a_strip();
  const std::vector<Label> before = cells.labels;
  TopologyLedger wanted = label_topology(extract_interface(cells));
  wanted.contacts.push_back({1, 2});
  std::sort(wanted.contacts.begin(), wanted.contacts.end());
  RunContext ctx;
  ctx.on_cancelled = [] { return true; };
  EXPECT_EQ(mend_contacts(cells, wanted.contacts, {{{1, 2}, {Vector3d(3.5, 3, 3.5)}}}, 0.1, ctx), 0U);
  EXPECT_EQ(cells.labels, before);
}

TEST(MendContacts, PiercesNoLabelThatPartsOthers) {
  // The wall 3 between 1 and 2 has no edge within reach where a fourth label would let them meet.
  const auto wall = [] {
    return test::lattice_complex(9, 1, 0, [](int i, int j, int k) {
      if (std::min({i, j, k}) < 1 || std::max({i, j, k}) > 7) return 0;
      return i < 4 ? 1 : i > 4 ? 2 : 3;
    });
  };
  LabelledCells cells = wall();
  std::vector<Contact> wanted = label_topology(extract_interface(cells)).contacts;
  wanted.push_back({1, 2});
  std::sort(wanted.begin(), wanted.end());
  EXPECT_EQ(mend_contacts(cells, wanted, {{{1, 2}, {Vector3d(4.5, 4.5, 4.5)}}}, 0.1), 0U);
  EXPECT_EQ(cells.labels, wall().labels);
}

// In the corner of a cut with a step lie loose cells of the body: in the cut's plane their walls would lie
// upon its faces.
TEST(RemoveCutFolds, GivesFlatCellsAwayAndNoOthers) {
  constexpr Label kBody = 1, kBeyond = 9;
  LabelledCells cells = test::lattice_complex(6, 1, 0, [](int i, int j, int k) {
    if (std::min({i, j, k}) < 1 || std::max({i, j, k}) > 4) return 0;
    return k >= 3 || (i < 3 && k >= 2) ? int{kBeyond} : i >= 3 && k == 1 ? int{kBody} : 0;
  });
  const auto is_on_cut = [&](std::uint32_t p) {
    const Vector3d& at = cells.points[p];
    return at.x() == 3 ? at.z() >= 2 && at.z() <= 3 : at.x() > 3 && at.z() == 3;
  };
  std::size_t flat = 0, deep = 0;
  for (std::size_t c = 0; c < cells.labels.size(); ++c) {
    const auto& corners = cells.vertices[c];
    if (cells.labels[c] == kBody) ++deep;
    const auto faces =
        std::count_if(cells.neighbours[c].begin(), cells.neighbours[c].end(),
                      [&](std::uint32_t other) { return cells.label_or_background(other) == kBeyond; });
    if (cells.labels[c] == 0 && faces == 2 && std::all_of(corners.begin(), corners.end(), is_on_cut)) {
      cells.labels[c] = kBody;
      ++flat;
    }
  }
  ASSERT_GT(flat, 3U);
  CutPlane cut;
  cut.beyond = kBeyond;
  cut.labels = {kBody};
  const auto folded_walls = [&] {
    std::size_t walls = 0;
    for (const InterfaceFacet& fold : find_cut_folds({cut}, cells, find_interface_edges(cells).facets))
      if (cells.labels[fold.cell] == kBody) ++walls;
    return walls;
  };
  ASSERT_GT(folded_walls(), 3U);
  const std::size_t defects = all_defects(cells);
  remove_cut_folds({cut}, cells);
  EXPECT_EQ(folded_walls(), 0U);
  EXPECT_EQ(static_cast<std::size_t>(std::count(cells.labels.begin(), cells.labels.end(), kBody)), deep);
  EXPECT_LE(all_defects(cells), defects);
}

}  // namespace
}  // namespace voxtet::remesh
