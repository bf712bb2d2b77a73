#include "geometry/topology/label_topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <set>
#include <vector>

#include "support/label_bodies.h"
#include "support/random_labels.h"
#include "support/test_surfaces.h"
#include "surface/extract/extract_surface.h"

namespace voxtet {

void PrintTo(const LabelTopology& t, std::ostream* out) {
  *out << "label " << t.label << ": components " << t.components << ", cavities " << t.cavities
       << ", handles " << t.handles << ", euler " << t.euler << ", pinched edges " << t.pinched_edges
       << ", pinched points " << t.pinched_points << ", open edges " << t.open_edges;
}

namespace {

using Contacts = std::vector<std::array<Label, 2>>;

LabelTopology topology(Label label, std::uint32_t components, std::uint32_t cavities, std::uint32_t handles) {
  const int euler = 2 * (static_cast<int>(components + cavities) - static_cast<int>(handles));
  return {label, components, cavities, handles, euler, 0, 0, 0};
}

LabelTopology pinched(LabelTopology t, std::uint32_t edges, std::uint32_t points) {
  t.pinched_edges = edges;
  t.pinched_points = points;
  return t;
}

/// The only label of a complex.
LabelTopology lone(const SurfaceMesh& surface) {
  const TopologyLedger ledger = label_topology(surface);
  EXPECT_EQ(ledger.labels.size(), 1U);
  return ledger.labels.front();
}

SurfaceMesh marched(const LabelVolume& volume) {
  RunContext ctx;
  Result<SurfaceMesh> surface = extract_surface(volume, {ExtractMethod::kMarchingTets}, ctx);
  EXPECT_TRUE(surface.ok());
  return std::move(surface).value();
}

/// Unit cells of label 1 at the given places.
SurfaceMesh boxes(const std::set<std::array<int, 3>>& places) {
  return test::cells({5, 5, 5}, 1, [&](int i, int j, int k) -> Label { return places.count({i, j, k}); });
}

TEST(LabelTopology, KnowsBallTorusAndDoubleTorus) {
  EXPECT_EQ(lone(test::sphere({1, 2, 3}, 5, 2, 4, 0)), topology(4, 1, 0, 0));
  EXPECT_EQ(lone(test::torus(5, 2, 24, 12, 7)), topology(7, 1, 0, 1));
  const SurfaceMesh two = marched(test::make_volume(40, 22, 12, [](int i, int j, int k) {
    return test::in_torus(i - 11.0, j - 11.0, k - 5.5, 7, 3) ||
           test::in_torus(i - 27.0, j - 11.0, k - 5.5, 7, 3);
  }));
  EXPECT_EQ(lone(two), topology(1, 1, 0, 2));
}

TEST(LabelTopology, TellsCavitiesFromComponents) {
  SurfaceMesh shell = test::sphere({0, 0, 0}, 5, 2, 1, 0);
  test::append(shell, test::sphere({0, 0, 0}, 3, 2, 0, 1));
  EXPECT_EQ(lone(shell), topology(1, 1, 1, 0));
  test::append(shell, test::sphere({1, 0, 0}, 1, 1, 1, 0));
  EXPECT_EQ(lone(shell), topology(1, 2, 1, 0)) << "a ball within the cavity";
  test::append(shell, test::sphere({1e5, 1e5, 1e5}, 1, 1, 1, 0));
  EXPECT_EQ(lone(shell), topology(1, 3, 1, 0)) << "far from the rest";
}

TEST(LabelTopology, GivesNestedBoxesTheirShellsAndContacts) {
  const SurfaceMesh nested = test::cells({7, 7, 7}, 0.5, [](int i, int j, int k) -> Label {
    const int depth = std::min({i, j, k, 6 - i, 6 - j, 6 - k});
    return depth == 0 ? 3 : depth == 1 ? 2 : 9;
  });
  const TopologyLedger ledger = label_topology(nested);
  EXPECT_EQ(ledger.labels, (std::vector{topology(2, 1, 1, 0), topology(3, 1, 1, 0), topology(9, 1, 0, 0)}));
  EXPECT_EQ(ledger.contacts, (Contacts{{0, 3}, {2, 3}, {2, 9}}));
}

TEST(LabelTopology, GoesThroughTheJunctionsOfThreeMaterials) {
  const SurfaceMesh cube = test::cells({4, 4, 4}, 1, [](int i, int j, int) -> Label {
    return i < 2 ? 1 : j < 2 ? 2 : 3;
  });
  const TopologyLedger ledger = label_topology(cube);
  EXPECT_EQ(ledger.labels, (std::vector{topology(1, 1, 0, 0), topology(2, 1, 0, 0), topology(3, 1, 0, 0)}));
  EXPECT_EQ(ledger.contacts, (Contacts{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}));
}

TEST(LabelTopology, JoinsNothingWhereBoxesTouchAlongAnEdgeOrInAPoint) {
  EXPECT_EQ(lone(boxes({{1, 1, 1}, {2, 2, 1}})), pinched(topology(1, 2, 0, 0), 1, 0));
  EXPECT_EQ(lone(boxes({{1, 1, 1}, {2, 2, 2}})), pinched(topology(1, 2, 0, 0), 0, 1));
  EXPECT_EQ(lone(boxes({{1, 1, 1}, {2, 2, 1}, {1, 1, 2}, {2, 2, 2}})), pinched(topology(1, 2, 0, 0), 2, 0));
  EXPECT_EQ(lone(boxes({{1, 1, 1}, {2, 2, 1}, {3, 1, 1}, {2, 0, 1}})), pinched(topology(1, 4, 0, 0), 4, 0))
      << "four boxes in a ring of touches are no ring";
  EXPECT_EQ(lone(boxes({{1, 1, 1}, {2, 2, 1}, {1, 1, 2}, {2, 2, 3}})), pinched(topology(1, 3, 0, 0), 1, 1))
      << "an edge and a point that are not neighbours";
  EXPECT_EQ(lone(boxes({{1, 1, 1}, {2, 2, 1}, {1, 2, 2}})), pinched(topology(1, 3, 0, 0), 3, 0))
      << "three edges that meet in a point";
}

TEST(LabelTopology, MakesNoHandleOfABodyThatTouchesItself) {
  // Seven of the eight cells around a hole, the ring closed by a touch along an edge.
  const std::set<std::array<int, 3>> hook{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0},
                                          {2, 2, 0}, {0, 1, 0}, {1, 2, 0}};
  EXPECT_EQ(lone(boxes(hook)), pinched(topology(1, 1, 0, 0), 1, 0));
  std::set<std::array<int, 3>> ring = hook;
  ring.insert({0, 2, 0});
  EXPECT_EQ(lone(boxes(ring)), topology(1, 1, 0, 1));
}

TEST(LabelTopology, PairsThreeBladesOfOneEdgeByTheWedgesOfTheLabel) {
  // Three tetrahedra on the z axis, 120 degrees apart, each 60 degrees wide.
  SurfaceMesh blades;
  blades.points = {{0, 0, 0},  {0, 0, 1},  {3, -1, 0},  {3, 1, 0},
                   {-1, 3, 0}, {-2, 2, 0}, {-2, -2, 0}, {-1, -3, 0}};
  for (const std::uint32_t p : {2U, 4U, 6U})
    for (const Triangle& t :
         {Triangle{0, p + 1, p}, Triangle{1, p, p + 1}, Triangle{0, p, 1}, Triangle{0, 1, p + 1}}) {
      blades.triangles.push_back(t);
      blades.sides.push_back({5, 0});
    }
  EXPECT_EQ(lone(blades), pinched(topology(5, 3, 0, 0), 1, 0));
  // The same seen from the other side: one solid with three slots that meet in an edge.
  for (Triangle& t : blades.triangles) std::swap(t[1], t[2]);
  SurfaceMesh solid = test::sphere({0, 0, 0.5}, 20, 2, 5, 0);
  test::append(solid, blades);
  EXPECT_EQ(lone(solid), pinched(topology(5, 1, 1, 0), 1, 0));
}

TEST(LabelTopology, CountsTheEdgesOfAHole) {
  SurfaceMesh open = test::cells({3, 3, 3}, 1, [](int i, int, int) -> Label { return i == 0 ? 2 : 1; });
  const auto outer = std::find(open.sides.begin(), open.sides.end(), Sides{1, 0}) - open.sides.begin();
  open.triangles.erase(open.triangles.begin() + outer);
  open.sides.erase(open.sides.begin() + outer);
  const TopologyLedger ledger = label_topology(open);
  EXPECT_EQ(ledger.labels[0].open_edges, 3U);
  EXPECT_EQ(ledger.labels[1], topology(2, 1, 0, 0));
}

TEST(LabelTopology, OfNothingIsEmpty) {
  EXPECT_EQ(label_topology({}), TopologyLedger{});
}

/// Betti numbers of the Kuhn lattice's simplices of which all corners have a label: what marching tetrahedra
/// make a neighbourhood of. Counted on the volume alone.
class LatticeCounts {
 public:
  explicit LatticeCounts(const LabelVolume& volume) : volume_(volume) {}

