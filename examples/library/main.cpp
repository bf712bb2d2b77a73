// A ball of 20 mm, meshed by the library and written as ball.vtu.
#include <cstdio>

#include "io/mesh/write_mesh.h"
#include "pipeline/session.h"

int main() {
  using namespace voxtet;
  Recipe recipe;
  recipe.source.phantom = {.kind = PhantomKind::kSphere};
  recipe.sizing.edge_mm = 4;
  Session session;
  RunContext ctx;
  Status done = session.set_recipe(recipe);
  if (done) done = session.run(Stage::kQuality, ctx);
  if (done) {
    std::printf("%zu tetrahedra\n", session.mesh()->tets.size());
    const Result<std::vector<OutputFile>> files = write_tet_mesh(*session.mesh(), MeshFormat::kVtu, {});
    done = files ? write_files("ball.vtu", *files) : files.error();
  }
  if (!done) std::fprintf(stderr, "%s: %s\n", done.error().stage.c_str(), done.error().message.c_str());
  return done ? 0 : 1;
}
