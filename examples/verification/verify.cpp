#include "verify.h"

#include <nlohmann/json.hpp>

#include "geometry/topology/adjacency.h"
#include "support/test_surfaces.h"
#include "tetra/fill/fill_tets.h"

namespace voxtet::verify {

void print_check(const char* check, const std::string& what, double measured, const char* unit, double low,
                 double high, const std::string& expected, const char* source) {
  const nlohmann::json line{{"check", check},
                            {"case", what},
                            {"measured", measured},
                            {"unit", unit},
                            {"expected", expected},
                            {"source", source},
                            {"agrees", measured >= low && measured <= high}};
  std::printf("%s\n", line.dump().c_str());
  std::fflush(stdout);
}

const char* name_of(mechanics::Formulation formulation) {
  switch (formulation) {
    case mechanics::Formulation::kLinear: return "P1";
    case mechanics::Formulation::kAverageNodalPressure: return "P1 ANP";
    case mechanics::Formulation::kQuadratic: return "P2";
    case mechanics::Formulation::kStabilised: return "P1-P1";
  }
  return "";
}

std::string text(const char* format, double value) {
  char out[64];
  std::snprintf(out, sizeof out, format, value);
  return out;
}

std::shared_ptr<const TetMesh> box_of_tets(const std::array<int, 3>& squares, double square_mm) {
  const SurfaceMesh surface = test::cells(squares, square_mm, [](int, int, int) { return Label{1}; });
  RunContext ctx;
  return std::make_shared<const TetMesh>(value_or_exit(
      fill_tets(surface, test::uniform_sizing(1.15 * square_mm), {.backend = TetBackend::kTetgen}, ctx)));
}

double mean_edge_mm(const TetMesh& mesh) {
  double sum = 0;
  const auto edges = tet_edges(mesh.tets, mesh.points.size());
  for (const auto& [a, b] : edges) sum += (mesh.points[b] - mesh.points[a]).norm();
  return sum / static_cast<double>(edges.size());
}

Stimulus at_corner(const Eigen::Vector3d& size_mm) {
  Stimulus stimulus;
  stimulus.shape = RegionShape::kBox;
  stimulus.half_size_mm = size_mm;
  return stimulus;
}

MonodomainParams params_of(const Way& way, double step_ms) {
  MonodomainParams params;
  params.integration = way.integration;
  params.consistent_mass = way.consistent_mass;
  params.step_ms = step_ms;
  return params;
}

void step(Monodomain& heart) {
  while (!value_or_exit(heart.advance())) {
  }
}

std::vector<float> activations_ms(const std::shared_ptr<const TetMesh>& mesh, const Tissue& tissue,
                                  const Stimulus& stimulus, const MonodomainParams& params) {
  constexpr int kThreads = 2;
  Monodomain heart = value_or_exit(Monodomain::start(*mesh, tissue, {stimulus}, params, kThreads));
  while (!heart.done() && heart.log().activations().size() < heart.points().size()) step(heart);
  return heart.activation_fields()[0].values;
}

}  // namespace voxtet::verify
