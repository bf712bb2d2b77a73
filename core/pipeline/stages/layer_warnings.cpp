#include "pipeline/stages/layer_warnings.h"

#include "types/stage_names.h"

#include <algorithm>
#include <cstdio>

namespace voxtet {

void warn_about_layers(std::size_t wall, Layering layering, const LayerCount& found, const RunContext& ctx) {
  constexpr double kNearlyAll = 0.95;
  const std::string name = "sizing.thickness[" + std::to_string(wall) + "].layers: ";
  const std::vector<double>& areas = found.by_edges.area_mm2;
  if (std::all_of(areas.begin(), areas.end(), [](double area) { return area == 0; })) {
    ctx.warn(kQualityStage, name + "not counted, as no label of the wall has an outer surface in the mesh");
    return;
  }
  if (layering != Layering::kExact || found.by_edges.exact >= kNearlyAll) return;
  char share[16];
  std::snprintf(share, sizeof share, "%.0f %%", 100 * found.by_edges.exact);
  ctx.warn(kQualityStage, name + "exactly " + std::to_string(found.target_layers) + " on " + share +
                              " of the wall's area, by edges: the others have no room there");
}

}  // namespace voxtet
