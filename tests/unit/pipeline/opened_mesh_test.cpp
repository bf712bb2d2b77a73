// A mesh that was made elsewhere as the source of a case.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/mesh/write_mesh.h"
#include "pipeline/report.h"
#include "pipeline/session.h"
#include "support/bricks.h"
#include "support/uniform_tissue.h"

namespace voxtet {
namespace {

Bytes bytes_of_text(const std::string& text) {
  return {text.begin(), text.end()};
}

/// A file of openCARP with those beside it, as the page gives them.
struct Files {
  std::map<std::string, Bytes> all;
  VolumeFile main() const {
    return {"bar.elem", all.at("bar.elem"), [this](const std::string& name) -> Result<Bytes> {
              const auto found = all.find(name);
              if (found != all.end()) return found->second;
              return Error{ErrorCode::kBadInput, "read", name + " is not there", {}};
            }};
  }
};

/// A bar of 12 x 4 x 4 mm; label 2 from x = 6 mm on.
TetMesh bar() {
  TetMesh mesh = test::bricks({12, 4, 4}, {12, 4, 4});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    double x = 0;
    for (const std::uint32_t point : mesh.tets[t]) x += mesh.points[point].x() / 4;
    mesh.labels[t] = x > 6 ? 2 : 1;
  }
  return mesh;
}

Files files_of(const TetMesh& mesh) {
  WriteMeshOptions options;
  options.name = "bar";
  const Result<std::vector<OutputFile>> written = write_tet_mesh(mesh, MeshFormat::kCarp, options);
  Files files;
  for (const OutputFile& file : *written) files.all["bar" + file.suffix] = file.bytes;
  return files;
}

/// A wave from x = 0, faster along the fibre where there is one.
Recipe with_wave(Recipe recipe, double across = 0.5) {
  PhysicsParams& physics = recipe.physics.emplace();
  TissueLabels& kind = physics.tissue.kinds.emplace_back();
  kind.labels = {1, 2};
  kind.along_mm_per_ms = 0.5;
  kind.across_mm_per_ms = across;
  Stimulus& start = physics.stimuli.emplace_back();
  start.centre_mm = {0, 2, 2};
  start.radius_mm = 3;
  return recipe;
}

void expect_run(Session& session, Stage stage) {
  RunContext ctx;
  const Status done = session.run(stage, ctx);
  ASSERT_TRUE(done.ok()) << done.error().message;
}

TEST(OpenedMesh, IsTakenAsItIsAndMeasured) {
  const TetMesh mesh = bar();
  Session session;
  ASSERT_TRUE(session.load_volume(files_of(mesh).main()).ok());
  expect_run(session, Stage::kQuality);
  EXPECT_EQ(session.mesh()->tets, mesh.tets);
  EXPECT_EQ(session.mesh()->labels, mesh.labels);
  EXPECT_EQ(session.mesh()->points.size(), mesh.points.size());
  EXPECT_GT(session.mesh()->faces.size(), 0U);
  EXPECT_EQ(session.recipe().source.file->sha256, digest_of(*session.opened_mesh()));
  EXPECT_FALSE(session.is_current(Stage::kSurface));
  const auto report = report_json(session);
  EXPECT_FALSE(report.contains("fidelity"));
  EXPECT_EQ(report["source"]["mesh"]["tets"], mesh.tets.size());
  ASSERT_EQ(report["source"]["labels"].size(), 2U);
  // Half a voxel of error on each side of the bar at the most.
  const double voxel = session.source_volume()->smallest_spacing_mm();
  for (const auto& label : report["source"]["labels"])
    EXPECT_NEAR(label["voxels"].get<double>() * voxel * voxel * voxel, 96, 0.5 * voxel * 128);
}

TEST(OpenedMesh, KeepsTheLabelsThatAreWanted) {
  Session session;
  ASSERT_TRUE(session.load_volume(files_of(bar()).main()).ok());
  Recipe recipe = session.recipe();
  recipe.labels = {2};
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  expect_run(session, Stage::kQuality);
  EXPECT_EQ(session.mesh()->tets.size(), bar().tets.size() / 2);
  EXPECT_EQ(session.mesh()->points.size(), 7U * 5 * 5);
  recipe.labels = {};
  recipe.merge = {{1, 2}};
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  expect_run(session, Stage::kQuality);
  EXPECT_EQ(session.mesh()->tets.size(), bar().tets.size());
  for (const Sides& sides : session.mesh()->face_sides) EXPECT_EQ(sides[1], kBackground);
}

TEST(OpenedMesh, ConductsAlongItsOwnFibres) {
  const TetMesh mesh = bar();
  const auto far_end_ms = [&](const std::string& direction) {
    Files files = files_of(mesh);
    std::string lon = "1\n";
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) lon += direction + "\n";
    files.all["bar.lon"] = bytes_of_text(lon);
    Session session;
    EXPECT_TRUE(session.load_volume(files.main()).ok());
    EXPECT_TRUE(session.set_recipe(with_wave(session.recipe(), 0.25)).ok());
    expect_run(session, Stage::kEikonal);
    return session.eikonal()->fields[0].values[test::nearest_point(mesh, {12, 2, 2})];
  };
  EXPECT_NEAR(far_end_ms("3 0 0"), (12 - 3) / 0.5, 0.5);
  EXPECT_NEAR(far_end_ms("0 1 0"), (12 - 3) / 0.25, 0.5);
}

