#include "io/mesh/shared/facet_tags.h"

#include "io/mesh/shared/mesh_groups.h"

namespace voxtet {

FacetTags facet_tags(const TetMesh& mesh, const WriteMeshOptions& options) {
  const FaceGroups groups = group_faces(mesh.face_sides);
  const std::vector<Label> labels = group_tets(mesh.labels).labels;
  const std::vector<std::string> label_names = group_names(labels, options.infos);
  FacetTags tags{set_numbers(options.surfaces, mesh.faces.size()), {}};
  for (const Sides& pair : groups.pairs) tags.names.push_back(pair_name(pair, labels, label_names));
  for (const NamedSet& set : options.surfaces) tags.names.push_back(set.name);
  const auto pairs = static_cast<std::int32_t>(groups.pairs.size());
  for (std::size_t f = 0; f < tags.of_face.size(); ++f) {
    std::int32_t& tag = tags.of_face[f];
    tag = tag > 0 ? pairs + tag : static_cast<std::int32_t>(groups.of_face[f] + 1);
  }
  return tags;
}

std::vector<std::string> facet_legend(const FacetTags& tags) {
  std::vector<bool> used(tags.names.size(), false);
  for (const std::int32_t tag : tags.of_face) used[static_cast<std::size_t>(tag - 1)] = true;
  std::vector<std::string> legend;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) legend.push_back(std::to_string(i + 1) + " " + tags.names[i]);
  return legend;
}

std::vector<std::string> label_legend(const TetMesh& mesh, const std::vector<LabelInfo>& infos) {
  const std::vector<Label> labels = group_tets(mesh.labels).labels;
  std::vector<std::string> legend = group_names(labels, infos);
  for (std::size_t i = 0; i < legend.size(); ++i) legend[i] = std::to_string(labels[i]) + " " + legend[i];
  return legend;
}

std::string in_ascii(const std::string& text) {
  std::string ascii;
  bool in_run = false;
  for (const char c : text) {
    const bool plain = static_cast<unsigned char>(c) < 0x80;
    if (plain || !in_run) ascii += plain ? c : '_';
    in_run = !plain;
  }
  return ascii;
}

}  // namespace voxtet
