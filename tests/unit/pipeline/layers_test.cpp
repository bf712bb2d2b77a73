// Exact layers from a volume to the finished mesh.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/digest.h"
#include "io/bytes/files.h"
#include "io/volume/write_volume.h"
#include "pipeline/report.h"
#include "pipeline/session.h"
#include "support/check_tets.h"
#include "support/data.h"
#include "support/wall_bodies.h"

namespace voxtet {
namespace {

Recipe exact_recipe(std::uint32_t layers) {
  Recipe recipe;
  recipe.labels = {1};
  recipe.sizing.edge_mm = 10;
  recipe.sizing.thickness.resize(1);
  recipe.sizing.thickness[0] = {{1}, {2}, layers, Layering::kExact};
  return recipe;
}

Status mesh_volume(const LabelVolume& volume, Recipe recipe, Session& session) {
  const Bytes bytes = write_nifti(volume, true).value();
  EXPECT_TRUE(session.load_volume({"body.nii.gz", bytes, {}}).ok());
  recipe.source = session.recipe().source;
  EXPECT_TRUE(session.set_recipe(recipe).ok());
  RunContext ctx;
  return session.run(Stage::kQuality, ctx);
}

/// Meshes, and expects sound tetrahedra that pass every check.
void mesh_soundly(const LabelVolume& volume, const Recipe& recipe, Session& session) {
  const Status done = mesh_volume(volume, recipe, session);
  ASSERT_TRUE(done.ok()) << done.error().message;
  test::check_tets(*session.mesh());
  EXPECT_TRUE(session.quality()->passed());
}

double smallest_dihedral(const Session& session) {
  return session.quality()->metrics.at(0).min;
}

void expect_exact_layers(const LabelVolume& volume, std::uint32_t layers) {
  Session session;
  const Status done = mesh_volume(volume, exact_recipe(layers), session);
  ASSERT_TRUE(done.ok()) << done.error().message;
  test::check_tets(*session.mesh());
  const QualityReport& quality = *session.quality();
  EXPECT_TRUE(quality.passed());
  EXPECT_TRUE(quality.topology.differences.empty());
  EXPECT_TRUE(std::all_of(session.mesh()->labels.begin(), session.mesh()->labels.end(),
                          [](Label label) { return label == 1; }));
  const LayerCount& found = quality.layers.at(0);
  EXPECT_EQ(found.target_layers, layers);
  EXPECT_EQ(found.by_edges.exact, 1);
  EXPECT_EQ(found.by_lines.exact, 1);
  EXPECT_TRUE(found.places.empty());
  ASSERT_EQ(quality.metrics.at(0).name, "min_dihedral_deg");
  EXPECT_GE(smallest_dihedral(session), 25);
}

TEST(Layers, AreExactAllOverASphericalShell) {
  const LabelVolume volume = test::sample(test::shell(16, 20), Eigen::Vector3d::Ones(), {10, 20, 30});
  for (const std::uint32_t layers : {1U, 2U, 3U, 4U}) {
    SCOPED_TRACE(layers);
    expect_exact_layers(volume, layers);
  }
}

TEST(Layers, OfAWallThatIsNotMeshedAreWarnedOf) {
  const LabelVolume volume = test::sample(test::shell(8, 12), Eigen::Vector3d::Ones(), {});
  Recipe recipe = exact_recipe(2);
  recipe.labels = {2};
  recipe.sizing.thickness[0].layering = Layering::kSize;
  const Bytes bytes = write_nifti(volume, true).value();
  Session session;
  ASSERT_TRUE(session.load_volume({"shell.nii.gz", bytes, {}}).ok());
  recipe.source = session.recipe().source;
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  std::vector<std::string> warnings;
  RunContext ctx;
  ctx.on_warning = [&](const std::string&, const std::string& message) { warnings.push_back(message); };
  const Status done = session.run(Stage::kQuality, ctx);
  ASSERT_TRUE(done.ok()) << done.error().message;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
    return warning.starts_with("sizing.thickness[0].layers: not counted");
  }));
}

