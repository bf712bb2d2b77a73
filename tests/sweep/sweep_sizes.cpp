// Target against achieved edge lengths of phantoms and the Table-1 cases, for every kind of rule.
#include <cmath>
#include <functional>

#include "geometry/topology/adjacency.h"
#include "io/volume/write_volume.h"
#include "quality/summarise.h"
#include "support/data.h"
#include "sweep/command_line.h"
#include "sweep/findings.h"
#include "sweep/table_cases.h"

using namespace voxtet;
using namespace voxtet::sweep;

namespace {

constexpr double kMostBias = 0.05, kMostSpread = 0.5;

/// log2(l / h) over edges: the median, and the 95th percentile of the absolute value.
struct SizeFigures {
  std::size_t edges = 0;
  double median = 0, p95 = 0;
};

SizeFigures figures_of(std::vector<float> logs) {
  std::vector<float> absolute = logs;
  for (float& value : absolute) value = std::abs(value);
  return {logs.size(), quantile(logs, 0.5), quantile(absolute, 0.95)};
}

struct Figures {
  SizeFigures surface, inner;  ///< of the edges in the boundaries of labels, and of all others
  /// exp of the mean of min(l / h, h / l) - 1 over all edges: 1 where every edge is as asked for. P. J. Frey
  /// and P.-L. George, "Mesh Generation", efficiency index.
  double efficiency = 0;
  Eigen::Vector3d worst_mm = Eigen::Vector3d::Zero();  ///< middle of the edge that is farthest off
  double worst = 0;                                    ///< its log2(l / h)
};

Figures measure(const TetMesh& mesh, const SizingField& sizing) {
  std::vector<Edge> walls;
  for (const Triangle& t : mesh.faces)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = t[c], b = t[(c + 1) % 3];
      walls.push_back({std::min(a, b), std::max(a, b)});
    }
  std::sort(walls.begin(), walls.end());
  std::vector<float> surface, inner;
  Figures out;
  double sum = 0;
  for (const Edge& edge : tet_edges(mesh.tets, mesh.points.size())) {
    const Eigen::Vector3d &a = mesh.points[edge[0]], &b = mesh.points[edge[1]];
    const double ratio = (b - a).norm() / sizing.at((a + b) / 2);
    const auto log = static_cast<float>(std::log2(ratio));
    sum += std::min(ratio, 1 / ratio) - 1;
    if (std::abs(log) > std::abs(out.worst)) out.worst = log, out.worst_mm = (a + b) / 2;
    (std::binary_search(walls.begin(), walls.end(), edge) ? surface : inner).push_back(log);
  }
  out.efficiency = std::exp(sum / static_cast<double>(surface.size() + inner.size()));
  out.surface = figures_of(std::move(surface));
  out.inner = figures_of(std::move(inner));
  return out;
}

/// Sizes of one and a half to three voxels in waves of forty voxels along the first axis.
ScalarVolume waves(const LabelVolume& volume) {
  ScalarVolume image{volume.size, volume.index_to_mm, {}};
  image.values.reserve(volume.voxel_count());
  const double voxel = volume.smallest_spacing_mm();
  const double along = volume.spacing_mm().x() / voxel;
  for (std::size_t v = 0; v < volume.voxel_count(); ++v) {
    const double phase =
        std::fmod(along * static_cast<double>(v % static_cast<std::size_t>(volume.size[0])), 40);
    image.values.push_back(static_cast<float>(voxel * (1.5 + 1.5 * std::abs(phase - 20) / 20)));
  }
  return image;
}

/// Changes the recipe of an opened case to one kind of rule; false where the case has no such.
Result<bool> set_rule(const std::string& rule, Session& session) {
  Recipe recipe = session.recipe();
  const LabelVolume& volume = *session.source_volume();
  const double voxel = volume.smallest_spacing_mm();
  const bool scar = std::count(recipe.labels.begin(), recipe.labels.end(), 5) > 0;
  const bool pools = std::count(volume.labels.begin(), volume.labels.end(), 3) > 0;
  const bool shell = recipe.source.phantom && recipe.source.phantom->kind == PhantomKind::kShell;
  if (rule == "graded") {
    if (!scar || !recipe.merge.empty()) return false;
    recipe.sizing.labels = {{5, 0.8 * voxel}, {6, 0.8 * voxel}};
  } else if (rule == "thickness") {
    if (!pools && !shell) return false;
    ThicknessSize thickness;
    thickness.wall = recipe.labels;
    if (pools) thickness.inner = {3, 4};
    thickness.edge_thin_mm = 1.25 * voxel;
    thickness.edge_thick_mm = 3 * voxel;
    recipe.sizing.thickness = {thickness};
  } else if (rule == "image") {
    const Result<Bytes> file = write_nifti(waves(volume), false);
    if (!file) return file.error();
    if (Status loaded = session.load_size_image({"waves.nii", *file, {}}); !loaded) return loaded.error();
    recipe.sizing.images = {{"waves.nii", ""}};
  } else if (rule == "curvature") {
    recipe.sizing.edge_mm = 3 * voxel;
    recipe.sizing.curvature = {{{}, 24, voxel}};
  }
  if (Status set = session.set_recipe(recipe); !set) return set.error();
  return true;
}

