#include "surface/smooth/surface_graph.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/check_surface.h"
#include "support/random_labels.h"
#include "surface/extract/extract_surface.h"

namespace voxtet {
namespace {

/// Two cones of labels 2 (above) and 1 (below) on a common disc of n rim points: their junction is a loop of
/// n.
SurfaceMesh double_cone(std::uint32_t n) {
  SurfaceMesh surface;
  surface.points = {{0, 0, 1}, {0, 0, -1}, {0, 0, 0}};
  for (std::uint32_t i = 0; i < n; ++i) {
    // A convex rim without trigonometry: the rational parametrisation of the circle.
    const double half = 2.0 * i / n < 1 ? 4.0 * i / n - 1 : 4.0 * i / n - 3;
    const double side = 2.0 * i / n < 1 ? 1 : -1;
    surface.points.emplace_back(side * (1 - half * half) / (1 + half * half),
                                side * 2 * half / (1 + half * half), 0);
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = 3 + i, b = 3 + (i + 1) % n;
    surface.triangles.insert(surface.triangles.end(), {{0, a, b}, {1, b, a}, {2, b, a}});
    surface.sides.insert(surface.sides.end(), {{2, 0}, {1, 0}, {2, 1}});
  }
  return surface;
}

TEST(SurfaceGraph, FixesShortJunctionLoopsOnly) {
  for (const std::uint32_t n : {4U, 10U, 11U, 30U}) {
    const SurfaceMesh surface = double_cone(n);
    ASSERT_TRUE(test::is_valid_surface(surface));
    const SurfaceGraph graph = build_surface_graph(surface);
    for (std::size_t v = 0; v < 3; ++v) {
      EXPECT_EQ(graph.kinds[v], VertexKind::kSurface);
      EXPECT_EQ(graph.of(v).size(), n);
    }
    for (std::uint32_t v = 3; v < 3 + n; ++v)
      EXPECT_EQ(graph.kinds[v], n <= kLongestFixedLoop ? VertexKind::kFixed : VertexKind::kJunction) << n;
  }
}

TEST(SurfaceGraph, GivesJunctionVerticesTheirTwoNeighboursAlongTheCurve) {
  const std::uint32_t n = 20;
  const SurfaceGraph graph = build_surface_graph(double_cone(n));
  for (std::uint32_t i = 0; i < n; ++i) {
    std::vector<std::uint32_t> expected{3 + (i + 1) % n, 3 + (i + n - 1) % n};
    std::sort(expected.begin(), expected.end());
    const auto row = graph.of(3 + i);
    EXPECT_EQ(std::vector<std::uint32_t>(row.begin(), row.end()), expected);
  }
}

TEST(SurfaceGraph, ClassifiesVerticesByTheirNumberOfLabels) {
  const LabelVolume noise = test::random_volume(10, 4, 3);
  RunContext ctx;
  const SurfaceMesh surface = extract_surface(noise, {}, ctx).value();
  std::vector<std::vector<Label>> labels(surface.points.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (const std::uint32_t v : surface.triangles[t])
      for (const Label label : surface.sides[t])
        if (std::find(labels[v].begin(), labels[v].end(), label) == labels[v].end())
          labels[v].push_back(label);
  const SurfaceGraph graph = build_surface_graph(surface);
  std::array<std::size_t, 3> count{};
  for (std::size_t v = 0; v < labels.size(); ++v) {
    ++count[static_cast<std::size_t>(graph.kinds[v])];
    ASSERT_EQ(graph.kinds[v] == VertexKind::kSurface, labels[v].size() == 2);
    ASSERT_TRUE(labels[v].size() < 4 || graph.kinds[v] == VertexKind::kFixed);
  }
  for (const std::size_t c : count) EXPECT_GT(c, 0U);
}

}  // namespace
}  // namespace voxtet
