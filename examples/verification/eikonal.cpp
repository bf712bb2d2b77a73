// Activation of the generated heart by the eikonal equation and by the monodomain model.
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "pipeline/session.h"
#include "verify.h"

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

/// Of the monodomain model's times, y, against those of the eikonal equation, x, at all points with both.
struct Comparison {
  std::size_t tets;
  double points, correlation, mean_later_ms, slope, mean_ms;
};

Comparison comparison(const Session& session, const Way& way) {
  const auto mesh = std::make_shared<const TetMesh>(*session.mesh());
  const std::vector<float>& wave = session.eikonal()->fields[0].values;
  const auto times = activations_ms(mesh, session.result<TissueResult>(Stage::kTissue)->tissue,
                                    session.recipe().physics->stimuli[0], params_of(way, 0.05));
  double n = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]) || !std::isfinite(wave[i])) continue;
    const double a = wave[i], b = times[i];
    n += 1, x += a, y += b, xx += a * a, yy += b * b, xy += a * b;
  }
  const double covariance = n * xy - x * y, variance = n * xx - x * x;
  return {mesh->tets.size(),     n,    covariance / std::sqrt(variance * (n * yy - y * y)), (y - x) / n,
          covariance / variance, x / n};
}

void run_eikonal(Session& session, double along, double across) {
  RunContext ctx;
  value_or_exit(session.set_recipe(value_or_exit(parse_recipe(heart_case(along, across)))));
  value_or_exit(session.run(Stage::kEikonal, ctx));
}

constexpr Way kHeartWays[] = {{"explicit", Integration::kExplicit, 0},
                              {"consistent 0.5", Integration::kSemiImplicit, 0.5}};

void print_row(double along, double across) {
  Session session;
  run_eikonal(session, along, across);
  for (const Way& way : kHeartWays) {
    const Comparison found = comparison(session, way);
    std::printf("  %.1f / %.1f  %-14s %7zu  %7.0f  %11.4f  %16.2f  %6.3f  %8.1f\n", along, across, way.name,
                found.tets, found.points, found.correlation, found.mean_later_ms, found.slope, found.mean_ms);
    std::fflush(stdout);
  }
}

}  // namespace

double heart_correlation(double along, double across) {
  Session session;
  run_eikonal(session, along, across);
  return comparison(session, kHeartWays[1]).correlation;
}

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
