// A labelled surface cut by a plane.
#include "geometry/cut/clip_surface.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/cut/cut_faces.h"
#include "geometry/cut/triangulate_section.h"
#include "geometry/elements/surface_measures.h"
#include "geometry/topology/label_topology.h"
#include "surface/extract/extract_surface.h"

namespace voxtet {
namespace {

/// Two boxes of 6 x 12 x 12 voxels side by side.
LabelVolume two_boxes() {
  LabelVolume volume;
  volume.size = {16, 16, 16};
  volume.labels.resize(volume.voxel_count());
  volume.visit([&](int i, int j, int k, std::size_t at) {
    const bool in = i >= 2 && j >= 2 && k >= 2 && i < 14 && j < 14 && k < 14;
    volume.labels[at] = !in ? 0 : i < 8 ? 1 : 2;
  });
  return volume;
}

/// The surface, and the plane's labels beyond, cut by a plane through the middle.
struct Clipped {
  SurfaceMesh before, after;
  CutPlanes cuts;
};

Clipped clip(const Eigen::Vector3d& normal, double offset_mm, std::vector<Label> labels) {
  LabelVolume volume = two_boxes();
  Clipped out;
  RunContext ctx;
  out.before = *extract_surface(volume, {ExtractMethod::kMarchingTets}, ctx);
  CutPlane cut;
  cut.beyond = 9;
  cut.normal = normal.normalized();
  cut.offset_mm = offset_mm;
  cut.labels = std::move(labels);
  cut.reach_mm = 3;
  out.cuts = {cut};
  volume.visit([&](int i, int j, int k, std::size_t at) {
    const double distance = cut.distance_mm(volume.to_mm(i, j, k));
    if (cut.cuts(volume.labels[at]) && distance > 0) volume.labels[at] = distance > 3 ? 0 : 9;
  });
  std::optional<SurfaceMesh> after = clip_surface(out.before, volume, out.cuts, 0, ctx);
  EXPECT_TRUE(after.has_value());
  if (after) out.after = std::move(*after);
  return out;
}

void expect_sound(const SurfaceMesh& surface) {
  for (const LabelTopology& label : label_topology(surface).labels) {
    EXPECT_EQ(label.open_edges, 0U) << label.label;
    EXPECT_EQ(label.components, 1U) << label.label;
    EXPECT_EQ(label.pinched_edges, 0U) << label.label;
  }
  for (const Sides& sides : surface.sides) EXPECT_GT(sides[0], sides[1]);
}

TEST(ClipSurface, PartsLabelsFromWhatIsBeyond) {
  const Eigen::Vector3d normal(0.2, -0.3, 1);
  const Clipped found = clip(normal, normal.normalized().dot(Eigen::Vector3d(7.5, 7.5, 8.2)), {1, 2});
  expect_sound(found.after);
  const CutPlane& cut = found.cuts[0];
  std::size_t faces = 0;
  for (std::size_t t = 0; t < found.after.triangles.size(); ++t) {
    if (found.after.sides[t][0] != 9 || found.after.sides[t][1] == 0) continue;
    ++faces;
    for (const std::uint32_t p : found.after.triangles[t])
      EXPECT_LT(std::abs(cut.distance_mm(found.after.points[p])), 1e-9);
  }
  EXPECT_GT(faces, 200U);
  // Extracted boxes have 12 voxels along each axis; the plane passes through a prism's axis at 8.2.
  const std::vector<double> volumes = enclosed_volumes_mm3(without_beyond(found.after, found.cuts));
  EXPECT_NEAR(volumes[1] + volumes[2], 12 * 12 * (8.2 - 1.5), 0.02 * 12 * 12 * 6.7);
}

TEST(ClipSurface, LeavesOtherLabels) {
  const Eigen::Vector3d normal(0.1, 0.2, 1);
  const Clipped found = clip(normal, normal.normalized().dot(Eigen::Vector3d(5, 7.5, 8.2)), {1});
  expect_sound(found.after);
  const std::vector<double> before = enclosed_volumes_mm3(found.before),
                            after = enclosed_volumes_mm3(found.after);
  EXPECT_NEAR(after[2], before[2], 1e-4 * before[2]);  // points by the plane were put into it
  EXPECT_LT(after[1], 0.6 * before[1]);
}

// A plane in which faces of the staircase lie: these are its faces, or go.
TEST(ClipSurface, TakesFacesInThePlane) {
  for (const double offset : {13.5, 8.0, 7.5, 1.5 + 1e-13}) {
    const Clipped found = clip(Eigen::Vector3d::UnitX(), offset, {1, 2});
    for (const LabelTopology& label : label_topology(found.after).labels)
      EXPECT_EQ(label.open_edges, 0U) << label.label << " at " << offset;
  }
}

// A label that planes cut away may have a thin slice left in the surface, and no voxel.
TEST(ClipSurface, DropsWhatHasNoVoxelLeft) {
  const LabelVolume volume = two_boxes();
  RunContext ctx;
  SurfaceMesh surface = *extract_surface(volume, {ExtractMethod::kMarchingTets}, ctx);
  LabelVolume left = volume;
  std::replace(left.labels.begin(), left.labels.end(), Label{1}, kBackground);
  drop_lost_labels(surface, left);
  expect_sound(surface);
  const std::vector<double> volumes = enclosed_volumes_mm3(surface);
  ASSERT_EQ(volumes.size(), 3U);
  EXPECT_EQ(volumes[1], 0);
  EXPECT_NEAR(volumes[2], 6 * 12 * 12, 0.05 * 6 * 12 * 12);
  const SurfaceMesh before = surface;
  drop_lost_labels(surface, left);
  EXPECT_EQ(surface.triangles, before.triangles);
  EXPECT_EQ(surface.sides, before.sides);
}

TEST(TriangulateSection, KeepsRegionsApart) {
  // A square of label 1 with a square hole, and label 2 beside it.
  const std::vector<Eigen::Vector2d> points{{0, 0}, {6, 0}, {6, 6}, {0, 6}, {2, 2},
                                            {4, 2}, {4, 4}, {2, 4}, {9, 0}, {9, 6}};
  using Of = SectionEdge::Of;
  const std::vector<SectionEdge> edges{
      {0, 1, 1, 0, Of::kAbove}, {1, 2, 1, 2, Of::kAbove}, {2, 3, 1, 0, Of::kAbove}, {3, 0, 1, 0, Of::kAbove},
      {4, 5, 0, 1, Of::kAbove}, {5, 6, 0, 1, Of::kAbove}, {6, 7, 0, 1, Of::kAbove}, {7, 4, 0, 1, Of::kAbove},
      {1, 8, 2, 0, Of::kAbove}, {8, 9, 2, 0, Of::kAbove}, {9, 2, 2, 0, Of::kAbove}};
  const auto found = triangulate_section(
      points, edges, [](Label label) { return label != 0; }, 0.5);
  ASSERT_TRUE(found.has_value());
  std::vector<Eigen::Vector2d> all = points;
  all.insert(all.end(), found->added.begin(), found->added.end());
  std::array<double, 3> areas{};
  for (std::size_t t = 0; t < found->triangles.size(); ++t) {
    const auto& [a, b, c] = found->triangles[t];
    const Eigen::Vector2d u = all[b] - all[a], v = all[c] - all[a];
    EXPECT_GT(u.x() * v.y() - u.y() * v.x(), 0);
    areas[found->labels[t]] += 0.5 * (u.x() * v.y() - u.y() * v.x());
  }
  EXPECT_NEAR(areas[1], 32, 1e-9);
  EXPECT_NEAR(areas[2], 18, 1e-9);
  EXPECT_GT(found->added.size(), 100U);
}

TEST(TriangulateSection, RefusesEdgesThatCross) {
  using Of = SectionEdge::Of;
  const std::vector<Eigen::Vector2d> points{{0, 0}, {2, 2}, {0, 2}, {2, 0}};
  EXPECT_FALSE(
      triangulate_section(
          points, {{0, 1, 1, 0, Of::kAbove}, {2, 3, 1, 0, Of::kAbove}}, [](Label) { return true; }, 1)
          .has_value());
}

}  // namespace
}  // namespace voxtet
