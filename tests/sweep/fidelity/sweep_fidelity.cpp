// The yardstick of a change to smoothing, to the adapted surface or to the tetrahedra: how true the finished
// mesh is to its voxels, and where the truth is known to that.
#include <filesystem>
#include <numbers>

#include "io/bytes/files.h"
#include "support/data.h"
#include "sweep/command_line.h"
#include "sweep/fidelity/compare_fidelity.h"
#include "sweep/fidelity/measure_fidelity.h"
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
  cases.push_back({"ct_torso_62labels_3mm.nii.gz", {}, false, {}, true});
  for (const char* file : {"skull.nrrd", "prostate_phantom.nrrd"}) cases.push_back({file, {}});
  return cases;
}

/// What the command line asks for.
struct Asked {
  std::string only, method;
  std::vector<std::string> fields;
  ReferenceFolders references;
  std::optional<std::string> against;
  nlohmann::json before;  ///< rows of that file, by name
};

/// Measures a case whose recipe is set, prints its row and judges it; `own` adds figures and failures to it.
template <class Own>
void sweep(const std::string& name, Status ready, const Asked& asked, Session& session, Findings& findings,
           Own own) {
  if (ready) ready = set_fields(asked.fields, session);
  Result<nlohmann::json> row = ready ? measure_fidelity(name, asked.references, session) : ready.error();
  if (!row) return findings.add_error(name, row.error());
  std::vector<std::string> failures;
  own(*row, failures);
  const auto before = asked.before.find(name);
  const bool is_compared = before != asked.before.end();
  print_fidelity(name, is_compared ? &*before : nullptr, *row);
  if (is_compared)
    for (const std::string& text : what_became_worse(*before, *row)) failures.push_back(text);
  else if (asked.against)
    failures.push_back("has no figures in " + *asked.against);
  findings.add(name, *row, failures);
}

std::vector<std::string> beyond(const std::string& what, double found, double limit) {
  if (found <= limit) return {};
  return {what + " " + std::to_string(found) + ", expected at most " + std::to_string(limit)};
}

void append(std::vector<std::string>& to, const std::vector<std::string>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

/// The first eight cases promise an angle and volumes; the others are for comparison.
void sweep_case(const TableCase& c, bool promised, const Asked& asked, Findings& findings) {
  const std::string name = name_of(c, asked.method), path = test::shared_data(c.file);
  Session session;
  const Status ready = path.empty() ? Error{ErrorCode::kBadInput, "sweep", kNotThere, {}}
                                    : open_case(c, path, asked.method, session);
  sweep(name, ready, asked, session, findings, [&](const nlohmann::json& row, auto& failures) {
    if (!promised) return;
    for (const auto& [label, percent] : row["volume_percent"].items()) {
      const double error = std::abs(static_cast<double>(percent));
      append(failures, beyond("volume error (%) of label " + label, error, kMostVolumePercent));
    }
    const double least = row["dihedral_deg"]["least"];
    if (!(least >= kLeastDihedral))
      failures.push_back("smallest dihedral " + std::to_string(least) + " degrees, expected at least " +
                         std::to_string(kLeastDihedral));
  });
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

void sweep_sphere(const Sphere& sphere, const Eigen::Vector3d& rotation_deg, const Asked& asked,
                  Findings& findings) {
  const std::string name = "sphere of " + std::to_string(static_cast<int>(sphere.radius_voxels)) +
                           " voxels, turned by " + std::to_string(static_cast<int>(rotation_deg.x())) +
                           " deg, " + asked.method;
  Session session;
  Result<Recipe> recipe = with_field(Recipe{}, "remesh.method", asked.method);
  if (!recipe) return findings.add_error(name, recipe.error());
  PhantomParams& phantom = recipe->source.phantom.emplace();
  phantom.kind = PhantomKind::kSphere;
  phantom.spacing_mm.setOnes();
  phantom.rotation_deg = rotation_deg;
  phantom.radius_mm = sphere.radius_voxels;
  recipe->sizing.edge_mm = 2;
  sweep(name, session.set_recipe(*recipe), asked, session, findings,
        [&](nlohmann::json& row, auto& failures) {
          const TruthFigures smooth =
              against_sphere(session.smooth()->points, session.smooth()->triangles, phantom.radius_mm);
          const TruthFigures mesh = against_sphere(*session.mesh(), phantom.radius_mm);
          row["truth"] = {
              {"smooth", {{"radial_voxels", smooth.radial_voxels}, {"normal_deg", smooth.normal_deg}}},
              {"mesh", {{"radial_voxels", mesh.radial_voxels}, {"normal_deg", mesh.normal_deg}}}};
          append(failures, beyond("radial rms (voxels)", mesh.radial_voxels, sphere.most_radial_voxels));
          append(failures,
                 beyond("rms error of the normals (degrees)", mesh.normal_deg, sphere.most_normal_deg));
        });
}

/// The rows of a JSON file of this program, by the names of their cases. Errors: kBadInput.
Result<nlohmann::json> rows_of(const std::string& path) {
  const Result<Bytes> bytes = read_file(path);
  if (!bytes) return bytes.error();
  const nlohmann::json file = nlohmann::json::parse(*bytes, nullptr, false);
  if (!file.is_object() || !file.contains("rows"))
    return Error{ErrorCode::kBadInput, "sweep", path + ": found no rows, expected what --json writes", {}};
  nlohmann::json rows = nlohmann::json::object();
  for (const nlohmann::json& row : file["rows"])
    if (row.contains("reference")) rows[row["case"].get<std::string>()] = row;
  return rows;
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line{"How true finished meshes are to voxels and to spheres. Exit code 1 beyond any limit."};
  Asked asked;
  line.app.add_option("--only", asked.only, "cases whose name holds this; `sphere`: the spheres alone");
  line.app.add_option("--set", asked.fields, "field=value of the recipe");
  line.app.add_option("--against", asked.against, "figures of an earlier tree, written by --json");
  CLI::Option* keep = line.app.add_option("--keep-references", asked.references.to,
                                          "write this tree's surfaces to this folder");
  line.app
      .add_option("--references", asked.references.from, "measure against the surfaces kept in this folder")
      ->excludes(keep);
  line.parse(argc, argv);
  if (asked.against) {
    Result<nlohmann::json> before = rows_of(*asked.against);
    if (!before) {
      std::fprintf(stderr, "%s\n", before.error().message.c_str());
      return 2;
    }
    asked.before = *std::move(before);
  }

  if (asked.references.to) std::filesystem::create_directories(*asked.references.to);

  Findings findings;
  std::printf(
      "Distances in voxels (smallest spacing) between the mesh's boundaries and the reference: the surface "
      "as extracted from the voxels, and smoothed.\n\n");
  print_fidelity_heading();
  for (const std::string& method : line.methods) {
    asked.method = method;
    std::size_t promised = 8;
    for (const TableCase& c : more_cases()) {
      const bool is_promised = promised > 0;
      promised -= is_promised ? 1 : 0;
      if (name_of(c, method).find(asked.only) != std::string::npos)
        sweep_case(c, is_promised, asked, findings);
    }
    if (std::string("sphere").find(asked.only) != std::string::npos)
      for (const Sphere& sphere : kSpheres)
        for (const Eigen::Vector3d& rotation_deg : kRotationsDeg)
          sweep_sphere(sphere, rotation_deg, asked, findings);
  }
  return findings.finish(line.json_file);
}
