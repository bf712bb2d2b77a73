// What must hold before a mesh is made, or an earlier one is given.
#pragma once

#include <string_view>
#include <vector>

#include "pipeline/stages/stage.h"

namespace voxtet {

class Session;

/// Fields of the recipe that make no result, and so are in no key, but may forbid one: asked before `stage`
/// runs or its earlier result is given, and again when one of `reads` or a result that the stage is made from
/// is another.
struct Admission {
  Stage stage;
  std::vector<std::string_view> reads;
  Status (*admit)(const Session&, RunContext&);
};

/// The labels to transfer are there, before the surface; the forecast is within the limits, before the
/// adapted surface.
const std::vector<Admission>& admissions();

}  // namespace voxtet
