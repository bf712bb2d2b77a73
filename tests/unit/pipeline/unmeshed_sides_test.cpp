// Outer faces are told apart by what the image has beyond them.
#include <gtest/gtest.h>

#include "geometry/elements/triangle_measures.h"
#include "pipeline/exports/exported_fields.h"
#include "pipeline/session.h"

namespace voxtet {
namespace {

double area_of(const TetMesh& mesh, const NamedSet& set) {
  double area = 0;
  for (const std::uint32_t f : set.members) {
    const auto& [a, b, c] = mesh.faces[f];
    area += measure_triangle({mesh.points[a], mesh.points[b], mesh.points[c]}).area_mm2;
  }
  return area;
}

const NamedSet* named(const std::vector<NamedSet>& sets, const std::string& name) {
  for (const NamedSet& set : sets)
    if (set.name == name) return &set;
  return nullptr;
}

TEST(UnmeshedSides, AreTheInnerSurfacesOfAHeartWithoutItsBlood) {
  Recipe recipe;
  PhantomParams& heart = recipe.source.phantom.emplace();
  heart.kind = PhantomKind::kBiventricle;
  heart.spacing_mm = Eigen::Vector3d::Constant(2);
  recipe.labels = {1, 2};
  recipe.sizing.edge_mm = 4;
  recipe.legend = {{4, "RV blood", ""}};
  Session session;
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  RunContext ctx;
  ASSERT_TRUE(session.run(Stage::kOptimise, ctx).ok());
  const Exported walls = exported_fields(session, MeshFormat::kMsh, false);
  const NamedSet* left = named(walls.options.surfaces, "LV_myocardium_1__LV_blood_pool_3");
  const NamedSet* septum = named(walls.options.surfaces, "LV_myocardium_1__RV_blood_4");
  const NamedSet* right = named(walls.options.surfaces, "RV_myocardium_2__RV_blood_4");
  ASSERT_TRUE(left && septum && right);

  // With the blood the same surfaces lie between two labels.
  recipe.labels = {};
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  ASSERT_TRUE(session.run(Stage::kOptimise, ctx).ok());
  EXPECT_TRUE(exported_fields(session, MeshFormat::kMsh, false).options.surfaces.empty());
  const TetMesh& whole = *session.mesh();
  const auto between = [&](Label low, Label high) {
    NamedSet set;
    for (std::uint32_t f = 0; f < whole.faces.size(); ++f)
      if (whole.face_sides[f] == Sides{high, low}) set.members.push_back(f);
    return area_of(whole, set);
  };
  Session walls_again;
  recipe.labels = {1, 2};
  ASSERT_TRUE(walls_again.set_recipe(recipe).ok());
  ASSERT_TRUE(walls_again.run(Stage::kOptimise, ctx).ok());
  const TetMesh& mesh = *walls_again.mesh();
  EXPECT_NEAR(area_of(mesh, *left) / between(1, 3), 1, 0.05);
  EXPECT_NEAR(area_of(mesh, *septum) / between(1, 4), 1, 0.1);
  EXPECT_NEAR(area_of(mesh, *right) / between(2, 4), 1, 0.1);
}

}  // namespace
}  // namespace voxtet