TEST(OpenedMesh, TurnsInvertedTetrahedraAndLeavesOutUnusedPoints) {
  TetMesh mesh = bar();
  std::swap(mesh.tets[3][0], mesh.tets[3][1]);
  mesh.points.insert(mesh.points.begin(), Eigen::Vector3d(50, 50, 50));
  for (Tet& tet : mesh.tets)
    for (std::uint32_t& point : tet) ++point;
  mesh.faces.clear();
  mesh.face_sides.clear();
  Session session;
  ASSERT_TRUE(session.load_volume(files_of(mesh).main()).ok());
  expect_run(session, Stage::kQuality);
  EXPECT_TRUE(session.quality()->passed());
  EXPECT_EQ(session.mesh()->points.size(), mesh.points.size() - 1);
  ASSERT_EQ(session.warnings().size(), 2U);
  EXPECT_NE(session.warnings()[0].find("1 of 1152 tetrahedra were inverted"), std::string::npos)
      << session.warnings()[0];
  EXPECT_NE(session.warnings()[1].find("1 points belong to no tetrahedron"), std::string::npos);
}

TEST(OpenedMesh, WithFlatTetrahedraIsMeasuredButNotSimulated) {
  TetMesh mesh = bar();
  mesh.points[mesh.tets[7][0]] = mesh.points[mesh.tets[7][1]];
  Session session;
  ASSERT_TRUE(session.load_volume(files_of(mesh).main()).ok());
  expect_run(session, Stage::kQuality);
  EXPECT_FALSE(session.quality()->passed());
  ASSERT_TRUE(session.set_recipe(with_wave(session.recipe())).ok());
  RunContext ctx;
  const Status done = session.run(Stage::kEikonal, ctx);
  ASSERT_FALSE(done.ok());
  EXPECT_NE(done.error().message.find("tetrahedra without volume"), std::string::npos);
  EXPECT_FALSE(done.error().where.elements.empty());
  EXPECT_TRUE(session.is_current(Stage::kQuality));
}

TEST(OpenedMesh, HasNoStagesThatMakeAMesh) {
  Session session;
  ASSERT_TRUE(session.load_volume(files_of(bar()).main()).ok());
  RunContext ctx;
  const Status done = session.run(Stage::kRemesh, ctx);
  ASSERT_FALSE(done.ok());
  EXPECT_NE(done.error().message.find("found the mesh 'bar.elem'"), std::string::npos)
      << done.error().message;
  // A generated body after it is meshed as ever.
  Recipe recipe;
  recipe.source.phantom.emplace();
  recipe.source.phantom->kind = PhantomKind::kSphere;
  recipe.source.phantom->radius_mm = 6;
  recipe.sizing.edge_mm = 3;
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  EXPECT_EQ(session.opened_mesh(), nullptr);
  expect_run(session, Stage::kQuality);
  EXPECT_TRUE(session.is_current(Stage::kRemesh));
}

}  // namespace
}  // namespace voxtet