TEST(Layers, AreExactAllOverAnEllipsoidalShell) {
  const LabelVolume volume =
      test::sample(test::ellipsoidal_shell(15, 14, 18), Eigen::Vector3d::Ones(), {37, 0, 20});
  for (const std::uint32_t layers : {1U, 2U, 3U, 4U}) {
    SCOPED_TRACE(layers);
    expect_exact_layers(volume, layers);
  }
}

const ChecklistItem& exact_layers_of(const QualityReport& quality) {
  const auto found = std::find_if(quality.checklist.begin(), quality.checklist.end(),
                                  [](const ChecklistItem& item) { return item.name == "exact_layers"; });
  EXPECT_NE(found, quality.checklist.end());
  return *found;
}

/// Layers far thicker than the triangles that would follow the surface to half a voxel, on which the base is
/// a sharp rim.
TEST(Layers, AreExactInThickWallsClosedAndOpen) {
  test::Body open = test::shell(20, 44);
  open.label_at = [whole = open.label_at](const Eigen::Vector3d& p) -> Label {
    return p.z() < 0 ? whole(p) : kBackground;
  };
  for (const test::Body& body : {test::shell(20, 36), open}) {
    const LabelVolume volume = test::sample(body, Eigen::Vector3d::Constant(2), {0, 0, 0});
    for (const std::uint32_t layers : {1U, 2U, 3U}) {
      SCOPED_TRACE(layers);
      Session session;
      ASSERT_NO_FATAL_FAILURE(mesh_soundly(volume, exact_recipe(layers), session));
      const QualityReport& quality = *session.quality();
      EXPECT_GE(quality.layers.at(0).by_edges.exact, 0.97);
      EXPECT_GE(quality.layers.at(0).by_lines.exact, 0.97);
      EXPECT_TRUE(exact_layers_of(quality).passed);
      EXPECT_TRUE(quality.topology.differences.empty());
      EXPECT_NEAR(quality.labels.at(0).volume_error_percent, 0, 0.5);
      EXPECT_GE(smallest_dihedral(session), 18);
    }
  }
}

/// Triangles held to a fraction of a voxel are too small for one layer.
TEST(Layers, ThatAreGivenUpAreNoted) {
  const LabelVolume volume = test::sample(test::shell(8, 18), Eigen::Vector3d::Ones(), {0, 0, 0});
  Recipe recipe = exact_recipe(1);
  recipe.remesh.max_distance_voxels = 0.03;
  Session session;
  ASSERT_NO_FATAL_FAILURE(mesh_soundly(volume, recipe, session));
  const QualityReport& quality = *session.quality();
  ASSERT_LT(quality.layers.at(0).by_edges.exact, LayerCount::kNearlyAll);
  EXPECT_TRUE(quality.layers.at(0).given_up());
  EXPECT_FALSE(exact_layers_of(quality).passed);
  const std::vector<std::string> warnings = session.warnings();
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& text) {
    return text.find("sizing.thickness[0].layers: exactly 1 on ") != std::string::npos;
  }));
}

/// Two inner spaces in one body, with a septum between them, from end to end.
TEST(Layers, MeetWithoutAJumpWhereWallsMeet) {
  const test::Body body{[](const Eigen::Vector3d& p) -> Label {
                          const Eigen::Vector3d left = p + Eigen::Vector3d(9, 0, 0);
                          const Eigen::Vector3d right = p - Eigen::Vector3d(9, 0, 0);
                          if (left.norm() < 6.5) return 2;
                          if (right.norm() < 6.5) return 3;
                          return left.norm() < 11.5 || right.norm() < 11.5 ? 1 : 0;
                        },
                        {},
                        24};
  const LabelVolume volume = test::sample(body, Eigen::Vector3d::Ones(), {0, 0, 0});
  for (const std::uint32_t layers : {2U, 3U}) {
    SCOPED_TRACE(layers);
    Recipe recipe = exact_recipe(layers);
    recipe.sizing.thickness[0].inner = {2, 3};
    Session session;
    ASSERT_NO_FATAL_FAILURE(mesh_soundly(volume, recipe, session));
    const LayerShares& found = session.quality()->layers.at(0).by_edges;
    EXPECT_EQ(found.at_least, 1);
    EXPECT_GE(found.exact, 0.97);
  }
}

