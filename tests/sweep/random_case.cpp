#include "sweep/random_case.h"

#include "base/digest.h"
#include "recipe/recipe.h"
#include "support/check_surface.h"
#include "support/random_labels.h"
#include "sweep/load_labels.h"

namespace voxtet::sweep {
namespace {

std::vector<Label> labels_of(const TetMesh& mesh) {
  std::vector<Label> labels = mesh.labels;
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  return labels;
}

void judge(Stage stage, const Session& session, std::vector<Defect>& defects) {
  const std::string name = name_of(stage);
  if (stage == Stage::kTetra) {
    find_tet_defects(*session.mesh(), *session.remeshed(), defects);
    find_lost_labels(name, session, labels_of(*session.mesh()), defects);
    return;
  }
  const SurfaceMesh* surface = stage == Stage::kSurface  ? session.surface()
                               : stage == Stage::kSmooth ? session.smooth()
                                                         : session.remeshed();
  find_surface_defects(name, *surface, defects);
  find_lost_labels(name, session, test::labels_of(*surface), defects);
}

}  // namespace

Result<RandomCase> run_random_case(std::uint64_t seed, const std::string& method, bool tets) {
  const test::RandomLabels random = test::random_labels(seed);
  RandomCase out{seed, random.kind, random.affine, tets ? Stage::kTetra : Stage::kRemesh, {}, {}, {}, {}};
  Session session;
  if (Status loaded = load_labels(random.volume, session); !loaded) return loaded.error();
  Result<Recipe> recipe = with_field(session.recipe(), "remesh.method", method);
  if (!recipe) return recipe.error();
  recipe->sizing.edge_mm = 2 * random.volume.smallest_spacing_mm();
  if (Status set = session.set_recipe(*recipe); !set) return set.error();
  RunContext ctx;
  for (const Stage stage : {Stage::kSurface, Stage::kSmooth, Stage::kRemesh, Stage::kTetra}) {
    if (stage > out.last) break;
    const Status done = session.run(stage, ctx);
    if (!done) {
      out.defects.push_back(
          {name_of(stage), "error", to_string(done.error().code) + ": " + done.error().message});
      break;
    }
    judge(stage, session, out.defects);
  }
  if (session.mesh())
    out.digest = digest_of(*session.mesh());
  else if (session.remeshed())
    out.digest = digest_of(*session.remeshed());
  for (const std::string& warning : session.record(Stage::kRemesh).warnings)
    if (warning.find("the method adapt was taken instead") != std::string::npos) out.gave_way = warning;
  for (std::size_t i = 0; i < kStageCount; ++i)
    out.seconds[i] = session.record(static_cast<Stage>(i)).seconds;
  return out;
}

}  // namespace voxtet::sweep
