// Refinement ends with facets that are as asked for, and not with more of them than that takes.
#include "remesh/delaunay/delaunay_refiner.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "field_of.h"
#include "geometry/elements/surface_measures.h"
#include "geometry/elements/triangle_measures.h"
#include "remesh/cells/extract_interface.h"
#include "remesh/delaunay/seed_interfaces.h"
#include "support/label_bodies.h"
#include "support/test_surfaces.h"

namespace voxtet::remesh {
namespace {

TEST(DelaunayRefiner, MakesFacetsAsLargeAsTheyMayBe) {
  const LabelVolume volume = test::ball_volume(40, 19.6, 15);
  const LabelField field = field_of(volume);
  for (const double edge : {2.0, 3.5}) {
    const SizingField sizing = test::uniform_sizing(edge);
    const Seeds seeds = seed_interfaces(field, test::label_surface(volume), sizing, {});
    const double radius = edge / 1.32;
    DelaunayRefiner refiner(field, sizing, {30, 0.5, 1 / 1.32});
    refiner.insert(seeds.points, 0.25);
    RunContext ctx;
    ASSERT_TRUE(refiner.refine(ctx, seeds.predicted_vertices));
    const SurfaceMesh surface = extract_interface(refiner.cells());
    double area = 0;
    for (const Triangle& t : surface.triangles) {
      const Eigen::Vector3d &a = surface.points[t[0]], &b = surface.points[t[1]], &c = surface.points[t[2]];
      const double twice = triangle_cross(a, b, c).norm();
      EXPECT_LE((a - b).norm() * (b - c).norm() * (c - a).norm() / (2 * twice), 1.001 * radius);
      EXPECT_LE(sharpest_cosine({a, b, c}), std::cos(29.9 * EIGEN_PI / 180));
      area += twice / 2;
    }
    // Equilateral triangles with the largest circumcircles have 1.3 times the squared radius for their area.
    const double per_facet = area / static_cast<double>(surface.triangles.size()) / (radius * radius);
    EXPECT_GT(per_facet, 0.65);
    EXPECT_LT(per_facet, 1.3);
  }
}

}  // namespace
}  // namespace voxtet::remesh
