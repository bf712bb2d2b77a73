// A ventricle inflated, in full, for tests/bench/peers/inflation_fenicsx.py, which solves the same with
// another code.
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>
#include <variant>

#include "support/land.h"
#include "verify.h"

namespace voxtet::verify {
namespace {

using mechanics::Formulation;

constexpr double kInflationPressure = 1, kInflationBulk = 100;  // kPa
constexpr double kHelix = EIGEN_PI / 3;  // of fibres inside; outside it is the negative of it
constexpr int kInflationSteps = 10;

struct InflationCase {
  const char* element;
  Formulation formulation;
  const char* name;  ///< of the material
  mechanics::Material material;
};

/// Of a material without fibres their numbers are 0.
mechanics::TransverselyIsotropic numbers_of(const mechanics::Material& material) {
  if (const auto* plain = std::get_if<mechanics::MooneyRivlin>(&material))
    return {plain->c1_kpa, plain->c2_kpa, 0, 0};
  return std::get<mechanics::TransverselyIsotropic>(material);
}

/// The coordinates of points, or of vectors, one after the other.
nlohmann::json coordinates_of(const std::vector<Eigen::Vector3d>& vectors) {
  nlohmann::json numbers = nlohmann::json::array();
  for (const Eigen::Vector3d& v : vectors) numbers.insert(numbers.end(), {v.x(), v.y(), v.z()});
  return numbers;
}

std::vector<Triangle> faces_of(const test::HeartBody& heart, HeartSurface surface) {
  std::vector<Triangle> faces;
  for (std::size_t i = 0; i < heart.mesh.faces.size(); ++i)
    if (heart.surfaces.faces[i] == surface) faces.push_back(heart.mesh.faces[i]);
  return faces;
}

/// Of each tetrahedron one direction, in its middle.
std::vector<Eigen::Vector3d> fibres_of(const test::HeartBody& heart, const test::Ellipsoid& shape) {
  std::vector<Eigen::Vector3d> fibres;
  for (std::size_t t = 0; t < heart.mesh.tets.size(); ++t) {
    const Eigen::Vector3d middle = heart.centroid(t);
    fibres.push_back(shape.fibre(middle, (1 - 2 * shape.depth(middle)) * kHelix));
  }
  return fibres;
}

void print_case(const InflationCase& wanted) {
  const test::Ellipsoid shape;
  const test::HeartBody heart = test::left_ventricle(2, 8, shape);
  const std::vector<Eigen::Vector3d> fibres = fibres_of(heart, shape);
  const std::vector<Triangle> inside = faces_of(heart, HeartSurface::kLvEndocardium);

  const std::clock_t begin = std::clock();
  const std::size_t samples = mechanics::Nodes(heart.mesh, wanted.formulation).samples_per_tet();
  mechanics::Muscle muscle{{wanted.material}, {}, kInflationBulk, {}};
  for (const Eigen::Vector3d& fibre : fibres) {
    Eigen::Matrix3d frame;
    frame << fibre, fibre.unitOrthogonal(), fibre.cross(fibre.unitOrthogonal());
    muscle.frames.insert(muscle.frames.end(), samples, frame);
  }
  const auto body = value_or_exit(mechanics::Body::make(heart.mesh, wanted.formulation, std::move(muscle)));
  mechanics::NewtonParams params;
  params.steps = kInflationSteps;
  const auto held =
      test::held_where(body.nodes(), [&](const auto& p) { return p.z() > shape.base_z - 1e-5; });
  const auto found = value_or_exit(test::solve_all(
      body, {{{mechanics::Surface(body.nodes(), inside), kInflationPressure}}, {}, {}}, held, params));
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;

  std::vector<Eigen::Vector3d> u;
  for (Eigen::Index i = 0; i < found.u.size(); i += 3) u.emplace_back(found.u.segment<3>(i));
  const mechanics::TransverselyIsotropic numbers = numbers_of(wanted.material);
  const nlohmann::json line{{"element", wanted.element},
                            {"material", wanted.name},
                            {"c1_kpa", numbers.c1_kpa},
                            {"c2_kpa", numbers.c2_kpa},
                            {"a_f_kpa", numbers.a_f_kpa},
                            {"b_f", numbers.b_f},
                            {"bulk_kpa", kInflationBulk},
                            {"pressure_kpa", kInflationPressure},
                            {"steps", kInflationSteps},
                            {"held", faces_of(heart, HeartSurface::kBase)},
                            {"points_mm", coordinates_of(heart.mesh.points)},
                            {"tets", heart.mesh.tets},
                            {"loaded", inside},
                            {"fibres", coordinates_of(fibres)},
                            {"nodes_mm", coordinates_of(body.nodes().places())},
                            {"u_mm", coordinates_of(u)},
                            {"iterations", found.iterations},
                            {"factorisations", found.factorisations},
                            {"cpu_seconds", seconds}};
  std::printf("%s\n", line.dump().c_str());
  std::fflush(stdout);
}

}  // namespace

void print_inflation(bool) {
  const mechanics::TransverselyIsotropic muscle;
  const mechanics::MooneyRivlin isotropic{muscle.c1_kpa, muscle.c2_kpa};
  for (const auto& [element, formulation] :
       {std::pair{"P1", Formulation::kLinear}, std::pair{"P2", Formulation::kQuadratic}}) {
    print_case({element, formulation, "isotropic", isotropic});
    print_case({element, formulation, "fibres", muscle});
  }
}

}  // namespace voxtet::verify