TEST(Layers, EndAtTheRimOfASlab) {
  const LabelVolume volume = test::sample(test::slab(6), Eigen::Vector3d::Ones(), {0, 0, 0});
  Session session;
  ASSERT_NO_FATAL_FAILURE(mesh_soundly(volume, exact_recipe(2), session));
  EXPECT_EQ(session.quality()->layers.at(0).by_edges.exact, 1);
}

TEST(Layers, PassThroughTheInterfacesOfAWallOfTwoLabels) {
  LabelVolume volume = test::sample(test::shell(14, 20), Eigen::Vector3d::Ones(), {0, 0, 0});
  for (int k = 0; k < volume.size[2] / 2; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i)
        if (Label& label = volume.labels[volume.offset(i, j, k)]; label == 1) label = 5;
  Recipe recipe = exact_recipe(2);
  recipe.labels = recipe.sizing.thickness[0].wall = {1, 5};
  Session session;
  ASSERT_NO_FATAL_FAILURE(mesh_soundly(volume, recipe, session));
  EXPECT_TRUE(session.quality()->topology.differences.empty());
  const LayerShares& found = session.quality()->layers.at(0).by_edges;
  EXPECT_EQ(found.at_least, 1);
  EXPECT_GE(found.exact, 0.9);
}

/// A bowl, whose wall is one interface with background, inside and out: coarse first points on it may leave
/// no circumcentre in the wall.
TEST(Layers, AreAsCoarseAsAskedForInAnOpenBowl) {
  for (const double thickness : {3.0, 6.0}) {
    SCOPED_TRACE(thickness);
    const test::Body body{[=](const Eigen::Vector3d& p) -> Label {
                            if (p.z() > 7 || p.norm() > 15 + thickness) return 0;
                            return p.norm() < 15 ? 2 : 1;
                          },
                          {},
                          25};
    const LabelVolume volume = test::sample(body, Eigen::Vector3d::Ones(), {0, 0, 0});
    Session session;
    ASSERT_NO_FATAL_FAILURE(mesh_soundly(volume, exact_recipe(1), session));
    EXPECT_GE(session.quality()->layers.at(0).by_edges.exact, 0.95);
    EXPECT_LT(session.mesh()->tets.size(), 3000U);
  }
}

TEST(Layers, LeaveAloneWhatOfAMergedLabelLiesOutsideOfTheWall) {
  const test::Body body{[](const Eigen::Vector3d& p) -> Label {
                          if (p.norm() < 20) return p.norm() < 14 ? 2 : 1;
                          return (p - Eigen::Vector3d(24, 0, 0)).norm() < 9 ? 5 : 0;
                        },
                        {},
                        34};
  const LabelVolume volume = test::sample(body, Eigen::Vector3d::Ones(), {0, 0, 0});
  Recipe recipe = exact_recipe(2);
  recipe.labels = {1, 5};
  recipe.merge = {{1, 5}};
  Session session;
  ASSERT_NO_FATAL_FAILURE(mesh_soundly(volume, recipe, session));
  EXPECT_TRUE(session.quality()->topology.differences.empty());
  EXPECT_NEAR(session.quality()->labels.at(0).volume_error_percent, 0, 0.5);
  EXPECT_GE(session.quality()->layers.at(0).by_edges.exact, 0.9);
}

TEST(Layers, KeepLabelsThatTouchThemselvesWhereNoLayerDoes) {
  Recipe recipe = exact_recipe(3);
  recipe.source.phantom.emplace().spacing_mm.setConstant(2.5);
  recipe.labels = recipe.sizing.thickness[0].wall = {1, 2};
  recipe.sizing.thickness[0].inner = {3, 4};
  Session session;
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  RunContext ctx;
  const Status done = session.run(Stage::kQuality, ctx);
  ASSERT_TRUE(done.ok()) << done.error().message;
  test::check_tets(*session.mesh());
  EXPECT_TRUE(session.quality()->topology.differences.empty());
  EXPECT_EQ(session.record(Stage::kRemesh).notes, std::vector<std::string>{"method delaunay"});
  const LayerShares& found = session.quality()->layers.at(0).by_edges;
  EXPECT_GE(found.at_least, 0.99);
  EXPECT_GE(found.exact, 0.95);
}

