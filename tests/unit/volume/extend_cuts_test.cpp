// Where an image cuts a body off, and how the body goes on beyond its border.
#include "volume/extend_cuts.h"

#include <gtest/gtest.h>

#include <cmath>

namespace voxtet {
namespace {

template <class Body>
LabelVolume sampled(const std::array<int, 3>& size, const Body& body) {
  LabelVolume volume;
  volume.size = size;
  volume.labels.resize(volume.voxel_count());
  volume.visit([&](int i, int j, int k, std::size_t at) { volume.labels[at] = body(i, j, k); });
  return volume;
}

LabelVolume cylinder() {
  return sampled({20, 20, 12}, [](int i, int j, int) {
    return static_cast<Label>(std::hypot(i - 9.5, j - 9.5) < 6 ? 3 : 0);
  });
}

TEST(CutFaces, AreWhereACylinderReachesTheBorder) {
  const LabelVolume volume = cylinder();
  const CutFaces faces = find_cut_faces(volume);
  EXPECT_TRUE(faces.cut[0][0].empty() && faces.cut[0][1].empty());
  EXPECT_TRUE(faces.cut[1][0].empty() && faces.cut[1][1].empty());
  for (const auto& end : faces.cut[2]) {
    ASSERT_EQ(end.size(), 400U);
    for (std::size_t at = 0; at < 400; ++at) EXPECT_EQ(end[at] != 0, volume.labels[at] != 0);
  }
}

TEST(CutFaces, AreNotWhereABallJustTouchesTheBorder) {
  const LabelVolume ball = sampled({21, 21, 21}, [](int i, int j, int k) {
    return static_cast<Label>(std::hypot(i - 10, j - 10, k - 10) <= 10.3 ? 1 : 0);
  });
  EXPECT_TRUE(find_cut_faces(ball).none());
  // Cut at a third of its radius it is.
  const LabelVolume cut = sampled({21, 21, 14}, [](int i, int j, int k) {
    return static_cast<Label>(std::hypot(i - 10, j - 10, k - 10) <= 10.3 ? 1 : 0);
  });
  const CutFaces faces = find_cut_faces(cut);
  EXPECT_FALSE(faces.cut[2][1].empty());
  EXPECT_TRUE(faces.cut[2][0].empty());
}

TEST(CutFaces, PlanesHaveNamesAndPlacesInThePatient) {
  LabelVolume volume = cylinder();
  volume.index_to_mm(0, 0) = -2;  // mirrored
  volume.index_to_mm(2, 2) = 3;
  volume.index_to_mm(2, 3) = 100;
  const CutPlanes planes = planes_of(volume, find_cut_faces(volume), 3);
  ASSERT_EQ(planes.size(), 2U);
  EXPECT_EQ(planes[0].name, "cut_inferior");
  EXPECT_EQ(planes[1].name, "cut_superior");
  EXPECT_NEAR(planes[0].offset_mm, -(100 - 1.5), 1e-9);
  EXPECT_NEAR(planes[1].offset_mm, 100 + 11.5 * 3, 1e-9);
  EXPECT_NEAR(planes[0].place, kBeyondCut - 0.5, 0);
  EXPECT_TRUE(planes_of(volume, find_cut_faces(volume), 65534).empty());
}

TEST(CutFaces, TheBodyGoesOnBeyondThemWithLabelsOfTheirOwn) {
  const LabelVolume volume = cylinder();
  const CutFaces faces = find_cut_faces(volume);
  const CutPlanes planes = planes_of(volume, faces, 3);
  const LabelVolume same = extended(volume, faces), marked = extended(volume, faces, &planes);
  ASSERT_EQ(same.size, (std::array<int, 3>{20, 20, 12 + 2 * kBeyondCut}));
  EXPECT_EQ(same.to_mm(0, 0, kBeyondCut), volume.to_mm(0, 0, 0));
  same.visit([&](int i, int j, int k, std::size_t at) {
    EXPECT_EQ(same.labels[at], volume.at(i, j, 0));
    const bool below = k < kBeyondCut, above = k >= kBeyondCut + 12;
    const Label beyond = below ? planes[0].beyond : planes[1].beyond;
    EXPECT_EQ(marked.labels[at], same.labels[at] != 0 && (below || above) ? beyond : same.labels[at]);
  });
}

}  // namespace
}  // namespace voxtet
