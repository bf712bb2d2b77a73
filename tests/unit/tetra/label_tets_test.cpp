// What a mesher may have done wrong is found, each fault for what it is.
#include "tetra/fill/label_tets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "support/labelled_mesh.h"

namespace voxtet {
namespace {

const TetMesh& sound() {
  static const TetMesh mesh = test::kuhn_cube(4);
  return mesh;
}

SurfaceMesh surface() {
  return {sound().points, sound().faces, sound().face_sides};
}

/// As a mesher would give it: regions by number, not by label.
FilledParts filled() {
  FilledParts parts{sound().points, sound().tets, {}};
  for (const Label label : sound().labels) parts.regions.push_back(label == 300 ? 0 : label == 7 ? 1 : 2);
  return parts;
}

/// The first tet with so many corners on the boundary between labels.
std::size_t tet_with_corners_on_faces(int corners) {
  std::vector<int> on_face(sound().points.size(), 0);
  for (const Triangle& face : sound().faces)
    for (const std::uint32_t v : face) on_face[v] = 1;
  const auto found = std::find_if(sound().tets.begin(), sound().tets.end(), [&](const Tet& t) {
    return on_face[t[0]] + on_face[t[1]] + on_face[t[2]] + on_face[t[3]] == corners;
  });
  EXPECT_NE(found, sound().tets.end());
  return static_cast<std::size_t>(found - sound().tets.begin());
}

void remove(FilledParts& parts, std::size_t t) {
  parts.tets.erase(parts.tets.begin() + static_cast<std::ptrdiff_t>(t));
  parts.regions.erase(parts.regions.begin() + static_cast<std::ptrdiff_t>(t));
}

void expect_refused(FilledParts parts, const std::string& why) {
  const Result<TetMesh> mesh = label_tets(surface(), std::move(parts));
  ASSERT_FALSE(mesh.ok()) << why;
  EXPECT_EQ(mesh.error().code, ErrorCode::kMeshing);
  EXPECT_NE(mesh.error().message.find(why), std::string::npos) << mesh.error().message;
}

TEST(LabelTets, GivesEachRegionItsLabel) {
  const Result<TetMesh> mesh = label_tets(surface(), filled());
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->labels, sound().labels);
  EXPECT_EQ(mesh->faces, sound().faces);
}

TEST(LabelTets, RefusesAHoleInside) {
  FilledParts parts = filled();
  remove(parts, tet_with_corners_on_faces(2));
  expect_refused(parts, "mm3, its boundary encloses");
}

TEST(LabelTets, RefusesAHoleAtTheBoundary) {
  FilledParts parts = filled();
  remove(parts, tet_with_corners_on_faces(4));
  expect_refused(parts, "triangles of the surface are not faces of the tetrahedra beside them");
}

TEST(LabelTets, RefusesATetThatIsThereTwice) {
  FilledParts parts = filled();
  const std::size_t t = tet_with_corners_on_faces(2);
  parts.tets.push_back(parts.tets[t]);
  parts.regions.push_back(parts.regions[t]);
  expect_refused(parts, "mm3, its boundary encloses");
}

TEST(LabelTets, RefusesATetThatIsInsideOut) {
  FilledParts parts = filled();
  Tet& tet = parts.tets[tet_with_corners_on_faces(2)];
  std::swap(tet[0], tet[1]);
  expect_refused(parts, "1 tetrahedra have no volume");
}

TEST(LabelTets, RefusesALeakBetweenLabels) {
  FilledParts parts = filled();
  std::replace(parts.regions.begin(), parts.regions.end(), 1U, 2U);
  expect_refused(parts, "one connected part of the mesh touches two labels");
}

TEST(LabelTets, RefusesAPartThatNothingBounds) {
  FilledParts parts = filled();
  parts.regions[tet_with_corners_on_faces(1)] = 3;
  expect_refused(parts, "a part of the mesh touches no triangle of the surface");
}

TEST(LabelTets, RefusesPointsThatMovedOrAreNotUsed) {
  FilledParts parts = filled();
  parts.points[5].x() += 1e-12;
  expect_refused(parts, "point 5 of the surface was merged with another");
  parts = filled();
  parts.points.emplace_back(0, 20, 3);
  expect_refused(parts, "is used by no tetrahedron");
}

}  // namespace
}  // namespace voxtet
