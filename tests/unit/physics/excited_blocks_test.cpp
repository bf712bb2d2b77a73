#include "physics/monodomain/excited_blocks.h"

#include <gtest/gtest.h>

#include <numeric>

#include "physics/fem/assemble.h"
#include "support/bricks.h"

namespace voxtet {
namespace {

/// How many points the ranges hold, and the least and the largest of them.
struct Extent {
  int count = 0, first = 1 << 30, last = -1;
  bool operator==(const Extent&) const = default;
};

Extent extent_of(const fem::RowRanges& ranges) {
  Extent found;
  for (const auto [first, last] : ranges) {
    found.count += last - first;
    found.first = std::min(found.first, first);
    found.last = std::max(found.last, last);
  }
  return found;
}

/// A bar of 200 elements along x, 4 points to each of its 201 places, in their order.
struct Bar {
  TetMesh mesh;
  ExcitedBlocks blocks;
  Eigen::VectorXd v, w;

  Bar() : mesh(test::bricks({200, 1, 1}, {200, 1, 1})) {
    std::vector<std::uint32_t> order(mesh.points.size()), number(mesh.points.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return mesh.points[a].x() < mesh.points[b].x();
    });
    TetMesh sorted = mesh;
    for (std::uint32_t i = 0; i < order.size(); ++i)
      number[order[i]] = i, sorted.points[i] = mesh.points[order[i]];
    for (Tet& tet : sorted.tets)
      for (std::uint32_t& point : tet) point = number[point];
    mesh = sorted;
    blocks = ExcitedBlocks(fem::empty_matrix(mesh));
    v = Eigen::VectorXd::Zero(804);
    w = Eigen::VectorXd::Ones(804);
  }
};

TEST(ExcitedBlocks, HoldWhatAWaveCanReachInOneStep) {
  Bar bar;
  bar.blocks.update(bar.v, bar.w, {});
  EXPECT_TRUE(bar.blocks.rows().empty());
  EXPECT_EQ(extent_of(bar.blocks.left()), (Extent{804, 0, 804}));

  bar.v[403] = 1e-5;  // place 100: of points 400 to 415, whose elements touch the blocks before and after
  bar.blocks.update(bar.v, bar.w, {});
  EXPECT_EQ(extent_of(bar.blocks.rows()), (Extent{48, 384, 432}));
  EXPECT_TRUE(bar.blocks.left().empty());

  bar.v[403] = 0;
  bar.w[400] = 0.5;
  std::vector<double> current(804);
  current[803] = 0.5;
  bar.blocks.update(bar.v, bar.w, current);
  EXPECT_EQ(extent_of(bar.blocks.rows()), (Extent{20, 784, 804}));  // the last block has 4 points
  EXPECT_EQ(extent_of(bar.blocks.left()), (Extent{48, 384, 432}));
  EXPECT_EQ(extent_of(bar.blocks.recovering()), (Extent{16, 400, 416}));
}

}  // namespace
}  // namespace voxtet
