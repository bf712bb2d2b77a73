// All edge lengths that a user asks for, by name.
#pragma once

#include <string>

#include "sizing/build_sizing_field.h"

namespace voxtet {

/// Calls visit(field, edge_mm) for every edge length of SizingParams (const or not). `field` is its path in
/// the recipe below "sizing.". The bounds edge_min_mm and edge_max_mm, and lengths that follow from layers,
/// images and curvature, are left out.
template <class Params, class Visit>
void for_each_edge_length(Params& params, Visit&& visit) {
  const auto item = [](const std::string& list, std::size_t i) {
    return list + "[" + std::to_string(i) + "]";
  };
  const auto visit_list = [&](const std::string& list, auto& rules) {
    for (std::size_t i = 0; i < rules.size(); ++i) visit(item(list, i) + ".edge_mm", rules[i].edge_mm);
  };
  visit("edge_mm", params.edge_mm);
  visit_list("labels", params.labels);
  visit_list("regions", params.regions);
  visit_list("distances", params.distances);
  for (std::size_t i = 0; i < params.masks.size(); ++i)
    visit_list(item("masks", i) + ".edges", params.masks[i].edges);
  for (std::size_t i = 0; i < params.thickness.size(); ++i) {
    if (params.thickness[i].layers > 0) continue;
    visit(item("thickness", i) + ".edge_thin_mm", params.thickness[i].edge_thin_mm);
    visit(item("thickness", i) + ".edge_thick_mm", params.thickness[i].edge_thick_mm);
  }
}

}  // namespace voxtet
