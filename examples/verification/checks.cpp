// Short checks of the physics against closed forms and other codes, a line of JSON each: for tests, and for
// the page that runs them in a reader's browser (examples/verification).
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

#include "physics/eikonal/solve_eikonal.h"
#include "physics/monodomain/cell.h"
#include "physics/ventricles/ventricular_fibres.h"
#include "support/bricks.h"
#include "support/ellipsoid.h"
#include "support/labelled_mesh.h"
#include "support/uniform_tissue.h"
#include "verify.h"

namespace voxtet::verify {
namespace {

constexpr Way kLumped{"lumped mass", Integration::kSemiImplicit, 0};
constexpr Way kHalf{"half-lumped mass", Integration::kSemiImplicit, 0.5};
constexpr Way kExplicitly{"explicit", Integration::kExplicit, 0};

void check_plane_wave() {
  const char* const closed =
      "closed form of the front: c = sqrt(D w / (2 tau_in)) (v+ - 2 v-) = 1.0866 sqrt(D)";
  const auto row = std::make_shared<const TetMesh>(test::bricks_cut_all_ways({18, 0.1, 0.1}, {180, 1, 1}));
  for (const Way& way : {kExplicitly, kHalf}) {
    const double speed =
        speed_along(row, params_of(way, way.integration == Integration::kExplicit ? 0.005 : 0.01));
    print_check("Plane wave", std::string("elements of 0.1 mm, ") + way.name, speed, "mm/ms", 0.495, 0.505,
                "0.5 mm/ms, within 1 %", closed);
  }
  const double fine = fine_speed(params_of(kLumped, 0.05));
  for (const auto& [edge, lumped] : {std::pair{1.10, -4.5}, std::pair{1.59, -6.6}}) {
    const auto bar = bar_of_tets(edge);
    const std::string mesh = text("unstructured, edges of %.2f mm, ", mean_edge_mm(*bar));
    const auto error = [&](const Way& way) {
      return 100 * (speed_along(bar, params_of(way, 0.05)) / fine - 1);
    };
    print_check("Plane wave", mesh + kLumped.name, error(kLumped), "%", lumped - 0.5, lumped + 0.5,
                text("%.1f %% within 0.5: slow, as every code with lumped mass", lumped),
                "another code of finite elements, bars of 60 mm");
    MonodomainParams corrected = params_of(kLumped, 0.05);
    corrected.correct_speed = true;
    print_check("Plane wave", mesh + "lumped mass, speed corrected for the mesh",
                100 * (speed_along(bar, corrected) / fine - 1), "%", -1, 1, "within 1 %",
                "its table was measured on such bars");
    print_check("Plane wave", mesh + kHalf.name, error(kHalf), "%", -1, 1, "within 1 %",
                "Pathmanathan et al. (2012): half of the mass lumped");
  }
}

void check_slab() {
  const Eigen::Vector3d size(20, 7, 3);
  const double unit = plane_wave_speed({});
  const auto corners = [&](const TetMesh& mesh, const Way& way, double step_ms) {
    const Tissue tissue = test::uniform_tissue(mesh, unit * std::sqrt(0.0953), unit * std::sqrt(0.012576),
                                               Eigen::Vector3d::UnitX());
    const auto times = activations_ms(std::make_shared<const TetMesh>(mesh), tissue,
                                      at_corner({1.5, 1.5, 1.5}), params_of(way, step_ms));
    std::vector<double> found;
    for (const Eigen::Vector3d& corner : {Eigen::Vector3d(20, 0, 0), Eigen::Vector3d(0, 7, 0), size})
      found.push_back(times[test::nearest_point(mesh, corner)]);
    return found;
  };
  const char* const names[] = {"end of the fibres' axis", "end of the axis across", "far corner"};
  const auto stencil = corners(test::bricks_cut_all_ways(size, {40, 14, 6}), kExplicitly, 0.01);
  const double differences[] = {58.32, 54.91, 82.47};
  for (std::size_t c = 0; c < 3; ++c)
    print_check("Slab of Niederer et al. (2011)",
                std::string(names[c]) + ", 0.5 mm, finite differences' stencil", stencil[c], "ms",
                differences[c] - 0.02, differences[c] + 0.02, text("%.2f ms, within 0.02", differences[c]),
                "a program of finite differences, with the same cell");
  const auto kuhn = corners(test::bricks(size, {40, 14, 6}), kHalf, 0.05);
  const double fenicsx[] = {55.6674, 48.4879, 73.5727};
  for (std::size_t c = 0; c < 3; ++c)
    print_check("Slab of Niederer et al. (2011)", std::string(names[c]) + ", 0.5 mm, half-lumped mass",
                kuhn[c], "ms", fenicsx[c] - 0.01, fenicsx[c] + 0.01, text("%.2f ms, within 0.01", fenicsx[c]),
                "FEniCSx 0.5.2 on the same mesh");
}

/// Mean error, ms, of a wave from a ball of 2 mm in the middle of a cube of 10 mm, fibres askew.
double ball_error_ms(std::uint32_t n) {
  const TetMesh mesh = test::kuhn_cube(n);
  const Eigen::Vector3d fibre = Eigen::Vector3d(3, -2, 1).normalized(), middle(-5, 20, 3);
  const Eigen::Matrix3d on = fibre * fibre.transpose(),
                        slowness = (0.25 * on + 0.04 * (Eigen::Matrix3d::Identity() - on)).inverse();
  const auto exact = [&](const Eigen::Vector3d& p) {
    return std::sqrt((p - middle).dot(slowness * (p - middle)));
  };
  std::vector<EikonalSource> sources;
  for (std::uint32_t i = 0; i < mesh.points.size(); ++i)
    if ((mesh.points[i] - middle).norm() <= 2) sources.push_back({i, exact(mesh.points[i])});
  RunContext ctx;
  const auto times =
      value_or_exit(solve_eikonal(mesh, test::uniform_tissue(mesh, 0.5, 0.2, fibre), sources, ctx));
  double worst = 0;
  for (std::size_t i = 0; i < times.size(); ++i)
    worst = std::max(worst, std::abs(times[i] - exact(mesh.points[i])));
  return worst;
}

void check_eikonal() {
  double before = ball_error_ms(6);
  for (const std::uint32_t n : {12U, 24U, 48U}) {
    const double error = ball_error_ms(n);
    print_check("Activation map (eikonal)", "greatest error, edges halved to " + text("%.2f mm", 10.0 / n),
                before / error, "times smaller", 1.8, 2.2, "2: first order",
                "closed form: a wave from a ball, five to two along and across the fibres");
    before = error;
  }
  print_check("Activation map (eikonal)", "generated heart, correlation with the monodomain model",
              heart_correlation(0.6, 0.3), "", 0.99, 1, "at least 0.99",
              "the two models have to agree where nothing blocks the wave");
}

void check_fibres() {
  constexpr double kDegree = EIGEN_PI / 180;
  const test::Ellipsoid ellipsoid;
  const test::HeartBody body = test::left_ventricle(4, 24);
  const auto potentials = value_or_exit(ventricular_potentials(body.mesh, body.surfaces, {}));
  const Fibres fibres = value_or_exit(tet_fibres(body.mesh, body.surfaces, potentials, {}, {}));
  std::vector<double> angles;
  double skew = 0, sum = 0;
  for (std::size_t t = 0; t < body.mesh.tets.size(); ++t) {
    const Eigen::Vector3d at = body.centroid(t), f = fibres.fibre[t];
    const Eigen::Vector3d exact = ellipsoid.fibre(at, (60 - 120 * ellipsoid.depth(at)) * kDegree);
    angles.push_back(std::atan2(exact.cross(f).norm(), std::abs(exact.dot(f))) / kDegree);
    sum += angles.back();
    skew = std::max({skew, std::abs(f.norm() - 1), std::abs(f.dot(fibres.sheet[t]))});
  }
  std::sort(angles.begin(), angles.end());
  const char* const closed =
      "closed form in an ellipsoid: f = sin(alpha) e_u + cos(alpha) e_v, alpha from 60 to -60";
  print_check("Fibres", "ellipsoid, 4 layers, mean error", sum / static_cast<double>(angles.size()),
              "degrees", 0, 3, "below 3", closed);
  print_check("Fibres", "95 % of all tetrahedra are within", angles[angles.size() * 95 / 100], "degrees", 0,
              8, "below 8", closed);
  print_check("Fibres", "greatest of ||f| - 1| and |f . s|", skew, "", 0, 1e-12, "below 1e-12",
              "fibres and sheets are unit vectors at right angles");
}

}  // namespace

void print_checks() {
  check_fibres();
  check_eikonal();
  check_slab();
  check_plane_wave();
  print_circulation(false);
}

}  // namespace voxtet::verify
