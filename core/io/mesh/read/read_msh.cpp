#include "io/mesh/read/read_msh.h"

#include <algorithm>

#include "io/bytes/header_text.h"
#include "io/mesh/read/msh_parts.h"
#include "io/mesh/read/shared/found_labels.h"

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

/// Whether the labels are geometric entities: those are taken where no tetrahedron is in a physical group.
bool choose_labels(MeshCursor& in, MshFile& file, const std::string& label_array) {
  constexpr const char *kPhysical = "gmsh:physical", *kGeometrical = "gmsh:geometrical";
  if (!label_array.empty() && label_array != kPhysical && label_array != kGeometrical)
    in.fail("no array " + in_quotes(label_array) + " of labels, expected " + kPhysical + " or " +
            kGeometrical);
  const std::vector<std::int64_t>& groups = file.mesh.labels;
  const bool grouped =
      std::any_of(groups.begin(), groups.end(), [](std::int64_t group) { return group != 0; });
  const bool geometric = label_array == kGeometrical || (label_array.empty() && !grouped);
  if (geometric) file.mesh.labels = file.entities;
  return geometric;
}

}  // namespace

Result<TetMesh> read_msh(const VolumeFile& volume_file, MeshArrays* arrays, const std::string& label_array) {
  MeshCursor in(volume_file.bytes, volume_file.name, "read_msh");
  MshFile file;
  in.expect("$MeshFormat");
  read_format(in, file);
  while (in.ok() && !in.at_end()) read_section(in, file, in.word("a section"));
  const bool geometric = choose_labels(in, file, label_array);
  TetMesh mesh = in.ok() ? assemble(in, file.mesh) : TetMesh{};
  if (geometric && label_array.empty())
    add_note(arrays, "no physical groups of volumes: the labels are the tags of geometric entities");
  set_labels(in, mesh, file.mesh.labels, geometric ? "geometric entity" : "physical group", arrays);
  keep_corners(mesh, file.mesh.curved, arrays);
  if (arrays && !geometric) arrays->infos = std::move(file.infos);
  return finish_mesh(in, std::move(mesh), file.lps);
}

}  // namespace voxtet
