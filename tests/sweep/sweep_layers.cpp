// Walls of many shapes, thin and thick, cut into exact layers: over how much of their area there are so many.
#include <chrono>
#include <functional>
#include <numeric>

#include "geometry/topology/compare_topology.h"
#include "io/volume/read_volume.h"
#include "phantom/make_phantom.h"
#include "support/data.h"
#include "support/wall_bodies.h"
#include "sweep/command_line.h"
#include "sweep/findings.h"
#include "sweep/load_labels.h"

using namespace voxtet;
using namespace voxtet::sweep;

namespace {

constexpr double kLeastExact = 0.97, kLeastDihedralDeg = 18;

/// Where the volume comes from: a body, a generated heart or a file.
struct WallCase {
  std::string name;
  std::function<Result<LabelVolume>()> volume;
  std::vector<Label> wall{1}, inner{2};
};

/// What lies below the plane z = base_mm, across which the wall ends in a rim.
test::Body opened(test::Body body, double base_mm) {
  const auto whole = body.label_at;
  body.label_at = [=](const Eigen::Vector3d& p) -> Label { return p.z() < base_mm ? whole(p) : kBackground; };
  return body;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

WallCase body_case(const std::string& name, test::Body body, const Eigen::Vector3d& spacing_mm,
                   const Eigen::Vector3d& rotation_deg) {
  body.reach_mm += 2 * spacing_mm.maxCoeff();  // off the image's border
  return {name, [=]() -> Result<LabelVolume> { return test::sample(body, spacing_mm, rotation_deg); }};
}

/// Closed and open, spherical and ellipsoidal shells around a cavity of that half width.
void add_shells(double cavity_mm, double wall_mm, const Eigen::Vector3d& spacing_mm,
                const std::string& voxels, std::vector<WallCase>& cases) {
  const Eigen::Vector3d turned(10, 20, 30);
  const std::string size = " " + number(cavity_mm) + "+" + number(wall_mm) + " mm, " + voxels + " mm voxels";
  const test::Body sphere = test::shell(cavity_mm, cavity_mm + wall_mm);
  const test::Body ellipsoid = test::ellipsoidal_shell(1.2 * cavity_mm, cavity_mm, cavity_mm + wall_mm);
  cases.push_back(body_case("sphere" + size, sphere, spacing_mm, turned));
  cases.push_back(body_case("half sphere" + size, opened(sphere, 0), spacing_mm, {0, 0, 0}));
  cases.push_back(body_case("ellipsoid" + size, ellipsoid, spacing_mm, turned));
  cases.push_back(
      body_case("half ellipsoid" + size, opened(ellipsoid, 0.3 * cavity_mm), spacing_mm, {0, 0, 0}));
}

WallCase heart_case(double scale, double voxel_mm) {
  PhantomParams heart;
  heart.spacing_mm.setConstant(voxel_mm);
  heart.scale = scale;
  return {"generated heart times " + number(scale) + ", " + number(voxel_mm) + " mm voxels",
          [heart] { return make_phantom(heart); },
          {1, 2},
          {3, 4}};
}

WallCase file_case(const std::string& file, const std::vector<Label>& wall) {
  return {file,
          [file]() -> Result<LabelVolume> {
            const std::string path = test::shared_data(file);
            if (path.empty()) return Error{ErrorCode::kBadInput, "sweep", kNotThere, {}};
            return read_volume_file(path);
          },
          wall,
          {3, 4}};
}

std::vector<WallCase> wall_cases() {
  std::vector<WallCase> cases;
  for (const double wall_mm : {8.0, 16.0, 24.0}) add_shells(20, wall_mm, {2, 2, 2}, "2", cases);
  add_shells(30, 24, {1.5, 1.5, 1.5}, "1.5", cases);
  add_shells(14, 20, {1, 1, 1}, "1", cases);
  add_shells(20, 16, {1.4, 1.4, 4}, "1.4 x 1.4 x 4", cases);
  cases.push_back(heart_case(1, 1.5));
  cases.push_back(heart_case(1.5, 2.25));
  cases.push_back(heart_case(1.5, 1.5));
  cases.push_back(file_case("biv_mean_2mm_float32.nii.gz", {1, 2}));
  cases.push_back(file_case("biv_mean_1mm.nii.gz", {1, 2}));
  cases.push_back(file_case("biv_ed_scar_1mm.nii.gz", {1, 2, 5, 6}));
  cases.push_back(file_case("biv_es_oblique_sax.nii.gz", {1, 2}));
  return cases;
}

Status open_case(const WallCase& c, std::uint32_t layers, const std::vector<std::string>& fields,
                 Session& session) {
  const Result<LabelVolume> volume = c.volume();
  if (!volume) return volume.error();
  if (Status loaded = load_labels(*volume, session); !loaded) return loaded;
  Recipe recipe = session.recipe();
  recipe.labels = c.wall;
  if (c.wall.size() > 1) recipe.merge = {c.wall};
  recipe.sizing.edge_mm = 10;
  recipe.sizing.thickness.resize(1);
  recipe.sizing.thickness[0].wall = c.wall;
  recipe.sizing.thickness[0].inner = c.inner;
  recipe.sizing.thickness[0].layers = layers;
  recipe.sizing.thickness[0].layering = Layering::kExact;
  if (Status set = session.set_recipe(recipe); !set) return set;
  return set_fields(fields, session);
}

double whole(const LayerShares& shares) {
  return std::accumulate(shares.area_mm2.begin(), shares.area_mm2.end(), 0.0);
}

void sweep_case(const WallCase& c, std::uint32_t layers, const std::vector<std::string>& fields, bool places,
                Findings& findings) {
  const std::string name = c.name + ", " + std::to_string(layers) + " layers";
  Session session;
  RunContext ctx;
  const auto start = std::chrono::steady_clock::now();
  Status done = open_case(c, layers, fields, session);
  if (done) done = session.run(Stage::kQuality, ctx);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!done) {
    std::printf("| %s | %u | %s |\n", c.name.c_str(), layers, done.error().message.c_str());
    return findings.add_error(name, done.error());
  }
  const QualityReport& quality = *session.quality();
  const LayerCount& found = quality.layers.at(0);
  const MetricSummary& dihedral = quality.metrics.at(0);
  std::vector<std::string> failures;
  const auto expect = [&](const char* what, double value, double least) {
    if (!(value >= least)) failures.push_back(what + (" " + number(value)) + ", expected " + number(least));
  };
  // Where the wall is as wide as it is thick, all of it may lie near the rim: then there is nothing to judge.
  const double judged_mm2 = whole(found.by_edges);
  if (judged_mm2 > 0) {
    expect("exactly so many, by edges,", found.by_edges.exact, kLeastExact);
    if (whole(found.by_lines) > 0) expect("exactly so many, along lines,", found.by_lines.exact, kLeastExact);
  }
  expect("smallest dihedral angle", dihedral.min, kLeastDihedralDeg);
  for (const TopologyDifference& difference : quality.topology.differences)
    failures.push_back(in_words(difference));
  const double voxel_mm = session.volume()->smallest_spacing_mm();
  const double volume_error = quality.labels.at(0).volume_error_percent;
  const double far_voxels =
      std::max(quality.mesh_to_surface.max_mm, quality.surface_to_mesh.max_mm) / voxel_mm;
  std::printf("| %s | %u | %.1f | %.1f | %.1f | %.0f | %.1f / %.1f | %zu | %+.2f | %.2f | %.1f | %s |\n",
              c.name.c_str(), layers, 100 * found.by_edges.exact, 100 * found.by_edges.at_least,
              100 * found.by_lines.exact, judged_mm2 / 100, dihedral.min, dihedral.p1,
              session.mesh()->tets.size(), volume_error, far_voxels, seconds, failures.empty() ? "" : "x");
  if (places)
    for (const LayerPlace& place : found.places)
      std::printf("  %u to %u on %.0f mm2 around (%.0f, %.0f, %.0f)\n", place.fewest, place.most,
                  place.area_mm2, place.centre_mm.x(), place.centre_mm.y(), place.centre_mm.z());
  if (places)
    for (const std::string& warning : session.warnings()) std::printf("  warning: %s\n", warning.c_str());
  std::fflush(stdout);
  findings.add(name,
               {{"layers", layers},
                {"by_edges", {found.by_edges.exact, found.by_edges.at_least}},
                {"by_lines", {found.by_lines.exact, found.by_lines.at_least}},
                {"judged_mm2", judged_mm2},
                {"dihedral_deg", {dihedral.min, dihedral.p1}},
                {"tets", session.mesh()->tets.size()},
                {"volume_error_percent", volume_error},
                {"farthest_voxels", far_voxels},
                {"seconds", seconds}},
               failures);
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line{"Exact layers in shells and hearts. Exit code 1 where they are not as promised."};
  std::string only;
  std::vector<std::string> fields;
  std::vector<std::uint32_t> layers{1, 2, 3, 4};
  bool places = false;
  line.app.add_option("--only", only, "cases whose name holds this");
  line.app.add_option("--layers", layers, "as 1,2,3")->delimiter(',')->capture_default_str();
  line.app.add_option("--set", fields, "field=value of the recipe");
  line.app.add_flag("--places", places, "also where there are others, and warnings");
  line.parse(argc, argv);

  Findings findings;
  std::printf(
      "| wall | layers | exactly so many, by edges, %% | no fewer, %% | exactly, along lines, %% | judged "
      "cm2 | "
      "dihedral angles, smallest / 1 %% | tetrahedra | volume, %% | farthest, voxels | seconds | |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const WallCase& c : wall_cases())
    if (c.name.find(only) != std::string::npos)
      for (const std::uint32_t n : layers) sweep_case(c, n, fields, places, findings);
  return findings.finish(line.json_file);
}
