#include "io/mesh/read/text/read_febio.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/bytes/header_text.h"
#include "io/bytes/text_numbers.h"
#include "io/mesh/read/shared/found_labels.h"
#include "io/mesh/read/shared/numbered_mesh.h"
#include "io/mesh/read/shared/xml_tags.h"

namespace voxtet {
namespace {

/// Numbers between commas.
std::vector<std::string_view> listed(std::string_view text) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t comma = text.find(',');
    parts.push_back(trimmed(text.substr(0, comma)));
    if (comma == std::string_view::npos) return parts;
    text.remove_prefix(comma + 1);
  }
}

class FebioReader {
 public:
  explicit FebioReader(std::string_view text) : tags_(text, "febio_spec") {}

  /// False at a failure, which error() tells.
  bool read() {
    XmlTag tag;
    std::string_view text;
    do {
      if (!tags_.next(tag, text)) return false;
      if (tag.closing) {
        if (!close(tag.name, text)) return false;
        continue;
      }
      if (tag.empty) continue;
      if (tag.name == "Elements") begin_elements(tag);
      if (tag.name == "node" || tag.name == "elem") id_ = tag["id"];
    } while (!tags_.at_end());
    return true;
  }
  const std::string& error() const { return tags_.error(); }

  NumberedMesh found;  ///< labels: places in `parts`
  std::vector<std::string> parts;

 private:
  void begin_elements(const XmlTag& tag) {
    const std::string_view type = tag["type"];
    nodes_ = type == "tet4" ? 4 : type == "tet10" ? 10 : type == "tet15" ? 15 : 0;
    if (nodes_ == 0) return;
    std::string name(tag["name"]);
    if (name.empty()) name = std::string(tag["mat"]);  // of version 2
    if (name.empty()) name = "part " + std::to_string(parts.size() + 1);
    const auto at = std::find(parts.begin(), parts.end(), name);
    part_ = at - parts.begin();
    if (at == parts.end()) parts.push_back(std::move(name));
  }

  bool close(std::string_view name, std::string_view text) {
    const std::string_view parent = tags_.parent();
    if (name == "node" && parent == "Nodes") return add_node(text);
    if (name == "elem" && parent == "Elements" && nodes_ > 0) return add_element(text);
    return true;
  }

  bool number(std::string_view text, const char* what, std::uint64_t& value) {
    const std::optional<std::int64_t> parsed = parse_integer(text);
    if (!parsed || *parsed < 0 || *parsed > kMostItems)
      return tags_.fail(std::string(what) + " is " + in_quotes(text) + ", expected a whole number");
    value = static_cast<std::uint64_t>(*parsed);
    return true;
  }

  bool add_node(std::string_view text) {
    std::uint64_t tag = 0;
    if (!number(id_, "the id of a node", tag)) return false;
    const std::vector<std::string_view> numbers = listed(text);
    Eigen::Vector3d point;
    for (std::size_t d = 0; d < 3; ++d)
      if (numbers.size() != 3 || !parse_real(numbers[d], point[static_cast<Eigen::Index>(d)]))
        return tags_.fail("node " + std::to_string(tag) + " is " + in_quotes(text) +
                          ", expected three finite numbers");
    found.node_tags.push_back(tag);
    found.nodes.push_back(point);
    return true;
  }

  bool add_element(std::string_view text) {
    std::uint64_t tag = 0;
    if (!number(id_, "the id of an element", tag)) return false;
    const std::vector<std::string_view> numbers = listed(text);
    if (numbers.size() != nodes_)
      return tags_.fail("element " + std::to_string(tag) + " has " + std::to_string(numbers.size()) +
                        " nodes, expected " + std::to_string(nodes_));
    std::array<std::uint64_t, 4> corners{};
    for (std::size_t c = 0; c < 4; ++c)
      if (!number(numbers[c], "a node of an element", corners[c])) return false;
    found.add_tet(tag, corners, part_);
    found.curved += nodes_ > 4 ? 1 : 0;
    return true;
  }

  XmlTags tags_;
  std::string_view id_;
  std::size_t nodes_ = 0;  ///< nodes of an element; 0: no tetrahedra
  std::int64_t part_ = 0;
};

}  // namespace

Result<TetMesh> read_febio(const VolumeFile& file, MeshArrays* arrays) {
  const std::string_view text(reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size());
  FebioReader reader(text);
  if (!reader.read()) return Error{ErrorCode::kBadInput, "read_febio", file.name + ": " + reader.error(), {}};
  MeshCursor in(file.bytes, file.name, "read_febio");
  std::vector<LabelInfo> infos;
  const std::vector<std::int64_t> labels = labels_of_parts(reader.parts, infos);
  for (std::int64_t& label : reader.found.labels) label = labels[static_cast<std::size_t>(label)];
  TetMesh mesh = assemble(in, reader.found);
  set_labels(in, mesh, reader.found.labels, "part", arrays);
  if (arrays) arrays->infos = std::move(infos);
  if (in.ok()) keep_corners(mesh, reader.found.curved, arrays);
  const bool lps = text.substr(0, 1024).find("<!-- voxtet mesh, space LPS") != std::string_view::npos;
  return finish_mesh(in, std::move(mesh), lps);
}

}  // namespace voxtet
