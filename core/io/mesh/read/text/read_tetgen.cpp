#include "io/mesh/read/text/read_tetgen.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/bytes/header_text.h"
#include "io/mesh/read/shared/found_labels.h"
#include "io/mesh/read/shared/numbered_mesh.h"
#include "io/mesh/shared/mesh_format.h"

namespace voxtet {
namespace {

constexpr const char* kTetgenReader = "read_tetgen";
constexpr std::int64_t kMostAttributes = 1000;

/// Comments before the first number.
std::vector<std::string_view> head_comments(std::span<const std::uint8_t> bytes) {
  std::vector<std::string_view> comments;
  std::size_t at = 0;
  bool ended = false;
  while (const auto line = next_line(bytes, at, ended)) {
    if (!line->starts_with('#')) break;
    comments.push_back(trimmed(line->substr(1)));
  }
  return comments;
}

/// `lps`: whether a comment says so.
Result<NumberedMesh> read_node(const VolumeFile& file, bool& lps) {
  MeshCursor in(file.bytes, file.name, kTetgenReader, '#');
  NumberedMesh found;
  const std::int64_t count = in.integer("the number of nodes", 0, kMostItems);
  in.integer("the dimension", 3, 3);
  const std::int64_t attributes = in.integer("the number of attributes", 0, kMostAttributes);
  const std::int64_t markers = in.integer("the number of markers", 0, 1);
  if (in.can_hold(static_cast<std::uint64_t>(count), 8, "nodes")) {
    found.nodes.reserve(static_cast<std::size_t>(count));
    found.node_tags.reserve(static_cast<std::size_t>(count));
  }
  for (std::int64_t i = 0; i < count && in.ok(); ++i) {
    found.node_tags.push_back(static_cast<std::uint64_t>(in.integer("a node number", 0, kMostItems)));
    const double x = in.real("a coordinate"), y = in.real("a coordinate"), z = in.real("a coordinate");
    found.nodes.emplace_back(x, y, z);
    for (std::int64_t a = 0; a < attributes + markers && in.ok(); ++a) in.real("an attribute of a node");
  }
  in.expect_end("the last node");
  for (const std::string_view comment : head_comments(file.bytes))
    lps = lps || comment.starts_with("voxtet mesh, space LPS");
  if (!in.ok()) return in.error();
  return found;
}

Result<TetMesh> read_ele(const VolumeFile& file, NumberedMesh found, bool lps, MeshArrays* arrays) {
  MeshCursor in(file.bytes, file.name, kTetgenReader, '#');
  const std::int64_t count = in.integer("the number of tetrahedra", 0, kMostItems);
  const std::int64_t nodes = in.integer("the nodes of a tetrahedron", 4, 10);
  if (in.ok() && nodes != 4 && nodes != 10)
    in.fail("tetrahedra of " + std::to_string(nodes) + " nodes, expected 4 or 10");
  const std::int64_t attributes = in.integer("the number of attributes", 0, kMostAttributes);
  in.can_hold(static_cast<std::uint64_t>(count), 2 * static_cast<std::uint64_t>(1 + nodes + attributes),
              "tetrahedra");
  std::vector<Field> fields;
  for (std::int64_t a = 2; a <= attributes && in.ok(); ++a)
    fields.push_back({"attribute_" + std::to_string(a), "", "1", On::kTets, Scale::kSequential, 1, {}});
  for (std::int64_t i = 0; i < count && in.ok(); ++i) {
    const std::int64_t tag = in.integer("the number of a tetrahedron", 0, kMostItems);
    std::array<std::uint64_t, 4> corners{};
    for (std::int64_t n = 0; n < nodes && in.ok(); ++n) {
      const std::int64_t node = in.integer("a node of a tetrahedron", 0, kMostItems);
      if (n < 4) corners[static_cast<std::size_t>(n)] = static_cast<std::uint64_t>(node);
    }
    double label = 0;
    for (std::int64_t a = 0; a < attributes && in.ok(); ++a) {
      const double value = in.real("an attribute of a tetrahedron");
      if (a == 0)
        label = value;
      else
        fields[static_cast<std::size_t>(a - 1)].values.push_back(static_cast<float>(value));
    }
    if (in.ok() && !(std::abs(label) < 1e15 && label == std::floor(label)))
      in.fail("the first attribute of tetrahedron " + std::to_string(tag) + " is " + number_text(label) +
              ", expected a whole number: its label");
    found.add_tet(static_cast<std::uint64_t>(tag), corners, in.ok() ? static_cast<std::int64_t>(label) : 0);
  }
  in.expect_end("the last tetrahedron");
  if (nodes == 10) found.curved = found.tets.size();
  const bool in_order = std::is_sorted(found.tet_tags.begin(), found.tet_tags.end());
  TetMesh mesh = in.ok() ? assemble(in, found) : TetMesh{};
  if (in.ok() && attributes == 0)
    set_one_region(mesh, "no attributes in .ele", arrays);
  else
    set_labels(in, mesh, found.labels, "attribute", arrays);
  keep_corners(mesh, found.curved, arrays);
  if (arrays) {
    for (Field& field : fields)
      if (in_order && all_finite(field.values)) arrays->cell_data.push_back(std::move(field));
    for (const std::string_view comment : head_comments(file.bytes)) {
      if (!comment.starts_with("label ")) continue;
      const std::string_view text = comment.substr(6);
      const std::size_t space = text.find(' ');
      if (space != std::string_view::npos)
        add_label_name(parse_integer(text.substr(0, space)).value_or(0), text.substr(space + 1),
                       arrays->infos);
    }
  }
  return finish_mesh(in, std::move(mesh), lps);
}

}  // namespace

Result<TetMesh> read_tetgen(const VolumeFile& file, MeshArrays* arrays) {
  const std::string ending = lower_case(mesh_ending_of(file.name));
  const std::string base = file.name.substr(0, file.name.size() - ending.size());
  const std::string folderless = base.substr(base.find_last_of("/\\") + 1);
  std::vector<Bytes> beside;
  beside.reserve(2);
  const auto part = [&](const std::string& wanted) -> Result<VolumeFile> {
    if (ending == wanted) return VolumeFile{file.name, file.bytes, {}};
    if (!file.sibling)
      return Error{ErrorCode::kBadInput,
                   kTetgenReader,
                   file.name + ": needs " + folderless + wanted + " beside it",
                   {}};
    Result<Bytes> bytes = file.sibling(folderless + wanted);
    if (!bytes) return bytes.error();
    beside.push_back(std::move(bytes).value());
    return VolumeFile{base + wanted, beside.back(), {}};
  };
  const Result<VolumeFile> node_file = part(".node");
  if (!node_file) return node_file.error();
  bool lps = false;
  Result<NumberedMesh> nodes = read_node(*node_file, lps);
  if (!nodes) return nodes.error();
  const Result<VolumeFile> ele_file = part(".ele");
  if (!ele_file) return ele_file.error();
  return read_ele(*ele_file, std::move(nodes).value(), lps, arrays);
}

}  // namespace voxtet
