// Planes that cut labels off, through all stages: flat faces, sharp rims, names in files, what is said.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "geometry/cut/cut_faces.h"
#include "geometry/elements/tet_measures.h"
#include "io/mesh/write_mesh.h"
#include "io/volume/write_volume.h"
#include "pipeline/exports/exported_fields.h"
#include "pipeline/results/stage_results.h"
#include "pipeline/session.h"

namespace voxtet {
namespace {

using LabelAt = std::function<Label(const Eigen::Vector3d&)>;  ///< at a continuous index

/// 40 x 40 x 44 voxels of 0.9 mm, turned in the patient.
LabelVolume turned(const LabelAt& label_at) {
  LabelVolume volume;
  volume.size = {40, 40, 44};
  const Eigen::AngleAxisd turn(0.5, Eigen::Vector3d(1, -2, 0.5).normalized());
  volume.index_to_mm.topLeftCorner<3, 3>() = 0.9 * turn.toRotationMatrix();
  volume.index_to_mm.topRightCorner<3, 1>() = Eigen::Vector3d(4, -7, 30);
  volume.labels.resize(volume.voxel_count());
  volume.visit(
      [&](int i, int j, int k, std::size_t at) { volume.labels[at] = label_at(Eigen::Vector3d(i, j, k)); });
  return volume;
}

/// A plane across a direction in index space, through a place there.
CutParams plane_at(const LabelVolume& volume, const Eigen::Vector3d& place, const Eigen::Vector3d& direction,
                   const std::string& name, std::vector<Label> labels = {}) {
  return {name, std::move(labels), volume.to_mm(place), volume.linear() * direction};
}

void mesh(Session& session, const LabelVolume& volume, const std::vector<CutParams>& cuts) {
  const Result<Bytes> file = write_nifti(volume, false);
  ASSERT_TRUE(file.ok());
  ASSERT_TRUE(session.load_volume({"body.nii", *file, {}}).ok());
  Recipe recipe = session.recipe();
  recipe.volume.cut = cuts;
  recipe.sizing.edge_mm = 2;
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  RunContext ctx;
  const Status done = session.run(Stage::kQuality, ctx);
  ASSERT_TRUE(done.ok()) << done.error().message;
}

double volume_mm3(const TetMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c, d] : mesh.tets)
    sum += tet_volume_mm3({mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]});
  return sum;
}

NamedSet surface_of(const Session& session, const std::string& name) {
  const Exported exported = exported_fields(session, MeshFormat::kMsh, false);
  for (const NamedSet& set : exported.options.surfaces)
    if (set.name == name) return set;
  return {};
}

/// Faces of a surface and how they lie to its plane; turns at the edges where it ends, in degrees.
struct Flatness {
  double farthest_mm = 0, beyond_mm = -1e9, area_mm2 = 0;
  std::vector<double> rim_deg;
};

