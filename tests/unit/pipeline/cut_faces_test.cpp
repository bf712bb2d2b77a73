// Flat faces where the image cuts a body off, through all stages.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "geometry/cut/cut_faces.h"
#include "io/volume/write_volume.h"
#include "pipeline/exports/exported_fields.h"
#include "pipeline/session.h"

namespace voxtet {
namespace {

/// A leaning cylinder of two labels in an oblique image that cuts it off at two ends.
LabelVolume cylinder() {
  LabelVolume volume;
  volume.size = {36, 32, 22};
  const Eigen::AngleAxisd turn(0.5, Eigen::Vector3d(1, -2, 0.5).normalized());
  volume.index_to_mm.topLeftCorner<3, 3>() = 0.9 * turn.toRotationMatrix();
  volume.index_to_mm.topRightCorner<3, 1>() = Eigen::Vector3d(4, -7, 30);
  volume.labels.resize(volume.voxel_count());
  volume.visit([&](int i, int j, int k, std::size_t at) {
    const double r = std::hypot(i - 17.5 - 0.3 * (k - 10.5), j - 15.5);
    volume.labels[at] = r < 4.5 ? 2 : r < 10 ? 1 : 0;
  });
  return volume;
}

void mesh(Session& session, bool flat) {
  const Result<Bytes> file = write_nifti(cylinder(), false);
  ASSERT_TRUE(file.ok());
  ASSERT_TRUE(session.load_volume({"cylinder.nii", *file, {}}).ok());
  Recipe recipe = session.recipe();
  recipe.volume.flat_border = flat;
  recipe.sizing.edge_mm = 2;
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  RunContext ctx;
  const Status done = session.run(Stage::kQuality, ctx);
  ASSERT_TRUE(done.ok()) << done.error().message;
}

TEST(FlatBorder, FacesAreFlatWithASharpRim) {
  Session session;
  mesh(session, true);
  EXPECT_TRUE(session.quality()->passed());
  const CutPlanes& cuts = session.result<VolumeResult>(Stage::kVolume)->prepared.cuts;
  ASSERT_EQ(cuts.size(), 2U);
  const TetMesh& mesh = *session.mesh();
  for (const Label label : mesh.labels) EXPECT_LE(label, 2);
  const std::vector<NamedSet> sets = cut_sets(mesh, cuts);
  ASSERT_EQ(sets.size(), 2U);
  for (std::size_t c = 0; c < 2; ++c) {
    double area = 0, farthest = -1;
    for (const std::uint32_t f : sets[c].members) {
      const auto& [a, b, d] = mesh.faces[f];
      area += 0.5 * (mesh.points[b] - mesh.points[a]).cross(mesh.points[d] - mesh.points[a]).norm();
    }
    // Nothing of the body is beyond its plane.
    for (const Eigen::Vector3d& p : mesh.points)
      farthest = std::max(farthest, cuts[c].normal.dot(p) - cuts[c].offset_mm);
    EXPECT_NEAR(farthest, 0, 1e-6);
    EXPECT_NEAR(area, 3.14159 * 81, 0.03 * 3.14159 * 81);
  }
  // The rim: between a flat face and one that is not, at no more than the lean and a facet's turn from a
  // right angle.
  std::set<std::uint32_t> flat;
  for (const NamedSet& set : sets) flat.insert(set.members.begin(), set.members.end());
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> at_edge;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    if (mesh.face_sides[f][1] != kBackground) continue;
    for (std::size_t i = 0; i < 3; ++i)
      at_edge[std::minmax(mesh.faces[f][i], mesh.faces[f][(i + 1) % 3])].push_back(f);
  }
  const auto normal = [&](std::uint32_t f) -> Eigen::Vector3d {
    const auto& [a, b, c] = mesh.faces[f];
    return (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).normalized();
  };
  std::size_t rim = 0;
  for (const auto& [edge, faces] : at_edge) {
    if (faces.size() != 2 || flat.count(faces[0]) == flat.count(faces[1])) continue;
    ++rim;
    const double turn_deg = std::acos(normal(faces[0]).dot(normal(faces[1]))) * 57.29578;
    EXPECT_GT(turn_deg, 50) << "at " << mesh.points[edge.first].transpose();
  }
  EXPECT_GT(rim, 40U);
}

TEST(FlatBorder, KeepsVolumesAndAngles) {
  Session session;
  mesh(session, true);
  for (const LabelFidelity& label : session.quality()->labels)
    EXPECT_LT(std::abs(label.volume_error_percent), 0.2) << label.label;
  EXPECT_GT(session.quality()->metrics.front().min, 28);
}

TEST(FlatBorder, IsNamedInFilesAndSaid) {
  Session session;
  mesh(session, true);
  const Exported exported = exported_fields(session, MeshFormat::kMsh, false);
  std::set<std::string> names;
  for (const NamedSet& set : exported.options.surfaces) names.insert(set.name);
  EXPECT_EQ(names.size(), 2U);
  for (const std::string& name : names) EXPECT_EQ(name.substr(0, 4), "cut_");
  const std::vector<std::string>& notes = session.record(Stage::kVolume).notes;
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
    return note.find("the image cuts the body off") != std::string::npos;
  }));
}

TEST(FlatBorder, CanBeSwitchedOff) {
  Session session;
  mesh(session, false);
  EXPECT_TRUE(session.result<VolumeResult>(Stage::kVolume)->prepared.cuts.empty());
  EXPECT_TRUE(exported_fields(session, MeshFormat::kMsh, false).options.surfaces.empty());
}

}  // namespace
}  // namespace voxtet
