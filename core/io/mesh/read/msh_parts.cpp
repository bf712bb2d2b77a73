#include "io/mesh/read/msh_parts.h"

#include <algorithm>
#include <string>

#include "io/bytes/header_text.h"

namespace voxtet {
namespace {

struct TypeSize {
  int type, corners;
};
constexpr std::array<TypeSize, 33> kTypeSizes{
    {{1, 2},   {2, 3},   {3, 4},   {4, 4},   {5, 8},   {6, 6},   {7, 5},   {8, 3},   {9, 6},
     {10, 9},  {11, 10}, {12, 27}, {13, 18}, {14, 14}, {15, 1},  {16, 8},  {17, 20}, {18, 15},
     {19, 13}, {20, 9},  {21, 10}, {22, 12}, {23, 15}, {24, 15}, {25, 21}, {26, 4},  {27, 5},
     {28, 6},  {29, 20}, {30, 35}, {31, 56}, {92, 64}, {93, 125}}};

/// Leaves the line of a section's name: binary data begin right behind it.
void begin_binary(MeshCursor& in, const MshFile& file) {
  if (file.binary) in.rest_of_line();
}

Eigen::Vector3d read_point(MeshCursor& in, bool binary) {
  const double x = msh_real(in, binary, "a coordinate");
  const double y = msh_real(in, binary, "a coordinate");
  const double z = msh_real(in, binary, "a coordinate");
  return {x, y, z};
}

void add_tet(MeshCursor& in, MshFile& file, std::uint64_t tag, const std::array<std::uint64_t, 4>& corners,
             std::int64_t group, std::int64_t entity, int nodes) {
  if (!in.ok()) return;
  file.mesh.add_tet(tag, corners, group);
  file.mesh.curved += nodes > 4 ? 1 : 0;
  file.entities.push_back(entity);
}

/// Reads a list of `count` integers and returns the first, or 0.
std::int32_t first_of_list(MeshCursor& in, bool binary, std::uint64_t count) {
  if (!in.can_hold(count, binary ? 4 : 2, "tags of an entity")) return 0;
  std::int32_t first = 0;
  for (std::uint64_t i = 0; i < count && in.ok(); ++i) {
    const std::int32_t tag = msh_int(in, binary, "a tag of an entity");
    if (i == 0) first = tag;
  }
  return first;
}

std::int64_t group_of_volume(const MshFile& file, std::int32_t volume) {
  const auto at = std::lower_bound(file.volumes.begin(), file.volumes.end(), volume,
                                   [](const auto& entry, std::int32_t tag) { return entry.first < tag; });
  return at == file.volumes.end() || at->first != volume ? 0 : std::int64_t{at->second};
}

/// The tags and nodes of one element of MSH 2.2.
void read_msh22_element(MeshCursor& in, MshFile& file, std::int64_t number, std::int64_t type,
                        std::int64_t tags) {
  std::array<std::int32_t, 2> group_and_entity{};
  for (std::int64_t i = 0; i < tags && in.ok(); ++i) {
    const std::int32_t value = msh_int(in, file.binary, "a tag of an element");
    if (i < 2) group_and_entity[static_cast<std::size_t>(i)] = value;
  }
  const int corners = msh_corners(in, type);
  std::array<std::uint64_t, 4> nodes{};
  for (int c = 0; c < corners && in.ok(); ++c) {
    const std::int32_t node = msh_int(in, file.binary, "a node of an element");
    if (in.ok() && (number < 0 || node < 0))
      in.fail("element " + std::to_string(number) + ": node " + std::to_string(node) +
              ", expected no negative number");
    if (c < 4) nodes[static_cast<std::size_t>(c)] = static_cast<std::uint64_t>(node);
  }
  if (is_msh_tetrahedron(type))
    add_tet(in, file, static_cast<std::uint64_t>(number), nodes, group_and_entity[0], group_and_entity[1],
            corners);
}

}  // namespace

bool is_msh_tetrahedron(std::int64_t type) {
  return type == 4 || type == 11 || (type >= 29 && type <= 31);
}

int msh_corners(MeshCursor& in, std::int64_t type) {
  for (const TypeSize& entry : kTypeSizes)
    if (entry.type == type) return entry.corners;
  if (in.ok()) in.fail("element type " + std::to_string(type) + " is not known");
  return 0;
}

void read_msh_names(MeshCursor& in, MshFile& file) {
  // A line each: dimension, number, name in quotes. The first is their count.
  while (in.ok() && !in.at_end() && in.peek_word() != "$EndPhysicalNames") {
    const std::string_view line = in.rest_of_line();
    const std::size_t open = line.find('"'), close = line.rfind('"');
    const std::vector<std::string> words = words_of(line.substr(0, std::min(open, line.size())));
    if (words.size() != 2 || words[0] != "3" || close <= open) continue;
    add_label_name(parse_integer(words[1]).value_or(0), line.substr(open + 1, close - open - 1), file.infos);
  }
}

void read_msh41_entities(MeshCursor& in, MshFile& file) {
  begin_binary(in, file);
  std::array<std::uint64_t, 4> counts{};
  for (std::uint64_t& count : counts) count = msh_size(in, file.binary, "the number of entities");
  for (int dimension = 0; dimension < 4; ++dimension) {
    const std::uint64_t count = counts[static_cast<std::size_t>(dimension)];
    if (!in.can_hold(count, 8, "entities")) return;
    for (std::uint64_t i = 0; i < count && in.ok(); ++i) {
      const std::int32_t tag = msh_int(in, file.binary, "the tag of an entity");
      for (int d = 0; d < (dimension == 0 ? 3 : 6); ++d) msh_real(in, file.binary, "the box of an entity");
      const std::int32_t group =
          first_of_list(in, file.binary, msh_size(in, file.binary, "the number of physical groups"));
      if (dimension > 0)
        first_of_list(in, file.binary, msh_size(in, file.binary, "the number of bounding entities"));
      if (dimension == 3) file.volumes.emplace_back(tag, group);
    }
  }
  std::sort(file.volumes.begin(), file.volumes.end());
}

void read_msh41_nodes(MeshCursor& in, MshFile& file) {
  begin_binary(in, file);
  const std::uint64_t blocks = msh_size(in, file.binary, "the number of node blocks");
  const std::uint64_t nodes = msh_size(in, file.binary, "the number of nodes");
  msh_size(in, file.binary, "the least node tag");
  msh_size(in, file.binary, "the greatest node tag");
  if (!in.can_hold(nodes, file.binary ? 32 : 8, "nodes")) return;
  file.mesh.nodes.reserve(nodes);
  file.mesh.node_tags.reserve(nodes);
  for (std::uint64_t b = 0; b < blocks && in.ok(); ++b) {
    const std::int32_t dimension = msh_int(in, file.binary, "the dimension of an entity");
    msh_int(in, file.binary, "the tag of an entity");
    const bool parametric = msh_int(in, file.binary, "the parametric flag") != 0;
    const std::uint64_t count = msh_size(in, file.binary, "the number of nodes of a block");
    if (!in.can_hold(count, file.binary ? 32 : 8, "nodes")) return;
    for (std::uint64_t i = 0; i < count; ++i)
      file.mesh.node_tags.push_back(msh_size(in, file.binary, "a node tag"));
    for (std::uint64_t i = 0; i < count && in.ok(); ++i) {
      file.mesh.nodes.push_back(read_point(in, file.binary));
      for (int d = 0; parametric && d < dimension && d < 3; ++d)
        msh_real(in, file.binary, "a parameter of a node");
    }
  }
  if (in.ok() && file.mesh.nodes.size() != nodes)
    in.fail("$Nodes holds " + std::to_string(file.mesh.nodes.size()) + " nodes, its header says " +
            std::to_string(nodes));
}

void read_msh41_elements(MeshCursor& in, MshFile& file) {
  begin_binary(in, file);
  const std::uint64_t blocks = msh_size(in, file.binary, "the number of element blocks");
  const std::uint64_t elements = msh_size(in, file.binary, "the number of elements");
  msh_size(in, file.binary, "the least element tag");
  msh_size(in, file.binary, "the greatest element tag");
  std::uint64_t seen = 0;
  for (std::uint64_t b = 0; b < blocks && in.ok(); ++b) {
    const std::int32_t dimension = msh_int(in, file.binary, "the dimension of an entity");
    const std::int32_t entity = msh_int(in, file.binary, "the tag of an entity");
    const std::int32_t type = msh_int(in, file.binary, "an element type");
    const std::uint64_t count = msh_size(in, file.binary, "the number of elements of a block");
    const auto corners = static_cast<std::uint64_t>(msh_corners(in, type));
    const std::uint64_t bytes = (file.binary ? 8 : 2) * (corners + 1);
    if (!in.can_hold(count, bytes, "elements")) return;
    seen += count;
    if (!is_msh_tetrahedron(type) && file.binary) {
      in.skip_bytes(count * bytes, "an element");
      continue;
    }
    const std::int64_t group = dimension == 3 ? group_of_volume(file, entity) : 0;
    for (std::uint64_t e = 0; e < count && in.ok(); ++e) {
      const std::uint64_t tag = msh_size(in, file.binary, "an element tag");
      std::array<std::uint64_t, 4> node{};
      for (std::uint64_t c = 0; c < corners; ++c) {
        const std::uint64_t value = msh_size(in, file.binary, "a node of an element");
        if (c < 4) node[c] = value;
      }
      if (is_msh_tetrahedron(type)) add_tet(in, file, tag, node, group, entity, static_cast<int>(corners));
    }
  }
  if (in.ok() && seen != elements)
    in.fail("$Elements holds " + std::to_string(seen) + " elements, its header says " +
            std::to_string(elements));
}

void read_msh22_nodes(MeshCursor& in, MshFile& file) {
  const std::int64_t count = in.integer("the number of nodes", 0, INT32_MAX);
  begin_binary(in, file);
  if (!in.can_hold(static_cast<std::uint64_t>(count), file.binary ? 28 : 8, "nodes")) return;
  file.mesh.nodes.reserve(static_cast<std::size_t>(count));
  file.mesh.node_tags.reserve(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count && in.ok(); ++i) {
    const std::int32_t tag = msh_int(in, file.binary, "a node number");
    if (in.ok() && tag < 0) in.fail("node number " + std::to_string(tag) + " is negative");
    file.mesh.node_tags.push_back(static_cast<std::uint64_t>(tag));
    file.mesh.nodes.push_back(read_point(in, file.binary));
  }
}

void read_msh22_elements(MeshCursor& in, MshFile& file) {
  const std::int64_t count = in.integer("the number of elements", 0, INT32_MAX);
  begin_binary(in, file);
  if (!in.can_hold(static_cast<std::uint64_t>(count), file.binary ? 8 : 6, "elements")) return;
  for (std::int64_t seen = 0; seen < count && in.ok();) {
    if (file.binary) {
      const auto type = in.raw<std::int32_t>("an element type");
      const auto elements = in.raw<std::int32_t>("the number of elements of a block");
      const auto tags = in.raw<std::int32_t>("the number of tags");
      if (in.ok() && (elements < 1 || elements > count - seen || tags < 0))
        in.fail("a block of " + std::to_string(elements) + " elements with " + std::to_string(tags) +
                " tags, " + std::to_string(count - seen) + " elements are left");
      for (std::int32_t e = 0; e < elements && in.ok(); ++e)
        read_msh22_element(in, file, in.raw<std::int32_t>("an element number"), type, tags);
      seen += elements;
    } else {
      const std::int64_t number = in.integer("an element number", 0, INT32_MAX);
      const std::int64_t type = in.integer("an element type", 1, INT32_MAX);
      const std::int64_t tags = in.integer("the number of tags", 0, 1000);
      read_msh22_element(in, file, number, type, tags);
      ++seen;
    }
  }
}

}  // namespace voxtet
