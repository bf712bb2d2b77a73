#include "io/mesh/read/read_carp.h"

#include <array>

#include "io/bytes/header_text.h"
#include "io/mesh/read/shared/found_labels.h"
#include "io/mesh/read/shared/mesh_cursor.h"
#include "io/mesh/shared/mesh_format.h"
#include "io/mesh/write/write_carp.h"

namespace voxtet {
namespace {

constexpr const char* kReader = "read_carp";

struct ElementType {
  std::string_view name;
  int corners;
};
constexpr std::array<ElementType, 8> kElementTypes{
    {{"Tt", 4}, {"Hx", 8}, {"Oc", 6}, {"Py", 5}, {"Pr", 6}, {"Qd", 4}, {"Tr", 3}, {"Ln", 2}}};

Result<std::vector<Eigen::Vector3d>> read_points(const VolumeFile& file) {
  MeshCursor in(file.bytes, file.name, kReader);
  const std::int64_t count = in.integer("the number of points", 0, kMostItems);
  std::vector<Eigen::Vector3d> points;
  if (in.can_hold(static_cast<std::uint64_t>(count), 6, "points"))
    points.reserve(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count && in.ok(); ++i) {
    const double x = in.real("a coordinate"), y = in.real("a coordinate"), z = in.real("a coordinate");
    points.emplace_back(x / kUmPerMm, y / kUmPerMm, z / kUmPerMm);
  }
  in.expect_end("the last point");
  if (!in.ok()) return in.error();
  return points;
}

int corners_of(MeshCursor& in, std::string_view name) {
  for (const ElementType& type : kElementTypes)
    if (type.name == name) return type.corners;
  if (in.ok())
    in.fail("element type " + in_quotes(name) + " is not known, expected Tt, Hx, Oc, Py, Pr, Qd, Tr or Ln");
  return 0;
}

/// `is_tet` says of each element of the file whether it was kept.
Result<TetMesh> read_elements(const VolumeFile& file, std::vector<Eigen::Vector3d> points,
                              std::vector<bool>& is_tet, MeshArrays* arrays) {
  MeshCursor in(file.bytes, file.name, kReader);
  TetMesh mesh;
  std::vector<std::int64_t> regions;
  const std::int64_t count = in.integer("the number of elements", 0, kMostItems);
  if (in.can_hold(static_cast<std::uint64_t>(count), 7, "elements")) {
    mesh.tets.reserve(static_cast<std::size_t>(count));
    regions.reserve(static_cast<std::size_t>(count));
  }
  const auto last = static_cast<std::int64_t>(points.size()) - 1;
  mesh.points = std::move(points);
  for (std::int64_t i = 0; i < count && in.ok(); ++i) {
    const std::string_view type = in.word("an element");
    const int corners = corners_of(in, type);
    std::array<std::uint32_t, 8> corner{};
    for (int c = 0; c < corners; ++c) {
      const std::int64_t point = in.integer("a point of an element", INT32_MIN, kMostItems);
      if (in.ok() && (point < 0 || point > last))
        in.fail("element " + std::to_string(i + 1) + ": point " + std::to_string(point) + ", expected 0 to " +
                std::to_string(last));
      corner[static_cast<std::size_t>(c)] = static_cast<std::uint32_t>(point);
    }
    is_tet.push_back(type == "Tt");
    if (!is_tet.back()) {
      in.rest_of_line();
      continue;
    }
    if (in.ok() && in.at_line_end()) in.fail("element " + std::to_string(i + 1) + " has no region");
    regions.push_back(in.integer("the region of an element", INT32_MIN, INT32_MAX));
    mesh.tets.push_back({corner[0], corner[1], corner[2], corner[3]});
  }
  in.expect_end("the last element");
  set_labels(in, mesh, regions, "region", arrays);
  return finish_mesh(in, std::move(mesh), false);
}

/// One or two directions for each element of .elem; those of the tetrahedra are kept.
Result<std::vector<Field>> read_directions(const VolumeFile& file, const std::vector<bool>& is_tet) {
  MeshCursor in(file.bytes, file.name, kReader);
  const std::int64_t count = in.integer("the number of directions of an element", 1, 2);
  std::vector<Field> fields;
  if (in.ok())
    fields.push_back({std::string(kFibreField), "Fibre", "1", On::kTets, Scale::kSequential, 3, {}});
  if (count == 2)
    fields.push_back({std::string(kSheetField), "Sheet", "1", On::kTets, Scale::kSequential, 3, {}});
  for (std::size_t e = 0; e < is_tet.size() && in.ok(); ++e)
    for (Field& field : fields)
      for (int d = 0; d < 3; ++d) {
        if (in.ok() && in.at_end())
          in.fail("found " + std::to_string(e) + " rows, expected " + std::to_string(is_tet.size()) +
                  ", one for each element of .elem");
        const double component = in.real("a direction");
        if (is_tet[e]) field.values.push_back(static_cast<float>(component));
      }
  in.expect_end("the last element's direction");
  if (!in.ok()) return in.error();
  return fields;
}

}  // namespace

Result<TetMesh> read_carp(const VolumeFile& file, MeshArrays* arrays) {
  const std::string ending = lower_case(mesh_ending_of(file.name));
  const std::string base = file.name.substr(0, file.name.size() - ending.size());
  const std::string folderless = base.substr(base.find_last_of("/\\") + 1);
  Bytes beside;
  const auto part = [&](const std::string& wanted) -> Result<VolumeFile> {
    if (ending == wanted) return VolumeFile{file.name, file.bytes, {}};
    if (!file.sibling)
      return Error{
          ErrorCode::kBadInput, kReader, file.name + ": needs " + folderless + wanted + " beside it", {}};
    Result<Bytes> bytes = file.sibling(folderless + wanted);
    if (!bytes.ok()) return bytes.error();
    beside = std::move(bytes).value();
    return VolumeFile{base + wanted, beside, {}};
  };
  const Result<VolumeFile> points_file = part(".pts");
  if (!points_file.ok()) return points_file.error();
  Result<std::vector<Eigen::Vector3d>> points = read_points(*points_file);
  if (!points.ok()) return points.error();
  const Result<VolumeFile> elements_file = part(".elem");
  if (!elements_file.ok()) return elements_file.error();
  std::vector<bool> is_tet;
  Result<TetMesh> mesh = read_elements(*elements_file, std::move(points).value(), is_tet, arrays);
  if (!mesh.ok() || arrays == nullptr) return mesh;
  const Result<VolumeFile> directions_file = part(".lon");
  if (!directions_file.ok()) return mesh;  // a mesh without fibres has none
  Result<std::vector<Field>> directions = read_directions(*directions_file, is_tet);
  if (!directions.ok()) return directions.error();
  arrays->cell_data = std::move(directions).value();
  return mesh;
}

}  // namespace voxtet
