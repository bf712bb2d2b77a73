// Activation of the generated heart by the eikonal equation and by the monodomain model.
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "bench/verify_physics/verify.h"
#include "pipeline/session.h"

namespace voxtet::verify {
namespace {

nlohmann::json heart_case(double along, double across) {
  nlohmann::json out = nlohmann::json::parse(R"({
    "source": {"phantom": {"kind": "biventricle"}},
    "labels": [1, 2],
    "sizing": {"edge_mm": 2.5},
    "physics": {
      "anatomy": {},
      "tissue": {"kinds": [{"labels": [1, 2]}]},
      "stimuli": [{"shape": "sphere", "centre_mm": [0, 0, -40], "radius_mm": 12}]
    }
  })");
  nlohmann::json& kind = out["physics"]["tissue"]["kinds"][0];
  kind["along_mm_per_ms"] = along;
  kind["across_mm_per_ms"] = across;
  if (along != across) out["physics"]["fibres"] = nlohmann::json::object();
  return out;
}

void print_row(double along, double across) {
  Session session;
  RunContext ctx;
  value_or_exit(session.set_recipe(value_or_exit(parse_recipe(heart_case(along, across)))));
  value_or_exit(session.run(Stage::kEikonal, ctx));
  const auto mesh = std::make_shared<const TetMesh>(*session.mesh());
  const std::vector<float>& wave = session.eikonal()->fields[0].values;
  const Stimulus& stimulus = session.recipe().physics->stimuli[0];
  for (const Way& way :
       {Way{"explicit", Integration::kExplicit, 0}, Way{"consistent 0.5", Integration::kSemiImplicit, 0.5}}) {
    const auto times = activations_ms(mesh, session.result<TissueResult>(Stage::kTissue)->tissue, stimulus,
                                      params_of(way, 0.05));
    double n = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (!std::isfinite(times[i]) || !std::isfinite(wave[i])) continue;
      const double a = wave[i], b = times[i];
      n += 1, x += a, y += b, xx += a * a, yy += b * b, xy += a * b;
    }
    const double covariance = n * xy - x * y, variance = n * xx - x * x;
    std::printf("  %.1f / %.1f  %-14s %7zu  %7.0f  %11.4f  %16.2f  %6.3f  %8.1f\n", along, across, way.name,
                mesh->tets.size(), n, covariance / std::sqrt(variance * (n * yy - y * y)), (y - x) / n,
                covariance / variance, x / n);
    std::fflush(stdout);
  }
}

}  // namespace

void print_eikonal(bool) {
  std::printf(
      "Eikonal against monodomain, generated heart, edge 2.5 mm, from the apex, step 0.05 ms; "
      "correlation expected: at least 0.99\n");
  std::printf("  speeds mm/ms %13s %8s  %7s  %11s  %16s  %6s  %8s\n", "", "tets", "points", "correlation",
              "mean later by ms", "slope", "mean ms");
  print_row(0.6, 0.3);
  print_row(0.5, 0.5);
}

}  // namespace voxtet::verify
