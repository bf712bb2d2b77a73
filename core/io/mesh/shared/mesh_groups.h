// What the mesh writers share: faces grouped by their two sides, names of groups, and the patient space.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/mesh/shared/mesh_format.h"
#include "types/surface_mesh.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// The distinct pairs of sides, ascending, and the pair of each face.
struct FaceGroups {
  std::vector<Sides> pairs;
  std::vector<std::uint32_t> of_face;
};
FaceGroups group_faces(std::span<const Sides> sides);

/// The distinct labels, ascending, and the place of each element's label among them.
struct LabelGroups {
  std::vector<Label> labels;
  std::vector<std::uint32_t> of_tet;
};
LabelGroups group_tets(std::span<const Label> labels);

/// The members of each group, ascending, from the group of each member.
std::vector<std::vector<std::uint32_t>> group_members(std::span<const std::uint32_t> group_of,
                                                      std::size_t groups);

/// For each of `count` faces the number of its set, from 1, in the order of the sets; 0 where it is in none.
std::vector<std::int32_t> set_numbers(const std::vector<NamedSet>& sets, std::size_t count);
/// What these numbers mean, for the comments of a file: "1 epicardium, 2 base".
std::string set_legend(const std::vector<NamedSet>& sets);

/// One name per label of `labels`, in that order: the name of `infos` without quotes, bars and control
/// characters, cut to 60 bytes; "label 5" where there is none; "name (5)" where two labels share a name, or
/// one has that of the background.
std::vector<std::string> group_names(const std::vector<Label>& labels, const std::vector<LabelInfo>& infos);

/// "LV myocardium|background" from the names that group_names gave.
std::string pair_name(const Sides& pair, const std::vector<Label>& labels,
                      const std::vector<std::string>& names);

/// The name of a label for formats that allow only words: letters, digits and single underscores, a letter
/// first, at most 38 characters. It ends with the label, and so differs from all others even without regard
/// to case: "LV_myocardium_1", "label_7"; "background".
std::string word_name(Label label, const std::vector<LabelInfo>& infos);
/// "LV_myocardium_1__background".
std::string word_name(const Sides& pair, const std::vector<LabelInfo>& infos);

/// A RAS point in the requested space.
inline Eigen::Vector3d in_space(const Eigen::Vector3d& ras, PatientSpace space) {
  // 0 - x and not -x: a coordinate of 0 stays without a sign.
  return space == PatientSpace::kRas ? ras : Eigen::Vector3d(0.0 - ras.x(), 0.0 - ras.y(), ras.z());
}
/// The values of a field in the requested space: vectors, of three components, are turned.
inline std::vector<float> in_space(const Field& field, PatientSpace space) {
  std::vector<float> values = field.values;
  if (space == PatientSpace::kRas || field.components != 3) return values;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (i % 3 != 2) values[i] = 0.0F - values[i];
  return values;
}
inline const char* to_string(PatientSpace space) {
  return space == PatientSpace::kRas ? "RAS" : "LPS";
}

/// Space, unit and axes for the comments of a file, on one line without "--".
std::string coordinates_note(PatientSpace space);

}  // namespace voxtet
