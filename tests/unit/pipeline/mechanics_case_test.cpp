// Cases of mechanics from a session.
#include "pipeline/exports/mechanics_case.h"

#include <gtest/gtest.h>

#include <string>

#include "support/half_heart.h"

namespace voxtet {
namespace {

/// All files of the case for FEBio, or why there is none.
std::string febio_case(const Recipe& recipe) {
  Session session;
  EXPECT_TRUE(session.set_recipe(recipe).ok());
  RunContext ctx;
  const Status done = session.run(Stage::kFibres, ctx);
  EXPECT_TRUE(done.ok()) << done.error().message;
  const auto files = mechanics_case_files(session, MechanicsProgram::kFebio, {});
  if (!files) return files.error().message;
  std::string text;
  for (const OutputFile& file : *files) text.append(file.bytes.begin(), file.bytes.end());
  return text;
}

TEST(MechanicsCaseFiles, AreHeldAtTheBaseAndLoadedInBothCavities) {
  const std::string text = febio_case(test::half_heart(4));
  for (const char* part :
       {"node_set=\"@surface:base\"", "type=\"pressure\" surface=\"lv_endocardium\"",
        "type=\"pressure\" surface=\"rv_endocardium\"", "type=\"pressure\" surface=\"rv_septum\"",
        "<pressure lc=\"1\">1</pressure>", "<time_steps>10</time_steps>", "<k>1000</k>", "<ksi>1.5</ksi>"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
  EXPECT_EQ(text.find("surface=\"epicardium\""), std::string::npos);
}

TEST(MechanicsCaseFiles, HaveTheMaterialOfTheRecipe) {
  Recipe recipe = test::half_heart(4);
  BeatParams& muscle = recipe.physics->mechanics.emplace();
  muscle.bulk_kpa = 500;
  muscle.material.mooney_rivlin.emplace(mechanics::MooneyRivlin{2, 0.5});
  muscle.labels = {{{2}, 3, 1}};
  const std::string text = febio_case(recipe);
  for (const char* part : {"<c1>2</c1>\n<c2>0.5</c2>\n<k>500</k>", "- label 2 is as stiff as the others"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
  EXPECT_EQ(text.find("type=\"fiber-exp-pow"), std::string::npos);
  muscle.material.mooney_rivlin.reset();
  muscle.material.guccione.emplace();
  EXPECT_EQ(febio_case(recipe),
            "physics.mechanics.material: found one that a case of mechanics is not written with, expected "
            "transversely_isotropic or mooney_rivlin");
}

TEST(MechanicsCaseFiles, NeedNamedSurfacesAndFibres) {
  Recipe recipe = test::half_heart(4);
  recipe.physics->fibres.reset();
  EXPECT_EQ(febio_case(recipe),
            "a case of mechanics: found no physics.anatomy with physics.fibres, expected both");
}

TEST(MechanicsCaseFiles, NeedEmptyCavities) {
  Recipe recipe = test::half_heart(4);
  recipe.source.phantom->blood_pools = true;
  recipe.labels = {1, 2, 3};
  recipe.physics->anatomy->wall = {1, 2};
  recipe.physics->anatomy->lv_pool = {3};
  recipe.physics->anatomy->rv_pool = {4};
  EXPECT_EQ(
      febio_case(recipe),
      "lv_endocardium: found the meshed labels 3 and 1 on its sides, expected an empty cavity: mesh the "
      "wall alone");
}

}  // namespace
}  // namespace voxtet
