#include "anatomy/check_anatomy.h"

#include <array>
#include <set>
#include <utility>

#include "types/stage_names.h"
#include "walls/wall_grid.h"

namespace voxtet::anatomy {
namespace {

std::string text_of(const std::set<Label>& labels) {
  return list_of({labels.begin(), labels.end()});
}

std::optional<Error> check_held(const std::string& field, const std::vector<Label>& labels,
                                const std::set<Label>& held, const std::string& holder) {
  for (const Label label : labels)
    if (!held.contains(label))
      return anatomy_error(field, std::to_string(label), "labels of the " + holder + ": " + text_of(held));
  return std::nullopt;
}

}  // namespace

Error anatomy_error(const std::string& field, const std::string& found, const std::string& expected) {
  return usage_error(kAnatomyStage,
                     "physics.anatomy." + field + ": found " + found + ", expected " + expected);
}

std::string list_of(const std::vector<Label>& labels) {
  std::string text;
  for (const Label label : labels) text += (text.empty() ? "" : ", ") + std::to_string(label);
  return text;
}

std::optional<Error> check_labels(const TetMesh& mesh, const LabelVolume& image,
                                  const AnatomyParams& params) {
  if (params.wall.empty()) return anatomy_error("wall", "no labels", "those that form the ventricles' wall");
  if (params.lv_pool.empty() && !params.rv_pool.empty())
    return anatomy_error("lv_pool", "no labels beside rv_pool " + list_of(params.rv_pool),
                         "the left pool too, or none of both");
  if (params.lv_pool.size() + params.rv_pool.size() > wall::kMaxInner)
    return anatomy_error("lv_pool", "more than " + std::to_string(wall::kMaxInner) + " labels of both pools",
                         "fewer");
  const std::set<Label> in_mesh(mesh.labels.begin(), mesh.labels.end());
  std::set<Label> in_image(image.labels.begin(), image.labels.end());
  in_image.erase(kBackground);
  if (auto error = check_held("wall", params.wall, in_mesh, "mesh")) return error;
  if (auto error = check_held("lv_pool", params.lv_pool, in_image, "image")) return error;
  if (auto error = check_held("rv_pool", params.rv_pool, in_image, "image")) return error;
  std::set<Label> listed;
  const std::array<std::pair<const char*, const std::vector<Label>*>, 3> lists{
      {{"wall", &params.wall}, {"lv_pool", &params.lv_pool}, {"rv_pool", &params.rv_pool}}};
  for (const auto& [field, labels] : lists)
    for (const Label label : *labels)
      if (!listed.insert(label).second)
        return anatomy_error(field, std::to_string(label) + " for the second time",
                             "every label in one place only");
  return std::nullopt;
}

}  // namespace voxtet::anatomy
