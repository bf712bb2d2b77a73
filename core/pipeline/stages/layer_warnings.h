// Warnings about walls whose layers differ from what was asked for.
#pragma once

#include "sizing/build_sizing_field.h"
#include "types/quality_report.h"
#include "types/run_context.h"

namespace voxtet {

/// Warns if layers could not be counted, and if less than 95 % of a wall's area has the exact layers that
/// were asked for. `wall`: index of the wall in sizing.thickness.
void warn_about_layers(std::size_t wall, Layering layering, const LayerCount& found, const RunContext& ctx);

}  // namespace voxtet
