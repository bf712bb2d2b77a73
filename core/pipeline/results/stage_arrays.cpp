#include "pipeline/results/stage_arrays.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

namespace voxtet {
namespace {

using nlohmann::json;

template <class Row>
std::span<const std::uint32_t> flat(const std::vector<Row>& rows) {
  return {reinterpret_cast<const std::uint32_t*>(rows.data()), std::tuple_size_v<Row> * rows.size()};
}

std::span<const std::uint16_t> flat_sides(const std::vector<Sides>& sides) {
  return {reinterpret_cast<const std::uint16_t*>(sides.data()), 2 * sides.size()};
}

std::string type_of(const StageArray& array) {
  struct Namer {
    std::string operator()(std::span<const float>) const { return "float32"; }
    std::string operator()(std::span<const std::uint32_t>) const { return "uint32"; }
    std::string operator()(std::span<const std::uint16_t>) const { return "uint16"; }
    std::string operator()(std::span<const Eigen::Vector3d>) const { return "float32"; }
  };
  return std::visit(Namer{}, array.values);
}

json range_of(std::span<const float> values) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const float value : values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, static_cast<double>(value));
    high = std::max(high, static_cast<double>(value));
  }
  return low <= high ? json{low, high} : json(nullptr);
}

}  // namespace

void add_arrays(const SurfaceMesh& surface, StageArrays& out) {
  out.push_back({"points", 3, std::span<const Eigen::Vector3d>(surface.points)});
  out.push_back({"triangles", 3, flat(surface.triangles)});
  out.push_back({"sides", 2, flat_sides(surface.sides)});
}

void add_arrays(const TetMesh& mesh, StageArrays& out) {
  out.push_back({"points", 3, std::span<const Eigen::Vector3d>(mesh.points)});
  out.push_back({"tets", 4, flat(mesh.tets)});
  out.push_back({"labels", 1, std::span<const std::uint16_t>(mesh.labels)});
  out.push_back({"faces", 3, flat(mesh.faces)});
  out.push_back({"face_sides", 2, flat_sides(mesh.face_sides)});
}

void add_arrays(const std::vector<Field>& fields, StageArrays& out) {
  for (const Field& f : fields)
    out.push_back({f.name, f.components, std::span<const float>(f.values),
                   Field{f.name, f.title, f.unit, f.on, f.scale, f.components, {}}});
}

json array_json(const StageArray& array) {
  const std::size_t count = std::visit([](const auto& values) { return values.size(); }, array.values);
  const bool points = std::holds_alternative<std::span<const Eigen::Vector3d>>(array.values);
  json out{{"name", array.name},
           {"type", type_of(array)},
           {"components", array.components},
           {"count", points ? count : count / static_cast<std::size_t>(array.components)}};
  if (array.field) {
    const Field& field = *array.field;
    out["title"] = field.title;
    out["unit"] = field.unit;
    out["on"] = name_of(field.on);
    out["scale"] = name_of(field.scale);
    out["range"] = range_of(std::get<std::span<const float>>(array.values));
  }
  return out;
}

json trace_json(const Trace& trace) {
  return {{"name", trace.name}, {"title", trace.title}, {"unit", trace.unit}, {"values", trace.values}};
}

json snapshot_json(const Snapshot& snapshot) {
  StageArrays arrays;
  add_arrays(snapshot.fields, arrays);
  json fields = json::array();
  for (const StageArray& array : arrays) fields.push_back(array_json(array));
  json traces = json::array();
  for (const Trace& trace : snapshot.traces) traces.push_back(trace_json(trace));
  return {{"time_ms", snapshot.time_ms},
          {"fields", fields},
          {"trace_times_ms", snapshot.trace_times_ms},
          {"traces", traces}};
}

}  // namespace voxtet