void print_heading() {
  std::printf(
      "log2(edge / target): median, 95th percentile of the absolute value\n\n"
      "| case | tets | surface edges | median | p95 | inner edges | median | p95 | efficiency | farthest "
      "off, at |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n");
}

std::vector<std::string> judge(const char* where, const SizeFigures& f) {
  std::vector<std::string> failures;
  char text[96];
  if (!(std::abs(f.median) <= kMostBias)) {
    std::snprintf(text, sizeof text, "%s: median log2 l/h %+.3f, expected within %.2f", where, f.median,
                  kMostBias);
    failures.emplace_back(text);
  }
  if (!(f.p95 <= kMostSpread)) {
    std::snprintf(text, sizeof text, "%s: p95 of |log2 l/h| %.3f, expected %.1f", where, f.p95, kMostSpread);
    failures.emplace_back(text);
  }
  return failures;
}

Status sweep_case(const std::string& rule, const std::string& name, Session& session, Findings& findings) {
  const Result<bool> there = set_rule(rule, session);
  if (!there) return there.error();
  if (!*there) return std::monostate{};
  RunContext ctx;
  ctx.threads = 2;
  if (Status done = session.run(Stage::kSizing, ctx); !done) return done;
  if (Status done = session.run(Stage::kOptimise, ctx); !done) return done;
  const Figures found = measure(*session.mesh(), *session.sizing());
  std::printf("| %s | %zu |", name.c_str(), session.mesh()->tets.size());
  nlohmann::json row{{"tets", session.mesh()->tets.size()}};
  std::vector<std::string> failures;
  for (const auto& [where, figures] :
       {std::pair{"surface", found.surface}, std::pair{"inner", found.inner}}) {
    std::printf(" %zu | %+.3f | %.3f |", figures.edges, figures.median, figures.p95);
    row[where] = {{"edges", figures.edges}, {"median", figures.median}, {"p95", figures.p95}};
    for (std::string& failure : judge(where, figures)) failures.push_back(std::move(failure));
  }
  const Eigen::Vector3d& at = found.worst_mm;
  std::printf(" %.3f | %+.1f, (%.0f, %.0f, %.0f) |\n", found.efficiency, found.worst, at.x(), at.y(), at.z());
  row["efficiency"] = found.efficiency;
  row["worst"] = {{"log2", found.worst}, {"at_mm", {at.x(), at.y(), at.z()}}};
  std::fflush(stdout);
  findings.add(name, row, failures);
  return std::monostate{};
}

struct Phantom {
  const char* name;
  PhantomParams params;
  std::vector<Label> labels;
};

std::vector<Phantom> phantoms() {
  PhantomParams ball, shell, torus, heart;
  ball.kind = PhantomKind::kSphere;
  shell.kind = PhantomKind::kShell;
  torus.kind = PhantomKind::kTorus;
  heart.kind = PhantomKind::kBiventricle;
  for (PhantomParams* phantom : {&ball, &shell, &torus}) phantom->spacing_mm.setConstant(1);
  heart.spacing_mm.setConstant(1.25);
  heart.scar = true;
  return {{"ball", ball, {1}},
          {"shell", shell, {1}},
          {"torus", torus, {1}},
          {"phantom heart", heart, {1, 2, 5, 6}}};
}

Status open_phantom(const Phantom& phantom, const std::string& method, Session& session) {
  Result<Recipe> recipe = with_field({}, "remesh.method", method);
  if (!recipe) return recipe.error();
  recipe->source.phantom = phantom.params;
  recipe->labels = phantom.labels;
  recipe->sizing.edge_mm = 2 * phantom.params.spacing_mm.minCoeff();
  return session.set_recipe(*recipe);
}

/// A case by name and how to open it.
struct Case {
  std::string name;
  std::function<Status(Session&)> open;
};

std::vector<Case> all_cases(const std::string& method) {
  std::vector<Case> cases;
  for (const Phantom& phantom : phantoms())
    cases.push_back({phantom.name, [=](Session& session) { return open_phantom(phantom, method, session); }});
  for (const TableCase& c : table_cases())
    if (c.sizes.empty())
      cases.push_back({name_of(c, method), [=](Session& session) -> Status {
                         const std::string path = test::shared_data(c.file);
                         if (path.empty()) return Error{ErrorCode::kBadInput, "sweep", kNotThere, {}};
                         return open_case(c, path, method, session);
                       }});
  return cases;
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line{
      "Target against achieved edge lengths of phantoms and the Table-1 cases. Exit code 1 beyond any "
      "limit."};
  std::string only;
  std::vector<std::string> rules{"uniform", "graded", "thickness", "image", "curvature"};
  line.app.add_option("--only", only, "cases whose name holds this");
  line.app.add_option("--rules", rules, "kinds of rule")
      ->delimiter(',')
      ->check(CLI::IsMember(rules))
      ->capture_default_str();
  line.parse(argc, argv);

  Findings findings;
  print_heading();
  for (const std::string& method : line.methods)
    for (const Case& c : all_cases(method))
      for (const std::string& rule : rules) {
        const std::string name = c.name + ", " + rule;
        if (name.find(only) == std::string::npos) continue;
        Session session;
        RunContext ctx;
        Status done = c.open(session);
        if (done) done = session.run(Stage::kVolume, ctx);
        if (done) done = sweep_case(rule, name, session, findings);
        if (!done) findings.add_error(name, done.error());
      }
  return findings.finish(line.json_file);
}
