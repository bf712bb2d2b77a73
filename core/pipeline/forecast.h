// What meshing a case will take, and the edge lengths that stay within limits; known before any mesh is.
#pragma once

#include <nlohmann/json.hpp>

#include "pipeline/memory.h"
#include "pipeline/session.h"
#include "sizing/forecast_mesh.h"

namespace voxtet {

/// `peak_mb` as StageRecord::peak_mb of the stage with the most: measured for those that have run, for the
/// others by a linear model of voxels, label triangles and tetrahedra. `seconds` are those of all stages by
/// such a model, one thread of an AMD EPYC; in wasm 1.6 times as many. Accuracy: tests/sweep/sweep_forecast.
struct Forecast {
  MeshForecast mesh;
  double peak_mb = 0, seconds = 0;
};

/// Edge lengths of a recipe, all multiplied by `factor`.
struct FittingSizes {
  double factor = 1;
  SizingParams sizing;
  Forecast forecast;
};

/// Of the recipe as it stands, beside what stages have given for another. Needs Session::may_size(). Errors:
/// kUsage without; those of sizing; kCancelled.
Result<Forecast> forecast_case(const Session& session, RunContext& ctx);

/// The smallest common factor on the recipe's edge lengths with which the forecast is within the limits:
/// within 1 % below the one that binds. Numbers of layers, images of sizes and the bounds edge_min_mm and
/// edge_max_mm stay. Needs Session::may_size(). Errors: kUsage without, and where no limit
/// is set or none of the factors from 1/64 to 64 will do; kCancelled.
Result<FittingSizes> fit_sizes(const Session& session, const Limits& limits, RunContext& ctx);

/// kOutOfMemory with the forecast, the recipe's limit that it is beyond, and the edge length that would fit.
/// Also where the forecast is so far beyond the `space_mb` that can be addressed (0: no bound) that meshing
/// would go on for minutes and then fail. Needs the sizes of the recipe as it stands.
Status check_limits(const Session& session, RunContext& ctx, double space_mb = memory_space_mb());

/// {tets, points, triangles, peak_mb, seconds} of forecast_case; with `elements` > 0 also `fitting`, the
/// sizes that give so many tetrahedra: {factor, edge_mm, sizing, forecast}, `sizing` as in the recipe.
/// Errors: those of both.
Result<nlohmann::json> forecast_json(const Session& session, double elements, RunContext& ctx);

}  // namespace voxtet
