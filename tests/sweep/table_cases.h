// The four volumes of the paper's first table as cases: conforming, merged, and one graded.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "io/volume/read_volume.h"
#include "sweep/load_labels.h"

namespace voxtet::sweep {

struct TableCase {
  const char* file;
  std::vector<Label> labels;
  bool merge = false;
  std::vector<LabelSize> sizes{};  ///< instead of twice the smallest spacing
  bool clean = false;              ///< as the command line's --clean
};

inline std::vector<TableCase> table_cases() {
  std::vector<TableCase> cases;
  for (const auto& [file, labels] : {std::pair{"biv_mean_1mm.nii.gz", std::vector<Label>{1, 2}},
                                     std::pair{"biv_ed_scar_1mm.nii.gz", std::vector<Label>{1, 2, 5, 6}},
                                     std::pair{"biv_es_oblique_sax.nii.gz", std::vector<Label>{1, 2}},
                                     std::pair{"ct_aorta_dissection_1.5mm.nii.gz", std::vector<Label>{1, 2}}})
    for (const bool merge : {false, true}) cases.push_back({file, labels, merge});
  cases.push_back({"biv_ed_scar_1mm.nii.gz", {1, 2, 5, 6}, false, {{5, 0.8}, {6, 0.8}}});
  return cases;
}

inline std::string name_of(const TableCase& c, const std::string& method) {
  return std::string(c.file).substr(0, std::string(c.file).find(".nii")) +
         (c.merge ? ", merged" : ", conforming") + (c.sizes.empty() ? "" : ", graded") + ", " + method;
}

/// Loads the case's volume from `path` and sets its recipe.
inline Status open_case(const TableCase& c, const std::string& path, const std::string& method,
                        Session& session) {
  const Result<LabelVolume> volume = read_volume_file(path);
  if (!volume) return volume.error();
  if (Status loaded = load_labels(*volume, session); !loaded) return loaded;
  Result<Recipe> recipe = with_field(session.recipe(), "remesh.method", method);
  if (!recipe) return recipe.error();
  recipe->remesh.keep_topology = KeepTopology::kNothing;  // each method on its own
  recipe->labels = c.labels;
  if (c.merge) recipe->merge = {c.labels};
  recipe->sizing.edge_mm = 2 * volume->smallest_spacing_mm();
  recipe->sizing.labels = c.sizes;
  if (c.clean) {
    nlohmann::json cleaned = recipe_to_json(*recipe);
    cleaned.merge_patch(cleaning_preset());
    recipe = parse_recipe(cleaned);
    if (!recipe) return recipe.error();
  }
  return session.set_recipe(*recipe);
}

}  // namespace voxtet::sweep
