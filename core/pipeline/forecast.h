// What meshing a case will need, and edge lengths that stay within limits; known before any mesh is made.
#pragma once

#include <nlohmann/json.hpp>

#include "pipeline/memory.h"
#include "pipeline/session.h"
#include "sizing/forecast_mesh.h"

namespace voxtet {

/// `peak_mb` is the largest StageRecord::peak_mb of all stages: measured for those that have run, for the
/// others given by a linear model of voxels, label triangles and tetrahedra. `seconds` is the time of all
/// stages by such a model, which knows of edge lengths, junctions and flaws of labels too, for one thread of
/// an AMD EPYC; in wasm 1.6 times as many. Accuracy: tests/sweep/sweep_forecast.
struct Forecast {
  MeshForecast mesh;
  double peak_mb = 0, seconds = 0;
};

/// The sizing of a recipe with all edge lengths multiplied by `factor`.
struct FittingSizes {
  double factor = 1;
  SizingParams sizing;
  Forecast forecast;
};

/// The forecast for the session's current recipe; no result of a stage changes. Needs Session::may_size().
/// Errors: kUsage without; those of sizing; kCancelled.
Result<Forecast> forecast_case(const Session& session, RunContext& ctx);

/// The smallest common factor on the recipe's edge lengths for which the forecast is within the limits: it
/// uses the tightest limit to within 1 %. Numbers of layers, images of sizes and the bounds edge_min_mm and
/// edge_max_mm stay. Needs Session::may_size(). Errors: kUsage without it, if no limit is set, and if no
/// factor from 1/64 to 64 is enough; kCancelled.
Result<FittingSizes> fit_sizes(const Session& session, const Limits& limits, RunContext& ctx);

/// kOutOfMemory if the forecast exceeds a limit of the recipe; the message gives the forecast, the limit and
/// the edge length that would fit. Also if the forecast exceeds `space_mb`, the memory that can be addressed
/// (0: no bound), by so much that meshing would go on for minutes and then fail. Needs the result of the
/// stage sizing.
Status check_limits(const Session& session, RunContext& ctx, double space_mb = memory_space_mb());

/// {tets, points, triangles, peak_mb, seconds} of forecast_case, and `seconds_here`, the least and the most
/// that it may be on this machine, judged by how long the label surface took. With `elements` > 0 also
/// `fitting`, the sizes that give this many tetrahedra: {factor, edge_mm, sizing, forecast}, `sizing` as in
/// the recipe. Errors: those of forecast_case and fit_sizes.
Result<nlohmann::json> forecast_json(const Session& session, double elements, RunContext& ctx);

}  // namespace voxtet
