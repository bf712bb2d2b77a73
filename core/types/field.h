// A named array of values on a mesh or an image: the one shape of every result that has a value for each
// element.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace voxtet {

/// The kind of element that a field has values for.
enum class On { kVoxels, kTriangles, kPoints, kTets, kFaces };

/// "voxels", "triangles", "points", "tets", "faces".
inline std::string_view name_of(On on) {
  constexpr std::string_view kNames[] = {"voxels", "triangles", "points", "tets", "faces"};
  return kNames[static_cast<int>(on)];
}

/// How the values of a field are meant, and so how a viewer colours them.
enum class Scale {
  kSequential,  ///< from little to much
  kDiverging,   ///< on a range symmetric about 0
  kWhole,       ///< a few whole numbers, in order
  kLabel,       ///< labels of the image
};

/// "sequential", "diverging", "whole", "label".
inline std::string_view name_of(Scale scale) {
  constexpr std::string_view kNames[] = {"sequential", "diverging", "whole", "label"};
  return kNames[static_cast<int>(scale)];
}

/// `values` holds `components` numbers for each element, those of one element next to each other. NaN: the
/// element has no value. Labels are exact as float.
struct Field {
  std::string name;  ///< a word of letters, digits and underscores, as it stands in files: "min_dihedral_deg"
  std::string title;  ///< for people: "Smallest dihedral angle"
  std::string unit;   ///< "mm", "deg", "ms", "log2"; "1" for a ratio or a count
  On on = On::kTets;
  Scale scale = Scale::kSequential;
  int components = 1;
  std::vector<float> values;
};

/// One value at each of some times, such as the voltage at an electrode.
struct Trace {
  std::string name, title, unit;
  std::vector<float> values;
};

/// One frame of a result that changes with time.
struct Snapshot {
  double time_ms = 0;
  std::vector<Field> fields;
  /// What was recorded since the frame before: times, and values of each trace at them.
  std::vector<double> trace_times_ms = {};
  std::vector<Trace> traces = {};
};

/// The field with this name; null if there is none.
inline const Field* find_field(const std::vector<Field>& fields, std::string_view name) {
  const auto found =
      std::find_if(fields.begin(), fields.end(), [&](const Field& field) { return field.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

inline bool is_field_name(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

inline bool all_finite(const std::vector<float>& values) {
  return std::all_of(values.begin(), values.end(), [](float value) { return std::isfinite(value); });
}

}  // namespace voxtet
