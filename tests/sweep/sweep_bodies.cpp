// Bodies with a known boundary: how far the smoothed and the adapted surface are from the truth.
#include "geometry/elements/surface_measures.h"
#include "phantom/make_phantom.h"
#include "sweep/command_line.h"
#include "sweep/findings.h"
#include "sweep/surface_figures.h"
#include "volume/select_labels.h"

using namespace voxtet;
using namespace voxtet::sweep;

namespace {

/// Image axes. None is a body's own: their faces would run through voxel centres in bulk, and the voxels' own
/// volume would be off by per cents.
const std::array kRotationsDeg{Eigen::Vector3d(31, -17, 53), Eigen::Vector3d(-12, 40, 7)};

/// Bounds in voxels and per cent: the surface distances and volumes of a smoothed label surface. A box's
/// edges are rounded by what a voxel surface is off at most.
constexpr double kMeanToTruth = 0.1, kMaxToTruth = 0.5, kMaxAtEdges = 0.87;
constexpr double kVolumeOfVoxels = 0.5, kVolumeOfTruth = 0.5, kLeastCalming = 10;

struct TestBody {
  const char* name;
  PhantomKind kind;
  double radius_mm, inner_radius_mm;
};
constexpr std::array kBodies{TestBody{"sphere", PhantomKind::kSphere, 20, 0.1},
                             TestBody{"shell", PhantomKind::kShell, 20, 12},
                             TestBody{"torus", PhantomKind::kTorus, 20, 8},
                             TestBody{"nested boxes", PhantomKind::kNestedBoxes, 20, 1}};

double to_box(const Eigen::Vector3d& p, double half) {
  const Eigen::Vector3d beyond = p.cwiseAbs() - Eigen::Vector3d::Constant(half);
  return std::abs(beyond.cwiseMax(0).norm() + std::min(beyond.maxCoeff(), 0.0));
}

/// Distance (mm) to the nearest boundary of the body.
double to_truth(const TestBody& body, const Eigen::Vector3d& p) {
  switch (body.kind) {
    case PhantomKind::kSphere: return std::abs(p.norm() - body.radius_mm);
    case PhantomKind::kShell:
      return std::min(std::abs(p.norm() - body.radius_mm), std::abs(p.norm() - body.inner_radius_mm));
    case PhantomKind::kTorus: {
      const double ring = p.head<2>().norm() - body.radius_mm;
      return std::abs(std::sqrt(ring * ring + p.z() * p.z()) - body.inner_radius_mm);
    }
    default:
      return std::min(
          {to_box(p, body.radius_mm), to_box(p, body.radius_mm * 2 / 3), to_box(p, body.radius_mm / 3)});
  }
}

struct TruthFigures {
  double mean = 0, max = 0, volume_of_truth = 0, volume_of_voxels = 0;  ///< mm; worst label, per cent
};

/// At the corners and the centroids of the triangles.
TruthFigures against_truth(const SurfaceMesh& surface, const TestBody& body, const Session& session) {
  TruthFigures out;
  std::vector<Eigen::Vector3d> samples = surface.points;
  for (const auto& [a, b, c] : surface.triangles)
    samples.push_back((surface.points[a] + surface.points[b] + surface.points[c]) / 3);
  for (const Eigen::Vector3d& p : samples) {
    const double distance = to_truth(body, p);
    out.mean += distance / static_cast<double>(samples.size());
    out.max = std::max(out.max, distance);
  }
  for (const auto& [label, voxels] : count_labels(*session.volume())) {
    const double enclosed = enclosed_volume_mm3(surface, label);
    const auto percent = [&](double wanted) { return 100 * std::abs(enclosed / wanted - 1); };
    out.volume_of_voxels =
        std::max(out.volume_of_voxels, percent(static_cast<double>(voxels) * session.volume()->voxel_mm3()));
    out.volume_of_truth =
        std::max(out.volume_of_truth, percent(phantom_volume_mm3(*session.recipe().source.phantom, label)));
  }
  return out;
}

std::vector<std::string> judge(const TruthFigures& f, const TestBody& body, const std::string& stage) {
  std::vector<std::string> failures;
  const auto expect = [&](const char* what, double found, double limit) {
    if (!(found <= limit))
      failures.push_back(stage + ": " + what + " " + std::to_string(found) + ", expected " +
                         std::to_string(limit));
  };
  expect("mean distance to the truth (voxel)", f.mean, kMeanToTruth);
  expect("distance to the truth (voxel)", f.max,
         body.kind == PhantomKind::kNestedBoxes ? kMaxAtEdges : kMaxToTruth);
  expect("volume against voxels (%)", f.volume_of_voxels, kVolumeOfVoxels);
  expect("volume against the truth (%)", f.volume_of_truth, kVolumeOfTruth);
  return failures;
}

Status run_body(const TestBody& body, const Eigen::Vector3d& rotation_deg, const std::string& method,
                Session& session) {
  Result<Recipe> recipe = with_field(Recipe{}, "remesh.method", method);
  if (!recipe) return recipe.error();
  PhantomParams& phantom = recipe->source.phantom.emplace();
  phantom.kind = body.kind;
  phantom.spacing_mm.setOnes();
  phantom.rotation_deg = rotation_deg;
  phantom.radius_mm = body.radius_mm;
  phantom.inner_radius_mm = body.inner_radius_mm;
  recipe->sizing.edge_mm = 2;
  if (Status set = session.set_recipe(*recipe); !set) return set;
  RunContext ctx;
  if (Status done = session.run(Stage::kSmooth, ctx); !done) return done;
  return session.run(Stage::kRemesh, ctx);
}

void sweep_body(const TestBody& body, const Eigen::Vector3d& rotation_deg, const std::string& method,
                Findings& findings) {
  const std::string name = std::string(body.name) + " turned by " +
                           std::to_string(static_cast<int>(rotation_deg.x())) + " deg, " + method;
  Session session;
  if (Status done = run_body(body, rotation_deg, method, session); !done)
    return findings.add_error(name, done.error());
  const SurfaceFigures figures = measure_surface(session);
  std::vector<std::string> failures = check_intersections_and_topology(figures);
  for (std::string& text : check_distances(figures, limits_of(method))) failures.push_back(std::move(text));
  nlohmann::json row = figures_json(figures);
  for (const auto& [stage, surface] :
       {std::pair{"smoothed", session.smooth()}, {"adapted", session.remeshed()}}) {
    const TruthFigures truth = against_truth(*surface, body, session);
    for (std::string& text : judge(truth, body, stage)) failures.push_back(std::move(text));
    row[stage] = {{"mean", truth.mean},
                  {"max", truth.max},
                  {"volume_of_truth_percent", truth.volume_of_truth},
                  {"volume_of_voxels_percent", truth.volume_of_voxels}};
  }
  const double calming = staircase_energy_mm(*session.surface()) / staircase_energy_mm(*session.smooth());
  if (!(calming >= kLeastCalming))
    failures.push_back("staircase energy " + std::to_string(calming) + " times less, expected 10");
  row["staircase_energy_ratio"] = calming;
  std::printf("| %s | %.3f/%.2f | %.2f | %.2f | %.3f/%.2f | %.2f | %.2f | %.1f | %zu |\n", name.c_str(),
              row["smoothed"]["mean"].get<double>(), row["smoothed"]["max"].get<double>(),
              row["smoothed"]["volume_of_truth_percent"].get<double>(),
              row["smoothed"]["volume_of_voxels_percent"].get<double>(), row["adapted"]["mean"].get<double>(),
              row["adapted"]["max"].get<double>(), row["adapted"]["volume_of_truth_percent"].get<double>(),
              row["adapted"]["volume_of_voxels_percent"].get<double>(), calming, failures.size());
  findings.add(name, row, failures);
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line{"Sphere, shell, torus and nested boxes against the truth. Exit code 1 beyond any limit."};
  line.parse(argc, argv);

  Findings findings;
  std::printf(
      "| body | smoothed: to truth mean/max | volume %% of truth | of voxels | adapted: to truth mean/max | "
      "volume %% of truth | of voxels | staircase energy ratio | failures "
      "|\n|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& method : line.methods)
    for (const TestBody& body : kBodies)
      for (const Eigen::Vector3d& rotation_deg : kRotationsDeg)
        sweep_body(body, rotation_deg, method, findings);
  return findings.finish(line.json_file);
}
