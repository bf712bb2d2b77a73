// How a field of the recipe is declared, and the fields that several tables have.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "types/region.h"

namespace voxtet {

/// What is declared for a field. The range is inclusive; for vectors it holds for each component.
struct FieldInfo {
  const char* name;
  const char* unit;
  double min, max;
  const char* description;
};

/// Items that a list may have.
inline constexpr std::size_t kMaxListItems = 1000;

inline constexpr double kAnyMin = std::numeric_limits<double>::lowest();
inline constexpr double kAnyMax = std::numeric_limits<double>::max();

template <class Enum>
struct Choice {
  const char* name;
  Enum value;
};

template <class Enum>
using Choices = std::vector<Choice<Enum>>;

template <class V>
void visit_fields(V& v, Region& p) {
  v.choice(
      {"shape", "", 0, 0, "Shape of the region."}, p.shape,
      Choices<RegionShape>{
          {"sphere", RegionShape::kSphere}, {"box", RegionShape::kBox}, {"capsule", RegionShape::kCapsule}});
  v.field({"centre_mm", "mm", kAnyMin, kAnyMax, "Centre of sphere or box, first end of a capsule; RAS."},
          p.centre_mm);
  v.field({"end_mm", "mm", kAnyMin, kAnyMax, "Second end of a capsule; RAS."}, p.end_mm);
  v.field({"half_size_mm", "mm", 0.001, 10000, "Half edges of a box."}, p.half_size_mm);
  v.field({"axes_deg", "deg", -360, 360, "Rotation of a box about x, then y, then z."}, p.axes_deg);
  v.field({"radius_mm", "mm", 0.001, 10000, "Radius of sphere or capsule."}, p.radius_mm);
}

}  // namespace voxtet
