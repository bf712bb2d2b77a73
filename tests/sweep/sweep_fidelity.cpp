// The yardstick of a change to smoothing, to the adapted surface or to the tetrahedra: how true the finished
// mesh is to its voxels, and where the truth is known to that.
#include <ctime>
#include <numbers>

#include "geometry/topology/compare_topology.h"
#include "geometry/topology/label_topology.h"
#include "quality/measure_quality.h"
#include "quality/surface_distance.h"
#include "quality/tet_measure_table.h"
#include "support/data.h"
#include "sweep/command_line.h"
#include "sweep/findings.h"
#include "sweep/table_cases.h"

using namespace voxtet;
using namespace voxtet::sweep;

namespace {

constexpr double kLeastDihedral = 33, kMostVolumePercent = 0.2;

struct Sphere {
  double radius_voxels;
  double most_radial_voxels, most_normal_deg;
};
constexpr std::array kSpheres{Sphere{20, 0.050, 1.6}, Sphere{40, 0.042, 1.2}};
/// Image axes, none of which is an axis of symmetry of another one's voxels.
const std::array kRotationsDeg{Eigen::Vector3d(31, -17, 53), Eigen::Vector3d(-12, 40, 7)};

std::vector<TableCase> more_cases() {
  std::vector<TableCase> cases = table_cases();
  cases.pop_back();  // graded: the same voxels again
  for (const char* file : {"ct_torso_62labels_3mm.nii.gz", "skull.nrrd", "prostate_phantom.nrrd"})
    cases.push_back({file, {}});
  return cases;
}

struct FidelityFigures {
  double smooth_share = 0;    ///< smoothing's part of the processor time of all stages up to the mesh
  double seconds = 0;         ///< of all stages up to the mesh
  DistanceSummary to_voxels;  ///< from the mesh's label boundaries to the surface as extracted from voxels
  double least_dice = 1, mean_dice = 0, volume_percent = 0;  ///< of the labels
  double least_dihedral_deg = 0;
  std::size_t triangles = 0, differences = 0;  ///< entries of the ledgers that differ: pieces lost, handles
};

double least_dihedral(const TetMesh& mesh) {
  const std::vector<Field> measures = measure_tets(mesh, nullptr, 1);
  const std::vector<float>& smallest = find_field(measures, "min_dihedral_deg")->values;
  return *std::min_element(smallest.begin(), smallest.end());
}

Result<FidelityFigures> measure(Session& session) {
  FidelityFigures out;
  RunContext ctx;
  for (const Stage stage : {Stage::kSurface, Stage::kSmooth, Stage::kOptimise}) {
    const std::clock_t start = std::clock();
    if (const Status done = session.run(stage, ctx); !done) return done.error();
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    out.seconds += seconds;
    if (stage == Stage::kSmooth) out.smooth_share = seconds;
  }
  out.smooth_share /= out.seconds;
  const TetMesh& mesh = *session.mesh();
  const SurfaceMesh& voxels = *session.surface();
  const double voxel = session.volume()->smallest_spacing_mm();
  const Result<SurfaceDistances> distances =
      measure_distances({mesh.points, mesh.faces, mesh.face_sides},
                        {voxels.points, voxels.triangles, voxels.sides}, {voxel / 4, voxel / 20}, ctx);
  if (!distances) return distances.error();
  out.to_voxels = distances->forth;
  const Result<QualityReport> report =
      measure_quality(mesh,
                      {*session.volume(), *session.selected_volume(), *session.smooth(), *session.remeshed(),
                       *session.sizing()},
                      {}, ctx);
  if (!report) return report.error();
  for (const LabelFidelity& label : report->labels) {
    out.least_dice = std::min(out.least_dice, label.dice);
    out.mean_dice += label.dice / static_cast<double>(report->labels.size());
    out.volume_percent = std::max(out.volume_percent, std::abs(label.volume_error_percent));
  }
  out.least_dihedral_deg = least_dihedral(mesh);
  out.triangles = mesh.faces.size();
  out.differences =
      compare_topology(label_topology(voxels), label_topology({mesh.points, mesh.faces, mesh.face_sides}))
          .size();
  return out;
}

nlohmann::json figures_json(const FidelityFigures& f, double voxel) {
  return {{"smooth_share", f.smooth_share},
          {"seconds", f.seconds},
          {"mean_to_voxels", f.to_voxels.mean_mm / voxel},
          {"rms_to_voxels", f.to_voxels.rms_mm / voxel},
          {"max_to_voxels", f.to_voxels.max_mm / voxel},
          {"least_dice", f.least_dice},
          {"mean_dice", f.mean_dice},
          {"volume_percent", f.volume_percent},
          {"least_dihedral_deg", f.least_dihedral_deg},
          {"triangles", f.triangles},
          {"ledger_differences", f.differences}};
}

std::vector<std::string> beyond(const char* what, double found, double limit) {
  if (found <= limit) return {};
  return {std::string(what) + " " + std::to_string(found) + ", expected at most " + std::to_string(limit)};
}

void append(std::vector<std::string>& to, const std::vector<std::string>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

/// The first eight cases promise an angle and volumes; the others are for comparison.
void sweep_case(const TableCase& c, bool promised, const std::string& method,
                const std::vector<std::string>& fields, Findings& findings) {
  const std::string name = name_of(c, method), path = test::shared_data(c.file);
  Session session;
  Status ready = path.empty() ? Error{ErrorCode::kBadInput, "sweep", kNotThere, {}}
                              : open_case(c, path, method, session);
  if (ready) ready = set_fields(fields, session);
  const Result<FidelityFigures> figures = ready ? measure(session) : ready.error();
  if (!figures) return findings.add_error(name, figures.error());
  const FidelityFigures& f = *figures;
  const double voxel = session.volume()->smallest_spacing_mm();
  std::printf("| %s | %zu | %.4f/%.4f/%.2f | %.4f/%.4f | %.3f | %.1f | %zu | %.1f | %.1f |\n", name.c_str(),
              f.triangles, f.to_voxels.mean_mm / voxel, f.to_voxels.rms_mm / voxel,
              f.to_voxels.max_mm / voxel, f.least_dice, f.mean_dice, f.volume_percent, f.least_dihedral_deg,
              f.differences, 100 * f.smooth_share, f.seconds);
  std::fflush(stdout);
  std::vector<std::string> failures;
  if (promised) {
    append(failures, beyond("volume error (%)", f.volume_percent, kMostVolumePercent));
    if (f.least_dihedral_deg < kLeastDihedral)
      failures.push_back("smallest dihedral " + std::to_string(f.least_dihedral_deg) + " degrees, expected " +
                         std::to_string(kLeastDihedral));
  }
  findings.add(name, figures_json(f, voxel), failures);
}

struct TruthFigures {
  double radial_voxels = 0;  ///< rms over the points
  double normal_deg = 0;     ///< rms over the area, of facets against the radius through their centroid
};

TruthFigures against_sphere(const std::vector<Eigen::Vector3d>& points,
                            const std::vector<Triangle>& triangles, double radius_mm) {
  TruthFigures out;
  for (const Eigen::Vector3d& p : points) out.radial_voxels += std::pow(p.norm() - radius_mm, 2);
  out.radial_voxels = std::sqrt(out.radial_voxels / static_cast<double>(points.size()));
  double area = 0;
  for (const auto& [a, b, c] : triangles) {
    const Eigen::Vector3d cross = (points[b] - points[a]).cross(points[c] - points[a]);
    const Eigen::Vector3d centroid = points[a] + points[b] + points[c];
    const double angle = std::atan2(cross.cross(centroid).norm(), cross.dot(centroid));
    area += cross.norm();
    out.normal_deg += cross.norm() * angle * angle;
  }
  out.normal_deg = std::sqrt(out.normal_deg / area) * 180 / std::numbers::pi;
  return out;
}

/// The points of a mesh's faces, so that those inside do not count.
TruthFigures against_sphere(const TetMesh& mesh, double radius_mm) {
  std::vector<std::uint8_t> used(mesh.points.size(), 0);
  for (const Triangle& face : mesh.faces)
    for (const std::uint32_t v : face) used[v] = 1;
  std::vector<Eigen::Vector3d> boundary;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (used[v]) boundary.push_back(mesh.points[v]);
  return {against_sphere(boundary, {}, radius_mm).radial_voxels,
          against_sphere(mesh.points, mesh.faces, radius_mm).normal_deg};
}

void sweep_sphere(const Sphere& sphere, const Eigen::Vector3d& rotation_deg, const std::string& method,
                  const std::vector<std::string>& fields, Findings& findings) {
  const std::string name = "sphere of " + std::to_string(static_cast<int>(sphere.radius_voxels)) +
                           " voxels, turned by " + std::to_string(static_cast<int>(rotation_deg.x())) +
                           " deg, " + method;
  Session session;
  Result<Recipe> recipe = with_field(Recipe{}, "remesh.method", method);
  if (!recipe) return findings.add_error(name, recipe.error());
  PhantomParams& phantom = recipe->source.phantom.emplace();
  phantom.kind = PhantomKind::kSphere;
  phantom.spacing_mm.setOnes();
  phantom.rotation_deg = rotation_deg;
  phantom.radius_mm = sphere.radius_voxels;
  recipe->sizing.edge_mm = 2;
  Status ready = session.set_recipe(*recipe);
  if (ready) ready = set_fields(fields, session);
  const Result<FidelityFigures> figures = ready ? measure(session) : ready.error();
  if (!figures) return findings.add_error(name, figures.error());
  const TruthFigures smooth =
      against_sphere(session.smooth()->points, session.smooth()->triangles, phantom.radius_mm);
  const TruthFigures mesh = against_sphere(*session.mesh(), phantom.radius_mm);
  std::printf("| %s | %.3f | %.2f | %.3f | %.2f | %.3f | %.1f |\n", name.c_str(), smooth.radial_voxels,
              smooth.normal_deg, mesh.radial_voxels, mesh.normal_deg, figures->volume_percent,
              100 * figures->smooth_share);
  std::fflush(stdout);
  nlohmann::json row = figures_json(*figures, 1);
  row["smooth"] = {{"radial_voxels", smooth.radial_voxels}, {"normal_deg", smooth.normal_deg}};
  row["mesh"] = {{"radial_voxels", mesh.radial_voxels}, {"normal_deg", mesh.normal_deg}};
  std::vector<std::string> failures;
  append(failures, beyond("radial rms (voxels)", mesh.radial_voxels, sphere.most_radial_voxels));
  append(failures, beyond("rms error of the normals (degrees)", mesh.normal_deg, sphere.most_normal_deg));
  findings.add(name, row, failures);
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line{"How true finished meshes are to voxels and to spheres. Exit code 1 beyond any limit."};
  std::string only;
  std::vector<std::string> fields;
  line.app.add_option("--only", only, "cases whose name holds this; `sphere`: the spheres alone");
  line.app.add_option("--set", fields, "field=value of the recipe");
  line.parse(argc, argv);

  Findings findings;
  std::printf(
      "Distances in voxels (smallest spacing), from the mesh's boundaries to the surface that was "
      "extracted.\n\n"
      "| case | facets | to voxels mean/rms/max | Dice least/mean | volume %% | smallest dihedral | ledger "
      "differences | smoothing %% | processor s |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& method : line.methods) {
    std::size_t promised = 8;
    for (const TableCase& c : more_cases()) {
      const bool is_promised = promised > 0;
      promised -= is_promised ? 1 : 0;
      if (name_of(c, method).find(only) != std::string::npos)
        sweep_case(c, is_promised, method, fields, findings);
    }
  }
  std::printf(
      "\n| sphere | smoothed: radial rms, voxels | normals, deg | mesh: radial rms | normals | volume %% | "
      "smoothing %% |\n|---|---|---|---|---|---|---|\n");
  if (only.empty() || std::string("sphere").find(only) != std::string::npos)
    for (const std::string& method : line.methods)
      for (const Sphere& sphere : kSpheres)
        for (const Eigen::Vector3d& rotation_deg : kRotationsDeg)
          sweep_sphere(sphere, rotation_deg, method, fields, findings);
  return findings.finish(line.json_file);
}
