#include "pipeline/forecast.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "sizing/edge_lengths.h"

namespace voxtet {
namespace {

constexpr double kLeastFactor = 1.0 / 64, kMostFactor = 64;
/// Forecasts of memory are right within a quarter: what takes so many times what there is will not fit, or
/// will.
constexpr double kHopeless = 1.5, kSafe = 0.75;

/// What is known of a case before it is meshed.
struct Load {
  double voxels, label_triangles, junctions;  ///< millions; junctions: edges of the label surface
  double flaws;                               ///< of the labels (volume/clean)
  RemeshMethod method;
  double peak_mb;  ///< of the stages that have run
};

/// A linear model of memory (MB) or time (s), by millions of voxels, triangles of the label surface, and
/// tets that fill the surface.
struct Cost {
  double constant, voxels, label_triangles, tets;
  double of(const Load& load, const MeshForecast& mesh) const {
    return constant + voxels * load.voxels + label_triangles * load.label_triangles +
           tets * 1e-6 * mesh.filled_tets;
  }
};

// Measured natively, one thread, on hearts, aorta, ct_heart, torso, skull, atlases of 100 to 366 labels and
// generated bodies, of up to 8 million tets (tests/sweep/README.md). By RemeshMethod.
constexpr std::array<Cost, 2> kSurfaceMb{{{12, 28, 350, 30}, {11, 19, 460, 16}}};
constexpr Cost kOptimiseMb{11, 12, 280, 175}, kQualityMb{17, 11, 285, 230};
constexpr std::array<Cost, 2> kSeconds{{{0.05, 0.6, 0, 11.4}, {0.05, 0.4, 47, 11.4}}};
/// What method delaunay takes besides, s: per million triangles of the label surface, and per million edges
/// where three labels meet, times the target edge length in smallest spacings: the longer edges are, the more
/// contacts of labels they pass over, which rounds of repair then look for. And per flaw, around which labels
/// are too thin for the edges.
constexpr double kSecondsOfTriangles = 9.7, kSecondsOfJunctions = 205, kSecondsOfFlaw = 0.1;
#ifdef __EMSCRIPTEN__
constexpr double kSlower = 1.6;
#else
constexpr double kSlower = 1;
#endif

/// Extraction and smoothing of the label surface on the machine that the models are for, s per million
/// triangles that are extracted; and what a surface of few takes.
constexpr double kSecondsOfSurface = 2.9, kSecondsOfNone = 0.01;
/// The fastest and the slowest machine that one measurement is trusted to tell of.
constexpr double kFastest = 0.25, kSlowest = 16;
/// What a time may be, as parts of its forecast for this machine.
constexpr double kShortest = 0.7, kLongest = 1.6;

/// With what is beyond cuts.
const SurfaceMesh& surface_built_in(const Session& session, Stage stage) {
  return session.result<Built<SurfaceMesh>>(stage)->as_built();
}

/// How many times as long as in the models stages take here and now, by those that have just made the label
/// surface; 1 where they were not made.
double slowness(const Session& session) {
  const double measured = session.record(Stage::kSurface).seconds + session.record(Stage::kSmooth).seconds;
  if (!session.surface() || !session.smooth() || !(measured > 0)) return 1;
  const SurfaceMesh& extracted = surface_built_in(session, Stage::kSurface);
  const double millions = 1e-6 * static_cast<double>(extracted.triangles.size());
  return std::clamp(measured / (kSlower * (kSecondsOfNone + kSecondsOfSurface * millions)), kFastest,
                    kSlowest);
}

double peak_mb(const Load& load, const MeshForecast& mesh) {
  return std::max({load.peak_mb, kSurfaceMb[static_cast<std::size_t>(load.method)].of(load, mesh),
                   kOptimiseMb.of(load, mesh), kQualityMb.of(load, mesh)});
}

/// `edge_voxels`: the mean target edge length on the label surface, in units of the smallest spacing.
double seconds(const Load& load, const MeshForecast& mesh, double edge_voxels) {
  double refinement = 0;
  if (load.method == RemeshMethod::kDelaunay)
    refinement =
        (kSecondsOfTriangles * load.label_triangles + kSecondsOfJunctions * load.junctions) * edge_voxels +
        kSecondsOfFlaw * load.flaws;
  return kSlower * (kSeconds[static_cast<std::size_t>(load.method)].of(load, mesh) + refinement);
}

const PreparedVolume& prepared_of(const Session& session) {
  return session.result<VolumeResult>(Stage::kVolume)->prepared;
}

/// Edges at which three triangles meet, by Euler's formula; pieces and handles, few beside points, left out.
double junction_edges(const SurfaceMesh& surface) {
  return std::max(
      0.0, static_cast<double>(surface.triangles.size()) - 2 * static_cast<double>(surface.points.size()));
}

double mean_edge_mm(const SurfaceMesh& surface, const SizingField& sizing) {
  constexpr std::size_t kMostSamples = 10000;
  const std::size_t stride = surface.points.size() / kMostSamples + 1;
  double sum = 0, count = 0;
  for (std::size_t p = 0; p < surface.points.size(); p += stride, ++count)
    sum += sizing.at(surface.points[p]);
  return sum / count;
}

Load load_of(const Session& session) {
  const SurfaceMesh& surface = surface_built_in(session, Stage::kSmooth);
  std::size_t flaws = 0;
  for (const Flaw& flaw : prepared_of(session).flaws) flaws += flaw.count;
  Load load{1e-6 * static_cast<double>(session.volume()->voxel_count()),
            1e-6 * static_cast<double>(surface.triangles.size()),
            1e-6 * junction_edges(surface),
            static_cast<double>(flaws),
            session.recipe().remesh.method,
            0};
  for (const Stage stage : {Stage::kVolume, Stage::kSurface, Stage::kSmooth, Stage::kSizing})
    load.peak_mb = std::max(load.peak_mb, session.record(stage).peak_mb);
  return load;
}

/// Forecasts for many sizes of one case.
class CaseForecaster {
 public:
  explicit CaseForecaster(const Session& session)
      : session_(session),
        load_(load_of(session)),
        mesh_(*prepared_of(session).meshed, prepared_of(session).cuts, *session.smooth(),
              {session.recipe().remesh.max_distance_voxels, load_.method == RemeshMethod::kDelaunay}) {}

