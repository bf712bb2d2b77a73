#include "phantom/make_phantom.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "base/digest.h"
#include "geometry/topology/label_components.h"

namespace voxtet {
namespace {

constexpr std::array kAllKinds{
    PhantomKind::kSphere,      PhantomKind::kShell,         PhantomKind::kTorus,       PhantomKind::kSlab,
    PhantomKind::kNestedBoxes, PhantomKind::kBranchingTube, PhantomKind::kBiventricle, PhantomKind::kAtlas};
constexpr std::array kClosedFormKinds{PhantomKind::kSphere, PhantomKind::kShell, PhantomKind::kTorus,
                                      PhantomKind::kSlab, PhantomKind::kNestedBoxes};

std::map<Label, double> volumes_mm3(const LabelVolume& volume) {
  std::map<Label, double> volumes;
  for (const Label label : volume.labels) volumes[label] += volume.voxel_mm3();
  volumes.erase(kBackground);
  return volumes;
}

LabelVolume make(const PhantomParams& params) {
  const Result<LabelVolume> volume = make_phantom(params);
  EXPECT_TRUE(volume.ok()) << (volume ? "" : volume.error().message);
  return volume ? *volume : LabelVolume{};
}

/// An odd spacing and direction: no surface of a body passes through voxel centres in bulk.
PhantomParams oblique(PhantomKind kind, double spacing_mm) {
  PhantomParams params;
  params.kind = kind;
  params.spacing_mm.setConstant(spacing_mm);
  params.rotation_deg = {31, -17, 53};
  return params;
}

TEST(MakePhantom, VoxelVolumesConvergeToTheAnalyticOnes) {
  for (const PhantomKind kind : kClosedFormKinds)
    for (const auto& [spacing, tolerance] :
         {std::pair{2.0, 0.02}, std::pair{1.0, 0.005}, std::pair{0.5, 0.002}}) {
      const PhantomParams params = oblique(kind, spacing);
      for (const auto& [label, mm3] : volumes_mm3(make(params))) {
        const double exact = phantom_volume_mm3(params, label);
        EXPECT_NEAR(mm3 / exact, 1, tolerance)
            << "kind " << static_cast<int>(kind) << ", label " << label << ", spacing " << spacing;
      }
    }
}

TEST(MakePhantom, HasNoClosedFormWhereThereIsNone) {
  PhantomParams params;
  EXPECT_TRUE(std::isnan(phantom_volume_mm3(params, 1)));
  params.kind = PhantomKind::kSphere;
  EXPECT_TRUE(std::isnan(phantom_volume_mm3(params, 2)));
  params.radius_mm = -1;
  EXPECT_TRUE(std::isnan(phantom_volume_mm3(params, 1)));
}

TEST(MakePhantom, KeepsVolumesUnderRotationAndMirroring) {
  for (const PhantomKind kind : kAllKinds) {
    PhantomParams params;
    params.kind = kind;
    params.spacing_mm.setConstant(1.03);
    params.rotation_deg = {11, -7, 23};  // a box along its own axes would show its rounding to whole voxels
    params.scar = true;
    const auto straight = volumes_mm3(make(params));
    params.rotation_deg = {20, 35, -70};
    params.mirrored = true;
    const LabelVolume turned = make(params);
    EXPECT_LT(turned.linear().determinant(), 0);
    const auto volumes = volumes_mm3(turned);
    ASSERT_EQ(volumes.size(), straight.size());
    for (const auto& [label, mm3] : straight)
      EXPECT_NEAR(volumes.at(label) / mm3, 1, 0.03)
          << "kind " << static_cast<int>(kind) << ", label " << label;
  }
}

TEST(MakePhantom, SamplesTheBodyAtVoxelCentres) {
  for (const PhantomKind kind : kAllKinds) {
    PhantomParams params = oblique(kind, 1.7);
    params.mirrored = true;
    params.scar = true;
    const LabelVolume volume = make(params);
    const auto body = phantom_body(params);
    std::size_t different = 0;
    for (int k = 0; k < volume.size[2]; ++k)
      for (int j = 0; j < volume.size[1]; ++j)
        for (int i = 0; i < volume.size[0]; ++i)
          different += volume.at(i, j, k) != body(volume.to_mm({1.0 * i, 1.0 * j, 1.0 * k}));
    // Only heart and atlas are cleaned of specks after sampling.
    const std::size_t allowed = kind == PhantomKind::kBiventricle ? 5 : kind == PhantomKind::kAtlas ? 100 : 0;
    EXPECT_LE(different, allowed) << "kind " << static_cast<int>(kind);
  }
}

TEST(MakePhantom, HoldsTheWholeBodyWithTwoBackgroundVoxelsAround) {
  for (const PhantomKind kind : kAllKinds)
    for (const Eigen::Vector3d& spacing : {Eigen::Vector3d(1.5, 1.5, 1.5), Eigen::Vector3d(0.9, 1.6, 3.1)}) {
      PhantomParams params = oblique(kind, 1);
      params.spacing_mm = spacing;
      const LabelVolume volume = make(params);
      EXPECT_LT((volume.spacing_mm() - spacing).norm(), 1e-9);
      std::array<int, 3> low = volume.size, high{};
      for (int k = 0; k < volume.size[2]; ++k)
        for (int j = 0; j < volume.size[1]; ++j)
          for (int i = 0; i < volume.size[0]; ++i) {
            if (volume.at(i, j, k) == kBackground) continue;
            const std::array<int, 3> voxel{i, j, k};
            for (int d = 0; d < 3; ++d) {
              low[d] = std::min(low[d], voxel[d]);
              high[d] = std::max(high[d], voxel[d]);
            }
          }
      for (int d = 0; d < 3; ++d) {
        EXPECT_EQ(low[d], 2);
        EXPECT_EQ(high[d], volume.size[d] - 3);
      }
      // Nothing was cut off: beyond the grid the body has no label.
      const auto body = phantom_body(params);
      std::size_t outside = 0;
      for (int k = -20; k < volume.size[2] + 20; ++k)
        for (int j = -20; j < volume.size[1] + 20; ++j)
          for (int i = -20; i < volume.size[0] + 20; ++i)
            if (!volume.contains(i, j, k))
              outside += body(volume.to_mm({1.0 * i, 1.0 * j, 1.0 * k})) != kBackground;
      EXPECT_EQ(outside, 0u) << "kind " << static_cast<int>(kind);
    }
}

TEST(MakePhantom, NamesAndColoursExactlyTheLabelsThatItHolds) {
  for (const PhantomKind kind : kAllKinds)
    for (const bool scar : {false, true}) {
      PhantomParams params;
      params.kind = kind;
      params.scar = scar;
      params.blood_pools = !scar;
      const LabelVolume volume = make(params);
      const auto volumes = volumes_mm3(volume);
      ASSERT_EQ(volume.infos.size(), volumes.size());
      auto held = volumes.begin();
      for (const LabelInfo& info : volume.infos) {
        EXPECT_EQ(info.label, (held++)->first);
        EXPECT_FALSE(info.name.empty());
        for (const float c : info.colour) EXPECT_TRUE(c >= 0 && c <= 1);
      }
    }
}

TEST(MakePhantom, NamesTheParameterThatIsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expect_error = [](PhantomKind kind, const std::string& field, const auto& spoil) {
    PhantomParams params;
    params.kind = kind;
    spoil(params);
    const Result<LabelVolume> volume = make_phantom(params);
    ASSERT_FALSE(volume.ok()) << field;
    EXPECT_EQ(volume.error().code, ErrorCode::kUsage);
    EXPECT_EQ(volume.error().message.rfind("phantom." + field + ":", 0), 0u) << volume.error().message;
    EXPECT_EQ(phantom_body(params)(Eigen::Vector3d::Zero()), kBackground);
  };
  using P = PhantomParams;
  for (const PhantomKind kind : kAllKinds) {
    expect_error(kind, "spacing_mm[1]", [](P& p) { p.spacing_mm[1] = 0; });
    expect_error(kind, "spacing_mm[2]", [&](P& p) { p.spacing_mm[2] = nan; });
    expect_error(kind, "rotation_deg[0]", [](P& p) { p.rotation_deg[0] = INFINITY; });
    if (kind != PhantomKind::kBiventricle && kind != PhantomKind::kAtlas)
      expect_error(kind, "radius_mm", [](P& p) { p.radius_mm = -3; });
  }
  expect_error(PhantomKind::kShell, "inner_radius_mm", [](P& p) { p.inner_radius_mm = p.radius_mm; });
  expect_error(PhantomKind::kTorus, "inner_radius_mm", [](P& p) { p.inner_radius_mm = 0; });
  expect_error(PhantomKind::kSlab, "thickness_mm", [&](P& p) { p.thickness_mm = nan; });
  expect_error(PhantomKind::kBiventricle, "scale", [](P& p) { p.scale = 0; });
  expect_error(PhantomKind::kBiventricle, "roughness_mm", [](P& p) { p.roughness_mm = -0.1; });
  expect_error(PhantomKind::kBiventricle, "roughness_mm", [](P& p) { p.roughness_mm = 3; });
  expect_error(PhantomKind::kBiventricle, "wall_scale", [](P& p) { p.wall_scale = 0.4; });
  expect_error(PhantomKind::kBiventricle, "wall_scale", [&](P& p) { p.wall_scale = nan; });
  expect_error(PhantomKind::kBiventricle, "length_scale", [](P& p) { p.length_scale = 1.4; });
  expect_error(PhantomKind::kBiventricle, "rv_dilation", [](P& p) { p.rv_dilation = 0; });
  expect_error(PhantomKind::kBiventricle, "rv_wall_mm", [](P& p) { p.rv_wall_mm = 2.9; });
  expect_error(PhantomKind::kBiventricle, "scar_angle_deg", [](P& p) { p.scar_angle_deg = 181; });
  expect_error(PhantomKind::kBiventricle, "scar_height_mm", [](P& p) { p.scar_height_mm = -21; });
  expect_error(PhantomKind::kBiventricle, "scar_arc_mm", [](P& p) { p.scar_arc_mm = 73; });
  expect_error(PhantomKind::kBiventricle, "scar_length_mm", [](P& p) { p.scar_length_mm = 15; });
  expect_error(PhantomKind::kBiventricle, "scar_depth", [](P& p) { p.scar_depth = 0; });
  expect_error(PhantomKind::kBiventricle, "scar_depth", [](P& p) { p.scar_depth = 1.1; });
  expect_error(PhantomKind::kBiventricle, "border_mm", [](P& p) { p.border_mm = -1; });
  expect_error(PhantomKind::kBiventricle, "isthmus_mm", [](P& p) { p.isthmus_mm = -1; });
  expect_error(PhantomKind::kBiventricle, "isthmus_mm", [](P& p) { p.isthmus_mm = INFINITY; });
  expect_error(PhantomKind::kAtlas, "scale", [](P& p) { p.scale = 0; });
  expect_error(PhantomKind::kAtlas, "regions", [](P& p) { p.regions = 0; });
  expect_error(PhantomKind::kAtlas, "regions", [](P& p) { p.regions = 2001; });
}

TEST(MakePhantom, RefusesMoreThan512CubedVoxelsAndSpacingsThatMissTheBody) {
  for (const double spacing : {0.01, 1e-9, 1e-200}) {
    PhantomParams params;
    params.spacing_mm.setConstant(spacing);
    const Result<LabelVolume> volume = make_phantom(params);
    ASSERT_FALSE(volume.ok());
    EXPECT_EQ(volume.error().code, ErrorCode::kUsage);
    EXPECT_NE(volume.error().message.find("512^3"), std::string::npos) << volume.error().message;
  }
  PhantomParams params;
  params.kind = PhantomKind::kShell;
  params.spacing_mm.setConstant(70);
  const Result<LabelVolume> volume = make_phantom(params);
  ASSERT_FALSE(volume.ok());
  EXPECT_NE(volume.error().message.find("no voxel centre lies inside"), std::string::npos);
}

TEST(MakePhantom, GivesTheSameBytesOnEveryPlatform) {
  std::map<std::string, std::string> digests;
  const auto add = [&](const std::string& name, const PhantomParams& params) {
    digests[name] = digest_of(make(params));
    EXPECT_EQ(digests[name], digest_of(make(params))) << name;
  };
  PhantomParams heart;
  add("heart", heart);
  heart.scar = true;
  heart.rotation_deg = {40, -25, 10};
  heart.mirrored = true;
  heart.seed = 9;
  add("oblique heart with scar", heart);
  heart.scar_depth = 1;
  heart.isthmus_mm = 5;
  add("oblique heart with transmural scar", heart);
  heart.wall_scale = 0.7;
  heart.length_scale = 1.1;
  heart.rv_dilation = 2.5;
  heart.rv_wall_mm = 4.5;
  heart.scar_angle_deg = -77;
  heart.scar_height_mm = 7;
  heart.scar_arc_mm = 37;
  heart.scar_length_mm = 33;
  add("oblique heart with a dilated right ventricle", heart);
  add("oblique torus", oblique(PhantomKind::kTorus, 1.3));
  add("oblique tube", oblique(PhantomKind::kBranchingTube, 1.3));
  EXPECT_EQ(digests["heart"], "e0eb08284fe089d6abddc3b8f8bc6d18a42f703b09fe9f1f2c9ae23561faa679");
  EXPECT_EQ(digests["oblique heart with scar"],
            "97e1254e189f8c4974c995b852da73edfebd46ce0cfa4d69465ffff19f014107");
  EXPECT_EQ(digests["oblique heart with transmural scar"],
            "92753774b96c91678793f9697db17ef7f6ebd19c5c6a19259a529d2f802babca");
  EXPECT_EQ(digests["oblique heart with a dilated right ventricle"],
            "7e2a2ed94c94b5179dec77fe98176a1c6e1d114a52e70b44fd9377d37ba76394");
  EXPECT_EQ(digests["oblique torus"], "ee3073071c7b25e32bc6e9d79e612a589bb05ee40e9b8a9072f99cce091358aa");
  EXPECT_EQ(digests["oblique tube"], "5c4e5553e6175275e73d2ba4050804e99c334b035469a23b5c06112c193c622f");
}

TEST(MakePhantom, AnAtlasHasEveryRegionInOnePieceAndInTheSamePlaceForTheSameSeed) {
  PhantomParams params;
  params.kind = PhantomKind::kAtlas;
  params.spacing_mm.setConstant(2);
  params.scale = 0.4;
  params.regions = 60;
  const LabelVolume atlas = make(params);
  std::map<Label, int> pieces;
  std::vector<std::uint32_t> sizes;
  const std::vector<std::uint32_t> ids = label_components(atlas.size, atlas.labels, sizes);
  std::map<std::uint32_t, Label> label_of;
  for (std::size_t v = 0; v < ids.size(); ++v) label_of[ids[v]] = atlas.labels[v];
  for (const auto& [id, label] : label_of) ++pieces[label];
  for (Label label = 1; label <= 60; ++label) EXPECT_EQ(pieces[label], 1) << label;
  EXPECT_EQ(pieces.size(), 61U);
  EXPECT_EQ(make(params).labels, atlas.labels);
  params.seed = 2;
  EXPECT_NE(make(params).labels, atlas.labels);
}

}  // namespace
}  // namespace voxtet
