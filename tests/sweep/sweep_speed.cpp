// Seconds of one thread for the stages up to the adapted surface, and the share of each; for thickness and
// gradation.
#include <algorithm>
#include <ctime>
#include <limits>

#include "io/volume/read_volume.h"
#include "remesh/field/label_field.h"
#include "support/data.h"
#include "support/large_heart.h"
#include "sweep/command_line.h"
#include "sweep/findings.h"
#include "sweep/load_labels.h"

using namespace voxtet;
using namespace voxtet::sweep;

namespace {

#ifdef __EMSCRIPTEN__
constexpr double kSlower = 1.6, kSizingSlower = 1.5;
#else
constexpr double kSlower = 1, kSizingSlower = 1;
#endif
constexpr double kEdgeMm = 1.5, kLeastMegavoxels = 10;
constexpr double kThicknessLimit = 3 * kSizingSlower, kGradationLimit = kSizingSlower;  ///< seconds

struct Timed {
  const char* file;
  std::vector<Label> labels;
  bool merge;
  const char* method;
  double limit_s;  ///< for the adapted surface, label field included, native
};

std::vector<Timed> all_timed() {
  const std::vector<Label> heart{1, 2}, scar{1, 2, 5, 6};
  return {{"biv_mean_1mm.nii.gz", heart, true, "delaunay", 1.2},
          {"biv_ed_scar_1mm.nii.gz", scar, false, "delaunay", 2.5},
          {"biv_ed_scar_1mm.nii.gz", scar, false, "adapt", 10}};
}

template <class Work>
double seconds_of(Work&& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

Result<double> seconds_to(Stage stage, Session& session) {
  RunContext ctx;
  Status done = std::monostate{};
  const double seconds = seconds_of([&] { done = session.run(stage, ctx); });
  if (!done) return done.error();
  return seconds;
}

Status prepare(const Timed& t, Session& session) {
  const Result<LabelVolume> volume = read_volume_file(test::shared_data(t.file));
  if (!volume) return volume.error();
  if (Status loaded = load_labels(*volume, session); !loaded) return loaded;
  Result<Recipe> recipe = with_field(session.recipe(), "remesh.method", t.method);
  if (!recipe) return recipe.error();
  recipe->remesh.keep_topology = KeepTopology::kNothing;  // each method on its own
  recipe->labels = t.labels;
  if (t.merge) recipe->merge = {t.labels};
  recipe->sizing.edge_mm = kEdgeMm;
  return session.set_recipe(*recipe);
}

Result<nlohmann::json> measure(const Timed& t) {
  Session session;
  if (Status ready = prepare(t, session); !ready) return ready.error();
  nlohmann::json row;
  for (const Stage stage :
       {Stage::kVolume, Stage::kSurface, Stage::kSmooth, Stage::kSizing, Stage::kRemesh}) {
    const Result<double> seconds = seconds_to(stage, session);
    if (!seconds) return seconds.error();
    row[name_of(stage)] = *seconds;
  }
  row["label_field"] = seconds_of([&] { remesh::LabelField(*session.volume(), *session.smooth()); });
  row["megavoxels_per_s"] =
      static_cast<double>(session.volume()->voxel_count()) / 1e6 / row["surface"].get<double>();
  row["triangles"] = session.remeshed()->triangles.size();
  return row;
}

/// The fastest run of each stage.
Result<nlohmann::json> fastest(const Timed& t, int runs) {
  nlohmann::json best;
  for (int run = 0; run < runs; ++run) {
    const Result<nlohmann::json> row = measure(t);
    if (!row) return row.error();
    for (const auto& [key, value] : row->items())
      if (!best.contains(key) || (key == "megavoxels_per_s" ? value > best[key] : value < best[key]))
        best[key] = value;
  }
  return best;
}

/// Thickness and gradation on a generated heart, the fastest of `runs`.
void time_sizing(int runs, Findings& findings) {
  const test::LargeHeart heart;
  const std::vector<float> target = heart.target_sizes();
  RunContext ctx;
  constexpr double kNever = std::numeric_limits<double>::infinity();
  double thickness = kNever, gradation = kNever;
  for (int run = 0; run < runs; ++run) {
    thickness = std::min(thickness, seconds_of([&] { (void)heart.wall(ctx).value(); }));
    std::vector<float> sizes = target;
    gradation = std::min(gradation, seconds_of([&] { heart.limit(sizes, ctx); }));
  }
  std::printf("\n| generated heart of 256 voxels | s | limit s |\n|---|---|---|\n");
  std::printf("| thickness | %.3f | %.1f |\n| gradation | %.3f | %.1f |\n", thickness, kThicknessLimit,
              gradation, kGradationLimit);
  std::vector<std::string> failures;
  if (!(thickness <= kThicknessLimit)) failures.push_back("thickness in " + std::to_string(thickness) + " s");
  if (!(gradation <= kGradationLimit)) failures.push_back("gradation in " + std::to_string(gradation) + " s");
  findings.add("sizing", {{"thickness", thickness}, {"gradation", gradation}}, failures);
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line{"Seconds of one thread up to the adapted surface. Exit code 1 when slower than promised."};
  int runs = 3;
  std::string only;
  line.app.add_option("--runs", runs, "the fastest of so many counts");
  line.app.add_option("--only", only, "cases whose name holds this");
  line.parse(argc, argv);

  Findings findings;
  std::printf(
      "edge %.1f mm, processor seconds, limits times %.1f\n\n| case | volume | surface | Mvoxel/s | smooth | "
      "sizing | "
      "remesh | of it label field | triangles | limit s |\n|---|---|---|---|---|---|---|---|---|---|\n",
      kEdgeMm, kSlower);
  for (const Timed& t : all_timed()) {
    if (std::find(line.methods.begin(), line.methods.end(), t.method) == line.methods.end()) continue;
    const std::string name = std::string(t.file) + (t.merge ? ", merged, " : ", conforming, ") + t.method;
    if (name.find(only) == std::string::npos) continue;
    const Result<nlohmann::json> row = fastest(t, runs);
    if (!row) {
      findings.add_error(name, row.error());
      continue;
    }
    const auto value = [&](const char* key) { return (*row)[key].get<double>(); };
    const double limit = t.limit_s * kSlower;
    std::printf("| %s | %.3f | %.3f | %.1f | %.3f | %.3f | %.3f | %.3f | %.0f | %.1f |\n", name.c_str(),
                value("volume"), value("surface"), value("megavoxels_per_s"), value("smooth"),
                value("sizing"), value("remesh"), value("label_field"), value("triangles"), limit);
    std::vector<std::string> failures;
    if (!(value("remesh") <= limit))
      failures.push_back("adapted surface in " + std::to_string(value("remesh")) + " s, expected " +
                         std::to_string(limit));
    if (!(value("megavoxels_per_s") >= kLeastMegavoxels))
      failures.push_back("extraction of " + std::to_string(value("megavoxels_per_s")) +
                         " Mvoxel/s, expected " + std::to_string(kLeastMegavoxels));
    findings.add(name, *row, failures);
  }
  if (std::string("sizing").find(only) != std::string::npos) time_sizing(runs, findings);
  return findings.finish(line.json_file);
}