  Result<Forecast> forecast(const SizingField& sizing, const RunContext& ctx) const {
    const Result<MeshForecast> mesh = mesh_.forecast(sizing, ctx);
    if (!mesh) return mesh.error();
    const double edge_voxels =
        mean_edge_mm(*session_.smooth(), sizing) / session_.volume()->spacing_mm().minCoeff();
    return Forecast{*mesh, peak_mb(load_, *mesh), seconds(load_, *mesh, edge_voxels)};
  }

 private:
  const Session& session_;
  Load load_;
  MeshForecaster mesh_;
};

SizingParams multiplied(SizingParams sizing, double factor) {
  for_each_edge_length(sizing, [factor](const std::string&, double& edge_mm) {
    edge_mm = std::clamp(edge_mm * factor, 0.01, 1000.0);
  });
  for (CurvatureSize& rule : sizing.curvature)
    rule.edges_per_turn = std::clamp(rule.edges_per_turn / factor, 3.0, 1000.0);
  return sizing;
}

/// One of the three numbers that can be limited.
struct Limited {
  const char* field;
  const char* unit;
  double found, limit;  ///< limit 0: none
};

std::array<Limited, 3> limited(const Forecast& forecast, const Limits& limits) {
  return {{{"limits.tets", " tetrahedra", forecast.mesh.tets, limits.tets},
           {"limits.memory_mb", " MB", forecast.peak_mb, limits.memory_mb},
           {"limits.seconds", " s", forecast.seconds, limits.seconds}}};
}

/// The largest part of a limit that a forecast takes.
double part_of(const Forecast& forecast, const Limits& limits) {
  double most = 0;
  for (const Limited& number : limited(forecast, limits))
    if (number.limit > 0) most = std::max(most, number.found / number.limit);
  return most;
}

std::string shown(double value) {
  char text[32];
  std::snprintf(text, sizeof text, value < 1e5 ? "%.4g" : "%.3e", value);
  if (value >= 1000) std::snprintf(text, sizeof text, "%.0f", value);
  return text;
}

nlohmann::json numbers_json(const Forecast& forecast, double slowness) {
  const double here = slowness * forecast.seconds;
  const auto whole = [](double value) { return std::llround(value); };
  return {{"tets", whole(forecast.mesh.tets)},
          {"points", whole(forecast.mesh.points)},
          {"triangles", whole(forecast.mesh.triangles)},
          {"peak_mb", forecast.peak_mb},
          {"seconds", forecast.seconds},
          {"seconds_here", {kShortest * here, kLongest * here}}};
}

}  // namespace

Result<Forecast> forecast_case(const Session& session, RunContext& ctx) {
  if (!session.may_size()) return usage_error("forecast", "no sizes yet: run the stage sizing");
  if (session.is_current(Stage::kSizing)) return CaseForecaster(session).forecast(*session.sizing(), ctx);
  const Result<SizingField> sizing = session.size_by(session.recipe().sizing, ctx);
  if (!sizing) return sizing.error();
  return CaseForecaster(session).forecast(*sizing, ctx);
}

Result<FittingSizes> fit_sizes(const Session& session, const Limits& limits, RunContext& ctx) {
  constexpr double kLeastPart = 0.99, kMostPart = 0.998;
  constexpr int kMostTries = 16;
  if (!session.may_size()) return usage_error("forecast", "no sizes yet: run the stage sizing");
  if (!(limits.tets > 0 || limits.memory_mb > 0 || limits.seconds > 0))
    return usage_error("forecast", "limits: found none, expected at least one that sizes are to keep");
  const CaseForecaster forecaster(session);
  RunContext quiet;  // the sizes were warned of when the stage ran
  quiet.on_cancelled = ctx.on_cancelled;
  double low = kLeastFactor, high = kMostFactor, factor = 1;
  for (int tries = 0; tries < kMostTries; ++tries) {
    FittingSizes fitting{factor, multiplied(session.recipe().sizing, factor), {}};
    const Result<SizingField> sizing = session.size_by(fitting.sizing, quiet);
    if (!sizing) return sizing.error();
    const Result<Forecast> forecast = forecaster.forecast(*sizing, quiet);
    if (!forecast) return forecast.error();
    fitting.forecast = *forecast;
    const double part = part_of(*forecast, limits);
    if (part >= kLeastPart && part <= kMostPart) return fitting;
    (part > kMostPart ? low : high) = factor;
    // Numbers of elements fall with a power of the edge length between two and three.
    const double guess = factor * std::pow(part / (0.5 * (kLeastPart + kMostPart)), 0.38);
    factor = guess > low && guess < high ? guess : std::sqrt(low * high);
  }
  const std::string what =
      low > kMostFactor / 2 ? "even 64 times the edge lengths give more"
      : high < 2 * kLeastFactor
          ? "even a 64th of the edge lengths gives less"
          : "near " + shown(factor) + " times the edge lengths the forecast leaps over it";
  return usage_error("forecast",
                     what + ": the labels themselves, layers, images, edge_min_mm or edge_max_mm decide");
}

Status check_limits(const Session& session, RunContext& ctx, double space_mb) {
  Limits limits = session.recipe().limits;
  const bool may_be_hopeless =
      space_mb > 0 && 1e-6 * kQualityMb.tets * least_tets(*session.volume(), *session.sizing()) > space_mb;
  if (!(limits.tets > 0 || limits.memory_mb > 0 || limits.seconds > 0 || may_be_hopeless))
    return std::monostate{};
  const Result<Forecast> forecast = forecast_case(session, ctx);
  if (!forecast) return forecast.error();
  std::string beyond;
  for (const Limited& number : limited(*forecast, limits))
    if (number.limit > 0 && number.found > number.limit)
      beyond += (beyond.empty() ? "" : "; ") + std::string(number.field) + ": the forecast is " +
                shown(number.found) + number.unit + ", the limit " + shown(number.limit);
  if (may_be_hopeless && forecast->peak_mb > kHopeless * space_mb) {
    beyond += (beyond.empty() ? "" : "; ") + std::string("memory: the forecast is ") +
              shown(forecast->peak_mb) + " MB for " + shown(forecast->mesh.tets) +
              " tetrahedra, and no more than " + shown(space_mb) + " MB can be had here";
    const double safe_mb = kSafe * space_mb;
    limits.memory_mb = limits.memory_mb > 0 ? std::min(limits.memory_mb, safe_mb) : safe_mb;
  }
  if (beyond.empty()) return std::monostate{};
  const Result<FittingSizes> fitting = fit_sizes(session, limits, ctx);
  if (fitting)
    beyond += "; edge lengths " + shown(fitting->factor) + " times as large would fit (sizing.edge_mm " +
              shown(fitting->sizing.edge_mm) + ")";
  else
    beyond += "; " + fitting.error().message;
  return Error{ErrorCode::kOutOfMemory, "forecast", beyond, {}};
}

Result<nlohmann::json> forecast_json(const Session& session, double elements, RunContext& ctx) {
  const Result<Forecast> forecast = forecast_case(session, ctx);
  if (!forecast) return forecast.error();
  const double here = slowness(session);
  nlohmann::json out = numbers_json(*forecast, here);
  if (!(elements > 0)) return out;
  const Result<FittingSizes> fitting = fit_sizes(session, {elements, 0, 0}, ctx);
  if (!fitting) return fitting.error();
  Recipe fitted = session.recipe();
  fitted.sizing = fitting->sizing;
  out["fitting"] = {{"factor", fitting->factor},
                    {"edge_mm", fitting->sizing.edge_mm},
                    {"sizing", recipe_to_json(fitted)["sizing"]},
                    {"forecast", numbers_json(fitting->forecast, here)}};
  return out;
}

}  // namespace voxtet