TEST(Layers, LeaveNothingOfThemselvesInLaterStages) {
  const LabelVolume volume = test::sample(test::shell(10, 16), Eigen::Vector3d::Ones(), {0, 0, 0});
  Recipe recipe = exact_recipe(3);
  Session session;
  ASSERT_TRUE(mesh_volume(volume, recipe, session).ok());
  const std::string digest = digest_of(*session.mesh());
  for (const Sides& sides : session.remeshed()->sides) EXPECT_EQ(sides, (Sides{1, 0}));
  for (const Sides& sides : session.mesh()->face_sides) EXPECT_EQ(sides, (Sides{1, 0}));
  EXPECT_EQ(session.filled()->labels.size(), session.filled()->tets.size());
  for (const Label label : session.filled()->labels) EXPECT_EQ(label, 1);

  recipe.source = session.recipe().source;
  recipe.sizing.thickness[0].layering = Layering::kSize;
  RunContext ctx;
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  ASSERT_TRUE(session.run(Stage::kQuality, ctx).ok());
  EXPECT_NE(digest_of(*session.mesh()), digest);
  recipe.sizing.thickness[0].layering = Layering::kExact;
  ctx.threads = 2;
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  ASSERT_TRUE(session.run(Stage::kQuality, ctx).ok());
  EXPECT_EQ(digest_of(*session.mesh()), digest);
}

TEST(Layers, AreRefusedWhereTheyCannotBe) {
  const LabelVolume volume = test::sample(test::shell(10, 16), Eigen::Vector3d::Ones(), {0, 0, 0});
  const auto message = [&](const Recipe& recipe) {
    Session session;
    const Status done = mesh_volume(volume, recipe, session);
    return done.ok() ? std::string() : done.error().message;
  };
  EXPECT_EQ(message(exact_recipe(0)),
            "sizing.thickness[0].layers: found 0, expected at least 1 where layering is exact");
  Recipe recipe = exact_recipe(2);
  recipe.remesh.method = RemeshMethod::kAdapt;
  EXPECT_NE(message(recipe).find("remesh.method: found adapt, expected delaunay"), std::string::npos);
  recipe = exact_recipe(2);
  recipe.sizing.thickness.push_back(recipe.sizing.thickness[0]);
  EXPECT_NE(message(recipe).find("sizing.thickness[1].wall: found no meshed label"), std::string::npos);
}

/// The walls of a mean heart, 2.5 to 11 mm thick. In voxels of 2 mm facets leave no room for all of the
/// sheets.
void expect_layers_all_over_a_heart(const std::string& file, std::uint32_t layers) {
  const std::string path = test::shared_data(file);
  if (path.empty()) GTEST_SKIP() << "no shared data";
  Session session;
  const Bytes bytes = read_file(path).value();
  ASSERT_TRUE(session.load_volume({file, bytes, {}}).ok());
  Recipe recipe = exact_recipe(layers);
  recipe.source = session.recipe().source;
  recipe.labels = recipe.sizing.thickness[0].wall = {1, 2};
  recipe.merge = {{1, 2}};
  recipe.sizing.thickness[0].inner = {3, 4};
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  RunContext ctx;
  const Status done = session.run(Stage::kQuality, ctx);
  ASSERT_TRUE(done.ok()) << done.error().message;
  test::check_tets(*session.mesh());
  EXPECT_TRUE(session.quality()->passed());
  EXPECT_TRUE(session.quality()->topology.differences.empty());
  const LayerCount& found = session.quality()->layers.at(0);
  EXPECT_GE(found.by_edges.exact, 0.95);
  EXPECT_EQ(found.by_edges.at_least, 1);
  EXPECT_GE(found.by_lines.exact, 0.95);
}

TEST(Layers, AreExactNearlyAllOverAHeart) {
  expect_layers_all_over_a_heart("biv_mean_1mm.nii.gz", 2);
}

TEST(Layers, AreNoFewerWhereSheetsHaveNoRoom) {
  expect_layers_all_over_a_heart("biv_mean_2mm_float32.nii.gz", 3);
}

}  // namespace
}  // namespace voxtet
