// Points made a Delaunay triangulation.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <vector>

#include "geometry/delaunay/delaunay_triangulation.h"

namespace voxtet::test {

/// The points one after the other, in their order; those that are there already are left out.
inline DelaunayTriangulation triangulated(const std::vector<Eigen::Vector3d>& points) {
  DelaunayTriangulation t;
  for (const Eigen::Vector3d& p : points) t.add_point(p);
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  EXPECT_TRUE(t.begin(order));
  DelaunayTriangulation::Cavity cavity;
  DelaunayTriangulation::Stock stock;
  std::uint32_t from = 0;
  for (const std::uint32_t v : order) {
    if (t.in_use(v)) continue;
    const std::uint32_t first = t.locate(points[v], from);
    if (t.has_corner_at(first, points[v])) continue;
    t.find_cavity(points[v], first, cavity);
    t.stock_up(stock, cavity.rim.size());
    t.insert(v, cavity, stock);
    from = stock.made.front();
  }
  return t;
}

}  // namespace voxtet::test