  LabelTopology of(Label label) const {
    const auto inside = [&](int i, int j, int k) { return volume_.at_or_background(i, j, k) == label; };
    LabelTopology t;
    t.label = label;
    t.components = components(inside);
    t.cavities = components([&](int i, int j, int k) { return !inside(i, j, k); }) - 1;
    t.handles = static_cast<std::uint32_t>(static_cast<int>(t.components + t.cavities) - euler(inside));
    t.euler = 2 * euler(inside);
    return t;
  }

  Contacts contacts() const {
    std::set<std::array<Label, 2>> found;
    for_each([&](int i, int j, int k) {
      const Label a = volume_.at_or_background(i, j, k);
      for (unsigned d = 1; d < 8; ++d)
        if (const Label b = volume_.at_or_background(i + bit(d, 0), j + bit(d, 1), k + bit(d, 2)); b != a)
          found.insert({std::min(a, b), std::max(a, b)});
    });
    return {found.begin(), found.end()};
  }

 private:
  using Inside = std::function<bool(int, int, int)>;
  static int bit(unsigned d, unsigned axis) { return static_cast<int>((d >> axis) & 1U); }

  /// All lattice points with one layer around the volume.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (int k = -1; k <= volume_.size[2]; ++k)
      for (int j = -1; j <= volume_.size[1]; ++j)
        for (int i = -1; i <= volume_.size[0]; ++i) visit(i, j, k);
  }

