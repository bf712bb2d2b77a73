#include "surface/extract/cell_tables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace voxtet {
namespace {

TEST(CubeTable, UsesExactlyTheCrossedEdges) {
  for (unsigned mask = 0; mask < 256; ++mask) {
    std::set<int> crossed, used;
    for (int e = 0; e < 12; ++e) {
      const CellEdge edge = CubeTable::kEdges[static_cast<std::size_t>(e)];
      const unsigned bottom = edge.top ^ edge.direction;
      if (((mask >> edge.top) & 1) != ((mask >> bottom) & 1)) crossed.insert(e);
    }
    for (const auto& t : cube_table().triangles(mask)) used.insert(t.begin(), t.end());
    EXPECT_EQ(used, crossed) << mask;
  }
}

TEST(CubeTable, SeparatesForegroundOnAmbiguousFaces) {
  // Corners 0 and 3 touch across a face diagonal only: each keeps its own triangle.
  EXPECT_EQ(cube_table().triangles(0b00001001).size(), 2U);
  EXPECT_EQ(cube_table().triangles(0b10000001).size(), 2U);
  // Two background corners across a face diagonal are joined: one hexagon, four triangles.
  EXPECT_EQ(cube_table().triangles(0b11110110).size(), 4U);
}

TEST(TetTable, HasTheTriangleCountsOfTheFivePartitions) {
  const auto size_of = [](const std::array<int, 4>& labels) {
    unsigned code = 0;
    for (unsigned e = 0; e < 6; ++e)
      if (labels[kTetEdges[e][0]] != labels[kTetEdges[e][1]]) code |= 1U << e;
    return tet_table().triangles(code).size();
  };
  EXPECT_EQ(size_of({1, 1, 1, 1}), 0U);
  EXPECT_EQ(size_of({1, 2, 1, 1}), 1U);
  EXPECT_EQ(size_of({1, 2, 1, 2}), 2U);
  EXPECT_EQ(size_of({1, 2, 1, 3}), 5U);
  EXPECT_EQ(size_of({1, 2, 3, 4}), 12U);
}

TEST(TetTable, LeavesImpossibleCasesEmpty) {
  std::size_t filled = 0;
  for (unsigned code = 0; code < 64; ++code) filled += tet_table().triangles(code).empty() ? 0 : 1;
  EXPECT_EQ(filled, 14U);  // the 15 partitions of four corners, less the uniform one
}

}  // namespace
}  // namespace voxtet
