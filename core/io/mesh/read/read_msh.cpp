#include "io/mesh/read/read_msh.h"

#include <algorithm>
#include <limits>

#include "io/bytes/header_text.h"
#include "io/mesh/read/msh_parts.h"

namespace voxtet {
namespace {

void read_format(MeshCursor& in, MshFile& file) {
  const std::string_view version = in.word("the version");
  file.version = version == "4.1" ? 41 : version == "2.2" || version == "2.1" || version == "2" ? 22 : 0;
  if (in.ok() && file.version == 0) in.fail("MSH version " + in_quotes(version) + ", expected 4.1 or 2.2");
  file.binary = in.integer("the file type", 0, 1) == 1;
  in.integer("the size of numbers", 8, 8);
  if (file.binary) {
    in.rest_of_line();
    if (const auto one = in.raw<std::int32_t>("the byte order"); in.ok() && one != 1)
      in.fail("big-endian file, expected little-endian");
  }
  in.expect("$EndMeshFormat");
}

void read_section(MeshCursor& in, MshFile& file, std::string_view section) {
  const std::string name(section.substr(1));
  if (section == "$Comments") {
    while (in.ok() && in.peek_word() != "$EndComments") {
      if (in.peek_word().empty()) in.fail("no $EndComments follows");
      file.lps = in.rest_of_line() == "space LPS" || file.lps;
    }
    in.expect("$EndComments");
  } else if (section == "$PhysicalNames") {
    read_msh_names(in, file);
  } else if (section == "$Entities" && file.version == 41) {
    read_msh41_entities(in, file);
  } else if (section == "$Nodes") {
    file.version == 41 ? read_msh41_nodes(in, file) : read_msh22_nodes(in, file);
  } else if (section == "$Elements") {
    file.version == 41 ? read_msh41_elements(in, file) : read_msh22_elements(in, file);
  } else if (section.size() > 1 && section[0] == '$') {
    in.skip_behind("$End" + name);
    return;
  } else {
    if (in.ok()) in.fail("found " + in_quotes(section) + ", expected a section");
    return;
  }
  if (section != "$Comments") in.expect("$End" + name);
}

/// The permutation that sorts `tags`; fails where one comes twice.
std::vector<std::uint32_t> sorted_by_tag(MeshCursor& in, const std::vector<std::uint64_t>& tags,
                                         const char* what) {
  std::vector<std::uint32_t> order(tags.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(i);
  if (!std::is_sorted(tags.begin(), tags.end()))
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return tags[a] < tags[b]; });
  for (std::size_t i = 1; i < order.size() && in.ok(); ++i)
    if (tags[order[i - 1]] == tags[order[i]])
      in.fail(std::string(what) + " tag " + std::to_string(tags[order[i]]) + " comes twice");
  return order;
}

/// Node tag -> index of the point, by subtraction where tags are without gaps.
class NodeIndex {
 public:
  explicit NodeIndex(std::vector<std::uint64_t> ascending) : tags_(std::move(ascending)) {
    dense_ = !tags_.empty() && tags_.back() - tags_.front() + 1 == tags_.size();
  }
  /// Index, or the number of nodes where no node has this tag.
  std::size_t find(std::uint64_t tag) const {
    if (dense_) return tag < tags_.front() || tag > tags_.back() ? tags_.size() : tag - tags_.front();
    const auto at = std::lower_bound(tags_.begin(), tags_.end(), tag);
    return at == tags_.end() || *at != tag ? tags_.size() : static_cast<std::size_t>(at - tags_.begin());
  }
  std::size_t size() const { return tags_.size(); }

 private:
  std::vector<std::uint64_t> tags_;
  bool dense_ = false;
};

TetMesh assemble(MeshCursor& in, const MshFile& file) {
  TetMesh mesh;
  const std::vector<std::uint32_t> node_order = sorted_by_tag(in, file.node_tags, "node");
  const std::vector<std::uint32_t> tet_order = sorted_by_tag(in, file.tet_tags, "element");
  if (!in.ok()) return mesh;
  std::vector<std::uint64_t> tags;
  tags.reserve(node_order.size());
  mesh.points.reserve(node_order.size());
  for (const std::uint32_t node : node_order) {
    tags.push_back(file.node_tags[node]);
    mesh.points.push_back(file.nodes[node]);
  }
  const NodeIndex index(std::move(tags));
  mesh.tets.reserve(tet_order.size());
  mesh.labels.reserve(tet_order.size());
  for (const std::uint32_t t : tet_order) {
    Tet tet{};
    for (std::size_t c = 0; c < 4; ++c) {
      const std::size_t point = index.find(file.tets[t][c]);
      if (point == index.size()) {
        in.fail("element " + std::to_string(file.tet_tags[t]) + ": node " + std::to_string(file.tets[t][c]) +
                " is not among the " + std::to_string(index.size()) + " nodes of the file");
        return mesh;
      }
      tet[c] = static_cast<std::uint32_t>(point);
    }
    mesh.tets.push_back(tet);
    mesh.labels.push_back(file.labels[t]);
  }
  return mesh;
}

}  // namespace

Result<TetMesh> read_msh(const VolumeFile& volume_file, MeshArrays* arrays) {
  MeshCursor in(volume_file.bytes, volume_file.name, "read_msh");
  MshFile file;
  in.expect("$MeshFormat");
  read_format(in, file);
  while (in.ok() && !in.at_end()) read_section(in, file, in.word("a section"));
  TetMesh mesh = in.ok() ? assemble(in, file) : TetMesh{};
  if (arrays) arrays->infos = std::move(file.infos);
  return finish_mesh(in, std::move(mesh), file.lps);
}

}  // namespace voxtet