  std::uint32_t components(const Inside& inside) const {
    std::set<std::array<int, 3>> left;
    for_each([&](int i, int j, int k) {
      if (inside(i, j, k)) left.insert({i, j, k});
    });
    std::uint32_t count = 0;
    for (; !left.empty(); ++count) {
      std::vector<std::array<int, 3>> stack{*left.begin()};
      left.erase(left.begin());
      while (!stack.empty()) {
        const auto [i, j, k] = stack.back();
        stack.pop_back();
        for (unsigned d = 1; d < 8; ++d)
          for (const int s : {-1, 1}) {
            const std::array<int, 3> to{i + s * bit(d, 0), j + s * bit(d, 1), k + s * bit(d, 2)};
            if (left.erase(to) > 0) stack.push_back(to);
          }
      }
    }
    return count;
  }

  /// Alternating sum over chains 0 < d1 < d2 < d3 of steps from each lattice point.
  int euler(const Inside& inside) const {
    int sum = 0;
    for_each([&](int i, int j, int k) {
      const auto in = [&](unsigned d) { return inside(i + bit(d, 0), j + bit(d, 1), k + bit(d, 2)); };
      if (!in(0)) return;
      const std::function<int(unsigned, int)> chains = [&](unsigned from, int sign) {
        int total = sign;
        for (unsigned to = from + 1; to < 8; ++to)
          if ((to & from) == from && in(to)) total += chains(to, -sign);
        return total;
      };
      sum += chains(0, 1);
    });
    return sum;
  }

  const LabelVolume& volume_;
};

TEST(LabelTopology, AgreesWithCountsOnTheVoxelsOfRandomNoise) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const int n = 3 + static_cast<int>(seed % 6), labels = 1 + static_cast<int>(seed % 5);
    const LabelVolume volume = test::random_volume(n, labels, seed);
    const LatticeCounts counts(volume);
    std::vector<LabelTopology> expected;
    for (Label label = 1; label <= labels; ++label)
      if (std::count(volume.labels.begin(), volume.labels.end(), label) > 0)
        expected.push_back(counts.of(label));
    const TopologyLedger ledger = label_topology(marched(volume));
    ASSERT_EQ(ledger.labels, expected) << "seed " << seed;
    ASSERT_EQ(ledger.contacts, counts.contacts()) << "seed " << seed;
  }
}

}  // namespace
}  // namespace voxtet
