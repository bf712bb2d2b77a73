// The arrays of a stage's result, by name: what a viewer lists and asks for.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "types/field.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// One array, whose values the session holds. Points are rows of three numbers, mm, RAS.
struct StageArray {
  std::string name;
  int components = 1;
  std::variant<std::span<const float>, std::span<const std::uint32_t>, std::span<const std::uint16_t>,
               std::span<const Eigen::Vector3d>>
      values;
  std::optional<Field> field{};  ///< its description, without values; none for geometry
};
using StageArrays = std::vector<StageArray>;

void add_arrays(const SurfaceMesh& surface, StageArrays& out);  ///< points, triangles, sides
void add_arrays(const TetMesh& mesh, StageArrays& out);         ///< points, tets, labels, faces, face_sides
void add_arrays(const std::vector<Field>& fields, StageArrays& out);

/// {name, type ("float32", "uint32", "uint16"), components, count}; for a field also {title, unit, on, scale,
/// range}. `range` holds its smallest and largest finite value; null if there is none.
nlohmann::json array_json(const StageArray& array);
/// {name, title, unit, values}.
nlohmann::json trace_json(const Trace& trace);
/// {time_ms, fields: [array_json], trace_times_ms, traces: [trace_json]}.
nlohmann::json snapshot_json(const Snapshot& snapshot);

}  // namespace voxtet
