// What must hold before a mesh is made, or before an earlier one is given again.
#pragma once

#include <string_view>
#include <vector>

#include "pipeline/stages/stage.h"

namespace voxtet {

class Session;

/// A check on fields of the recipe that do not change a result, and so are in no key, but may forbid it. It
/// is made before `stage` runs or its earlier result is given again, and repeated when one of the fields
/// `reads`, or a result that the stage is made from, has changed.
struct Admission {
  Stage stage;
  std::vector<std::string_view> reads;
  Status (*admit)(const Session&, RunContext&);
};

/// Two checks: before the surface, that the volume has the labels to transfer; before the adapted surface,
/// that the forecast is within the limits.
const std::vector<Admission>& admissions();

}  // namespace voxtet
