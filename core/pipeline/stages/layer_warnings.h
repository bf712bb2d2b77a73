// What is said of walls whose layers are not what was asked for.
#pragma once

#include "sizing/build_sizing_field.h"
#include "types/quality_report.h"
#include "types/run_context.h"

namespace voxtet {

/// Warns where layers could not be counted, and where fewer than nearly all of a wall has the exact layers
/// that were asked for. `wall`: number of the wall in sizing.thickness.
void warn_about_layers(std::size_t wall, Layering layering, const LayerCount& found, const RunContext& ctx);

}  // namespace voxtet