Flatness flatness(const Session& session, const CutParams& cut) {
  const TetMesh& mesh = *session.mesh();
  const NamedSet set = surface_of(session, cut.name);
  const Eigen::Vector3d normal = cut.normal.normalized();
  const auto off = [&](std::uint32_t p) { return normal.dot(mesh.points[p] - cut.point_mm); };
  const auto cross = [&](std::uint32_t f) -> Eigen::Vector3d {
    const auto& [a, b, c] = mesh.faces[f];
    return (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
  };
  Flatness found;
  std::set<std::uint32_t> flat(set.members.begin(), set.members.end());
  for (const std::uint32_t f : set.members) {
    found.area_mm2 += cross(f).norm() / 2;
    for (const std::uint32_t p : mesh.faces[f])
      found.farthest_mm = std::max(found.farthest_mm, std::abs(off(p)));
  }
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    if (cut.labels.empty() || std::count(cut.labels.begin(), cut.labels.end(), mesh.labels[t]) > 0)
      for (const std::uint32_t p : mesh.tets[t]) found.beyond_mm = std::max(found.beyond_mm, off(p));
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> at_edge;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
    if (mesh.face_sides[f][1] == kBackground)
      for (std::size_t i = 0; i < 3; ++i)
        at_edge[std::minmax(mesh.faces[f][i], mesh.faces[f][(i + 1) % 3])].push_back(f);
  for (const auto& [edge, faces] : at_edge)
    if (faces.size() == 2 && flat.count(faces[0]) != flat.count(faces[1]))
      found.rim_deg.push_back(std::acos(cross(faces[0]).normalized().dot(cross(faces[1]).normalized())) *
                              57.29578);
  return found;
}

/// Flat to a twentieth of a voxel, nothing beyond, and a rim that turns everywhere.
void expect_flat(const Session& session, const CutParams& cut, double least_turn_deg) {
  const Flatness found = flatness(session, cut);
  const double voxel = session.volume()->smallest_spacing_mm();
  EXPECT_LT(found.farthest_mm, 0.05 * voxel) << cut.name;
  EXPECT_LT(found.beyond_mm, 0.05 * voxel) << cut.name;
  ASSERT_GT(found.rim_deg.size(), 20U) << cut.name;
  EXPECT_GT(*std::min_element(found.rim_deg.begin(), found.rim_deg.end()), least_turn_deg) << cut.name;
}

// An upright cylinder that the image cuts off below, and an oblique plane above: its volume is that of an
// upright one up to where the plane meets the axis.
TEST(CutPlanes, CutACylinderAtAnAngle) {
  constexpr double kRadius = 12.1, kMiddle = 19.5, kPlace = 27.3;
  const LabelVolume volume = turned([&](const Eigen::Vector3d& at) {
    return std::hypot(at.x() - kMiddle, at.y() - kMiddle) < kRadius ? 1 : 0;
  });
  const CutParams cut = plane_at(volume, {kMiddle, kMiddle, kPlace}, {0.35, -0.2, 1}, "top");
  Session session;
  mesh(session, volume, {cut});
  EXPECT_TRUE(session.quality()->passed());
  expect_flat(session, cut, 60);
  const double mm3 = 0.729 * 3.14159265 * kRadius * kRadius * (kPlace + 0.5);
  EXPECT_NEAR(volume_mm3(*session.mesh()), mm3, 0.002 * mm3);
  EXPECT_LT(std::abs(session.quality()->labels[0].volume_error_percent), 0.2);
  EXPECT_GT(session.quality()->metrics.front().min, 28);
  // The plane's section is an ellipse.
  const double slant = Eigen::Vector3d(0.35, -0.2, 1).norm();
  const double mm2 = 0.81 * 3.14159265 * kRadius * kRadius * slant;
  EXPECT_NEAR(flatness(session, cut).area_mm2, mm2, 0.01 * mm2);
  // The image's own cut is there too.
  const Exported exported = exported_fields(session, MeshFormat::kMsh, false);
  EXPECT_EQ(exported.options.surfaces.size(), 2U);
}

/// Three boxes side by side, and one upon them.
LabelVolume boxes() {
  return turned([](const Eigen::Vector3d& at) -> Label {
    if (at.x() < 6 || at.x() > 33 || at.y() < 7 || at.y() > 31 || at.z() < 5 || at.z() > 36) return 0;
    if (at.z() > 28) return 4;
    return at.x() < 14.5 ? 1 : at.x() < 24.5 ? 2 : 3;
  });
}

TEST(CutPlanes, CutSeveralLabelsAtOnce) {
  const LabelVolume volume = boxes();
  const CutParams cut = plane_at(volume, {19, 19, 17.2}, {-0.3, 0.15, 1}, "top");
  Session session;
  mesh(session, volume, {cut});
  EXPECT_TRUE(session.quality()->passed());
  expect_flat(session, cut, 60);
  EXPECT_GT(session.quality()->metrics.front().min, 28);
  ASSERT_EQ(session.quality()->labels.size(), 3U);  // nothing is left of the upper box
  for (const LabelFidelity& label : session.quality()->labels)
    EXPECT_LT(std::abs(label.volume_error_percent), 0.5) << label.label;
  std::set<Label> behind;
  for (const std::uint32_t f : surface_of(session, "top").members)
    behind.insert(session.mesh()->face_sides[f][0]);
  EXPECT_EQ(behind, (std::set<Label>{1, 2, 3}));
}

// Of two labels each has a plane of its own; the others are as without.
TEST(CutPlanes, CutOneLabelAndLeaveTheOthers) {
  const LabelVolume volume = boxes();
  const CutParams first = plane_at(volume, {10, 19, 15.3}, {0.2, 0.1, 1}, "left", {1});
  const CutParams second = plane_at(volume, {28, 19, 16.1}, {-0.2, 0.25, -1}, "right", {3});
  Session session;
  mesh(session, volume, {first, second});
  EXPECT_TRUE(session.quality()->passed());
  for (const CutParams& cut : {first, second}) {
    const Flatness found = flatness(session, cut);
    EXPECT_LT(found.farthest_mm, 0.045);
    EXPECT_LT(found.beyond_mm, 0.045);
    EXPECT_GT(found.area_mm2, 100);
  }
  EXPECT_GT(session.quality()->metrics.front().min, 25);
  std::map<Label, double> voxels;
  for (const Label label : volume.labels) voxels[label] += 1;
  for (const LabelFidelity& label : session.quality()->labels)
    if (label.label == 2 || label.label == 4) {
      EXPECT_NEAR(label.mesh_mm3, 0.729 * voxels[label.label], 0.003 * label.mesh_mm3) << label.label;
    }
}

TEST(CutPlanes, GiveAHeartAFlatBase) {
  Session session;
  Recipe recipe;
  recipe.source.phantom = PhantomParams{};
  recipe.source.phantom->kind = PhantomKind::kBiventricle;
  recipe.sizing.edge_mm = 3;
  const CutParams cut{"base", {}, {0, 0, 0}, {0.2, -0.15, 1}};
  recipe.volume.cut = {cut};
  recipe.physics = PhysicsParams{};
  recipe.physics->anatomy = AnatomyParams{};
  recipe.physics->anatomy->lv_pool = {3};
  recipe.physics->anatomy->rv_pool = {4};
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  RunContext ctx;
  const Status done = session.run(Stage::kAnatomy, ctx);
  ASSERT_TRUE(done.ok()) << done.error().message;
  ASSERT_TRUE(session.run(Stage::kQuality, ctx).ok());
  EXPECT_TRUE(session.quality()->passed());
  expect_flat(session, cut, 50);
  EXPECT_GT(session.quality()->metrics.front().min, 28);
  for (const LabelFidelity& label : session.quality()->labels)
    EXPECT_LT(std::abs(label.volume_error_percent), 1) << label.label;
  // The plane takes the place of the anatomy's base, and no face has two names.
  const Exported exported = exported_fields(session, MeshFormat::kMsh, false);
  std::map<std::uint32_t, int> names;
  std::size_t bases = 0;
  for (const NamedSet& set : exported.options.surfaces) {
    bases += set.name == "base" ? 1 : 0;
    for (const std::uint32_t f : set.members) ++names[f];
  }
  EXPECT_EQ(bases, 1U);
  for (const auto& [face, count] : names) EXPECT_EQ(count, 1) << face;
}

TEST(CutPlanes, SayWhatTheyTake) {
  const LabelVolume volume = boxes();
  const auto run = [&](const std::vector<CutParams>& cuts, Session& session) {
    const Result<Bytes> file = write_nifti(volume, false);
    EXPECT_TRUE(session.load_volume({"body.nii", *file, {}}).ok());
    Recipe recipe = session.recipe();
    recipe.volume.cut = cuts;
    EXPECT_TRUE(session.set_recipe(recipe).ok());
    RunContext ctx;
    return session.run(Stage::kVolume, ctx);
  };
  {
    Session session;
    ASSERT_TRUE(run({plane_at(volume, {10, 19, 20.5}, {0, 0, 1}, "", {1})}, session).ok());
    const std::string note = session.record(Stage::kVolume).notes.back();
    EXPECT_NE(note.find("the plane cut cuts away 1800 voxels of label 1"), std::string::npos) << note;
    EXPECT_EQ(session.result<VolumeResult>(Stage::kVolume)->prepared.cut_away[0].voxels.at(1), 1800U);
  }
  {
    Session session;
    ASSERT_TRUE(run({plane_at(volume, {19, 19, 43}, {0, 0, 1}, "high")}, session).ok());
    const std::string warning = session.record(Stage::kVolume).warnings.back();
    EXPECT_NE(
        warning.find("volume.cut[0], the plane high, cuts nothing of the labels 1, 2, 3, 4: they lie from"),
        std::string::npos)
        << warning;
  }
  {
    Session session;
    ASSERT_TRUE(run({plane_at(volume, {19, 19, 27}, {0, 0, 1}, "low")}, session).ok());
    const std::string warning = session.record(Stage::kVolume).warnings.back();
    EXPECT_NE(warning.find("the plane low, cuts away all of label 4"), std::string::npos) << warning;
  }
  for (const auto& [cut, said] : std::vector<std::pair<CutParams, std::string>>{
           {plane_at(volume, {19, 19, 0}, {0, 0, 1}, "all"), "cuts away all of label"},
           {plane_at(volume, {19, 19, 9}, {0, 0, 0}, "none"), "volume.cut[0].normal: found 0, 0, 0"},
           {plane_at(volume, {19, 19, 9}, {0, 0, 1}, "two words"), "volume.cut[0].name: found 'two words'"},
           {plane_at(volume, {19, 19, 9}, {0, 0, 1}, "", {9}),
            "volume.cut[0].labels: found 9, expected labels"}}) {
    Session session;
    const Status refused = run({cut}, session);
    ASSERT_FALSE(refused.ok()) << said;
    EXPECT_EQ(refused.error().code, ErrorCode::kUsage);
    EXPECT_NE(refused.error().message.find(said), std::string::npos) << refused.error().message;
  }
}

}  // namespace
}  // namespace voxtet
