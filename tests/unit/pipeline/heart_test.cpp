// A small heart through the stages of its physics: anatomy, fibres, tissue, activation map, excitation wave.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pipeline/exports/exported_fields.h"
#include "pipeline/session.h"
#include "support/half_heart.h"

namespace voxtet {
namespace {

/// Two ventricles of half the size, with the wave from the apex for some milliseconds.
Recipe heart() {
  Recipe recipe = test::half_heart(3);
  PhysicsParams& physics = *recipe.physics;
  TissueLabels& wall = physics.tissue.kinds.emplace_back();
  wall.labels = {1, 2};
  wall.along_mm_per_ms = 0.6;
  wall.across_mm_per_ms = 0.4;
  Stimulus& apex = physics.stimuli.emplace_back();
  apex.centre_mm = {0, 0, -25};
  apex.radius_mm = 12;
  MonodomainParams& wave = physics.monodomain.emplace();
  wave.end_ms = 20;
  wave.step_ms = 0.2;
  wave.electrodes.push_back({"V1", {50, 0, 0}});
  return recipe;
}

/// The heart after a run of everything; made once for all tests that only look at it.
const Session& finished() {
  static const Session* const session = [] {
    auto* made = new Session;
    EXPECT_TRUE(made->set_recipe(heart()).ok());
    RunContext ctx;
    for (const Stage stage : {Stage::kQuality, Stage::kEikonal, Stage::kMonodomain}) {
      const Status done = made->run(stage, ctx);
      EXPECT_TRUE(done.ok()) << done.error().message;
    }
    return made;
  }();
  return *session;
}

std::size_t finite_count(const Field& field) {
  return static_cast<std::size_t>(
      std::count_if(field.values.begin(), field.values.end(), [](float v) { return std::isfinite(v); }));
}

TEST(HeartStages, PassEachItsResultToTheNext) {
  const Session& session = finished();
  const TetMesh& mesh = *session.mesh();
  const auto* anatomy = session.result<AnatomyResult>(Stage::kAnatomy);
  ASSERT_TRUE(anatomy && anatomy->surfaces);
  EXPECT_EQ(anatomy->surfaces->faces.size(), mesh.faces.size());
  EXPECT_TRUE(anatomy->surfaces->right);
  const auto* fibres = session.result<FibresResult>(Stage::kFibres);
  ASSERT_TRUE(fibres);
  ASSERT_EQ(fibres->fields.size(), 2U);
  EXPECT_EQ(fibres->fields[0].name, "fibre");
  EXPECT_EQ(fibres->fields[1].name, "sheet");
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    EXPECT_NEAR(fibres->fibres.fibre[t].norm(), 1, 1e-9);
    for (std::size_t d = 0; d < 3; ++d)
      EXPECT_EQ(fibres->fields[0].values[3 * t + d],
                static_cast<float>(fibres->fibres.fibre[t][static_cast<int>(d)]));
  }
  const auto* tissue = &session.result<TissueResult>(Stage::kTissue)->tissue;
  ASSERT_TRUE(tissue);
  EXPECT_EQ(tissue->fibre, fibres->fibres.fibre);
  EXPECT_EQ(tissue->kind, std::vector<std::uint16_t>(mesh.tets.size(), 0));
  ASSERT_TRUE(session.eikonal());
  const Field& times = session.eikonal()->fields[0];
  EXPECT_EQ(finite_count(times), mesh.points.size());
  EXPECT_EQ(*std::min_element(times.values.begin(), times.values.end()), 0);
  ASSERT_TRUE(session.monodomain());
  EXPECT_EQ(session.monodomain()->times_ms, (std::vector<double>{0, 5, 10, 15, 20}));
  ASSERT_EQ(session.monodomain()->traces.size(), 1U);
  EXPECT_EQ(session.monodomain()->traces[0].title, "V1");
  EXPECT_EQ(session.monodomain()->traces[0].values.size(), 20U);
  const Field* activation = find_field(session.monodomain()->fields, "activation_ms");
  ASSERT_TRUE(activation);
  EXPECT_GT(finite_count(*activation), mesh.points.size() / 10) << "the wave has spread";
}

TEST(HeartStages, WriteWhatTheyFoundWhereTheFormatHasAPlaceForIt) {
  const Exported vtu = exported_fields(finished(), MeshFormat::kVtu, false);
  EXPECT_TRUE(find_field(vtu.options.cell_data, "fibre"));
  EXPECT_TRUE(find_field(vtu.options.cell_data, "sheet"));
  for (const char* name : {"eikonal_ms", "activation_ms", "activations"})
    EXPECT_TRUE(find_field(vtu.options.point_data, name)) << name;
  EXPECT_TRUE(vtu.left_out.empty());
  EXPECT_EQ(vtu.options.infos.size(), finished().volume()->infos.size());

  const Exported msh = exported_fields(finished(), MeshFormat::kMsh, false);
  EXPECT_TRUE(find_field(msh.options.cell_data, "fibre"));
  EXPECT_TRUE(msh.options.point_data.empty());

  const Exported abaqus = exported_fields(finished(), MeshFormat::kAbaqus, true);
  ASSERT_GE(abaqus.left_out.size(), 3U);
  EXPECT_EQ(abaqus.left_out[0], "fibre");
  EXPECT_EQ(abaqus.left_out[1], "sheet");
  EXPECT_EQ(abaqus.left_out[2], "eikonal_ms");
  EXPECT_FALSE(abaqus.options.cell_data.empty()) << "measures, of one component each";
  for (const MeshFormat format :
       {MeshFormat::kVtu, MeshFormat::kXdmf, MeshFormat::kCarp, MeshFormat::kMsh, MeshFormat::kMedit,
        MeshFormat::kAbaqus, MeshFormat::kFebio, MeshFormat::kStl, MeshFormat::kPly}) {
    const auto files =
        write_tet_mesh(*finished().mesh(), format, exported_fields(finished(), format, true).options);
    EXPECT_TRUE(files.ok()) << files.error().message;
  }
}

/// The first stage whose key is another one in a changed recipe.
Stage first_changed(void (*change)(Recipe&)) {
  Recipe recipe = heart();
  const StageKeys before = keys_of(recipe, {});
  change(recipe);
  const StageKeys after = keys_of(recipe, {});
  int first = 0;
  while (first < kStageCount &&
         before[static_cast<std::size_t>(first)] == after[static_cast<std::size_t>(first)])
    ++first;
  return static_cast<Stage>(first);
}

TEST(HeartStages, RunAgainOnlyFromTheOneThatReadsAChangedField) {
  EXPECT_EQ(first_changed([](Recipe& r) { r.physics->anatomy->lv_pool = {3}; }), Stage::kAnatomy);
  EXPECT_EQ(first_changed([](Recipe& r) { r.physics->fibres->wall.alpha_endo = 50; }), Stage::kFibres);
  EXPECT_EQ(first_changed([](Recipe& r) { r.physics->tissue.kinds[0].across_mm_per_ms = 0.3; }),
            Stage::kTissue);
  EXPECT_EQ(first_changed([](Recipe& r) { r.physics->stimuli[0].radius_mm = 13; }), Stage::kEikonal);
  EXPECT_EQ(first_changed([](Recipe& r) { r.physics->monodomain->end_ms = 30; }), Stage::kMonodomain);
}

TEST(HeartStages, UseAgainWhatAChangeDoesNotReach) {
  Session session;
  Recipe recipe = heart();
  recipe.physics->monodomain.reset();
  RunContext ctx;
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  ASSERT_TRUE(session.run(Stage::kEikonal, ctx).ok());
  const std::vector<float> before = session.eikonal()->fields[0].values;

  recipe.physics->stimuli[0].start_ms = 7;
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  ASSERT_TRUE(session.run(Stage::kEikonal, ctx).ok());
  for (const Stage stage : {Stage::kOptimise, Stage::kAnatomy, Stage::kFibres, Stage::kTissue})
    EXPECT_TRUE(session.cached(stage)) << name_of(stage);
  EXPECT_FALSE(session.cached(Stage::kEikonal));
  // All times are later by as much.
  for (std::size_t p = 0; p < before.size(); ++p)
    EXPECT_NEAR(session.eikonal()->fields[0].values[p], before[p] + 7, 1e-4) << p;

  recipe.physics->tissue.kinds[0].along_mm_per_ms = 1.2;
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  ASSERT_TRUE(session.run(Stage::kEikonal, ctx).ok());
  for (const Stage stage : {Stage::kOptimise, Stage::kAnatomy, Stage::kFibres})
    EXPECT_TRUE(session.cached(stage)) << name_of(stage);
  EXPECT_FALSE(session.cached(Stage::kTissue));
}

TEST(HeartStages, GiveTheSameWaveInOnePartAndInMany) {
  Session session(0);  // keeps nothing that the recipe does not need
  Recipe recipe = heart();
  RunContext ctx;
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  ASSERT_TRUE(session.run(Stage::kMonodomain, ctx).ok());
  const std::string whole = session.monodomain()->digest;
  EXPECT_EQ(whole, finished().monodomain()->digest);

  recipe.physics->monodomain->end_ms = 1;
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  ASSERT_TRUE(session.run(Stage::kMonodomain, ctx).ok());
  EXPECT_NE(session.monodomain()->digest, whole);

  ASSERT_TRUE(session.set_recipe(heart()).ok());
  session.begin(Stage::kMonodomain);
  int parts = 0;
  for (bool done = false; !done; ++parts) {
    const Result<RunProgress> progress = session.advance(0, ctx);
    ASSERT_TRUE(progress.ok()) << progress.error().message;
    done = progress->done;
  }
  EXPECT_GT(parts, 10);
  EXPECT_FALSE(session.cached(Stage::kMonodomain));
  EXPECT_EQ(session.monodomain()->digest, whole);
}

/// A session that has come to the excitation wave of the recipe, and to `parts` parts of it.
void begin_wave(Session& session, const Recipe& recipe, int parts) {
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  RunContext ctx;
  session.begin(Stage::kMonodomain);
  for (int part = 0; part < parts;) {
    const Result<RunProgress> progress = session.advance(0, ctx);
    ASSERT_TRUE(progress.ok()) << progress.error().message;
    part += progress->stage == Stage::kMonodomain;
  }
}

TEST(HeartStages, AStimulusThatComesWhileTheWaveRunsIsAPartOfTheCase) {
  Session session(0);
  RunContext ctx;
  Stimulus more;
  more.centre_mm = {0, 0, 20};
  more.radius_mm = 12;
  EXPECT_EQ(session.stimulate(more).error().message, "stimulus: found no simulation under way, expected one");
  begin_wave(session, heart(), 3);
  const Result<Stimulus> given = session.stimulate(more);
  ASSERT_TRUE(given.ok()) << given.error().message;
  EXPECT_GT(given->start_ms, 0);
  more.centre_mm = {500, 0, 0};
  more.radius_mm = 1;
  EXPECT_EQ(session.stimulate(more).error().message.substr(0, 9), "stimulus:");
  for (bool done = false; !done;) {
    const Result<RunProgress> progress = session.advance(5, ctx);
    ASSERT_TRUE(progress.ok());
    done = progress->done;
  }
  ASSERT_EQ(session.recipe().physics->stimuli.size(), 2U);
  const std::string live = session.monodomain()->digest;
  EXPECT_NE(live, finished().monodomain()->digest);

  Session again(0);
  ASSERT_TRUE(again.set_recipe(*parse_recipe(recipe_to_json(session.recipe()))).ok());
  ASSERT_TRUE(again.run(Stage::kMonodomain, ctx).ok());
  EXPECT_EQ(again.monodomain()->digest, live);
}

TEST(HeartStages, AWaveGoesOnFromASavedState) {
  RunContext ctx;
  Session session(0);
  Recipe recipe = heart();
  // An end that is no time of a frame, and one to which no whole part leads.
  recipe.physics->monodomain->end_ms = 12.4;
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  ASSERT_TRUE(session.run(Stage::kMonodomain, ctx).ok());
  const Result<Bytes> state = session.saved_state();
  ASSERT_TRUE(state.ok());

  // In the same session, of itself.
  int frames = 0;
  RunContext counting;
  counting.on_snapshot = [&](const Snapshot&) { ++frames; };
  ASSERT_TRUE(session.set_recipe(heart()).ok());
  ASSERT_TRUE(session.run(Stage::kMonodomain, counting).ok());
  EXPECT_EQ(frames, 2);
  EXPECT_EQ(session.monodomain()->digest, finished().monodomain()->digest);
  EXPECT_EQ(session.monodomain()->times_ms, finished().monodomain()->times_ms);
  EXPECT_EQ(session.monodomain()->traces[0].values, finished().monodomain()->traces[0].values);

  // In another, after what was cancelled in the middle of a step.
  Session other(0);
  begin_wave(other, heart(), 3);
  const Result<Bytes> middle = other.saved_state();
  ASSERT_TRUE(middle.ok());
  Session last(0);
  last.resume_from(Stage::kMonodomain, *middle);
  frames = 0;
  ASSERT_TRUE(last.set_recipe(heart()).ok());
  ASSERT_TRUE(last.run(Stage::kMonodomain, counting).ok());
  EXPECT_LT(frames, 5);
  EXPECT_EQ(last.monodomain()->digest, finished().monodomain()->digest);

  // From what does not fit.
  const auto error_of = [&](const Recipe& changed, const Bytes& from) {
    last.resume_from(Stage::kMonodomain, from);
    EXPECT_TRUE(last.set_recipe(changed).ok());
    const Status done = last.run(Stage::kMonodomain, ctx);
    return done.ok() ? "none" : done.error().message;
  };
  Recipe changed = heart();
  changed.physics->stimuli[0].radius_mm = 11;
  EXPECT_EQ(error_of(changed, *state).substr(0, 46), "state: was made from another physics.stimuli, ");
  changed = heart();
  changed.physics->monodomain->end_ms = 8;
  EXPECT_EQ(
      error_of(changed, *state),
      "physics.monodomain.end_ms: found 8, expected at least the 12.400000 ms that the state has reached");
  changed.physics->monodomain->end_ms = 30;
  EXPECT_EQ(error_of(changed, {1, 2, 3}),
            "state: found bytes of another kind, expected the saved state of a simulation");
  EXPECT_EQ(error_of(changed, Bytes(state->begin(), state->end() - 9)),
            "state: found cut or damaged bytes, expected a whole file");
  // Of itself a session goes on only where it may.
  changed.physics->stimuli[0].radius_mm = 11;
  ASSERT_TRUE(last.set_recipe(changed).ok());
  frames = 0;
  ASSERT_TRUE(last.run(Stage::kMonodomain, counting).ok());
  EXPECT_EQ(frames, 7);
}

TEST(HeartStages, SayWhatTheCaseLacks) {
  Session session;  // the mesh is that of all these cases
  const auto error_of = [&](void (*change)(Recipe&), Stage stage) {
    Recipe recipe = heart();
    change(recipe);
    EXPECT_TRUE(session.set_recipe(recipe).ok());
    RunContext ctx;
    const Status done = session.run(stage, ctx);
    return done.ok() ? std::string("none") : done.error().message;
  };
  EXPECT_EQ(error_of([](Recipe& r) { r.physics->anatomy.reset(); }, Stage::kFibres),
            "physics.fibres: found no physics.anatomy beside it, expected one: fibres follow the ventricles' "
            "surfaces");
  EXPECT_EQ(error_of([](Recipe& r) { r.physics->monodomain.reset(); }, Stage::kMonodomain),
            "physics.monodomain: found none, expected when and how long to simulate");
  EXPECT_EQ(
      error_of([](Recipe& r) { r.physics->tissue.kinds.clear(); }, Stage::kTissue),
      "physics.tissue.kinds: found no entry, expected at least one: which labels conduct, and how fast");
  EXPECT_EQ(error_of([](Recipe& r) { r.physics->stimuli.clear(); }, Stage::kEikonal),
            "physics.stimuli: found none, expected at least one, where the wave starts");
}

TEST(HeartStages, WithoutAnatomyAndFibresGiveTissueThatIsTheSameInAllDirections) {
  Session session;
  Recipe recipe = heart();
  recipe.physics->anatomy.reset();
  recipe.physics->fibres.reset();
  ASSERT_TRUE(session.set_recipe(recipe).ok());
  RunContext ctx;
  const Status done = session.run(Stage::kTissue, ctx);
  ASSERT_TRUE(done.ok()) << done.error().message;
  EXPECT_FALSE(session.result<AnatomyResult>(Stage::kAnatomy)->surfaces);
  EXPECT_TRUE(session.result<TissueResult>(Stage::kTissue)->tissue.fibre.empty());
  EXPECT_FALSE(find_field(exported_fields(session, MeshFormat::kVtu, false).options.cell_data, "fibre"));
}

}  // namespace
}  // namespace voxtet
