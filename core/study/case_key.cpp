#include "study/case_key.h"

#include <nlohmann/json.hpp>

#include "base/digest.h"
#include "pipeline/case_files.h"
#include "pipeline/version/engine_version.h"

namespace voxtet {

const std::string& CaseKeys::digest_of_file(const std::string& path, const std::string& how,
                                            const Load& load) {
  const auto [entry, is_new] = files_.try_emplace(how + " " + path);
  if (!is_new) return entry->second;
  Sha256 sha;
  const auto add = [&sha](const std::string& name, const Result<Bytes>& bytes) {
    sha.update(name + " " + (bytes ? std::to_string(bytes->size()) : "none") + "\n");
    if (bytes) sha.update(*bytes);
  };
  const Result<Bytes> bytes = read_case_bytes(path);
  VolumeFile file = file_at(path, {});
  add(file.name, bytes);
  if (bytes) {
    file.bytes = *bytes;
    file.sibling = [&add, beside = file.sibling](const std::string& name) {
      Result<Bytes> sibling = beside(name);
      add(name, sibling);
      return sibling;
    };
    Session session(0);
    load(session, file);  // what it makes of the file does not matter here
  }
  return entry->second = sha.hex();
}

std::string CaseKeys::of(const StudyCase& one) {
  const nlohmann::json recipe = recipe_to_json(one.recipe, true);
  Sha256 sha;
  sha.update("study 1\n" + engine_version() + "\n" + physics_version() + "\n" + recipe.dump() + "\n");
  for (const Stage stage : plan_.stages) sha.update(name_of(stage) + "\n");
  for (const std::string& ending : plan_.keep) sha.update("keep " + ending + "\n");
  if (!one.volume_path.empty()) {
    const ReadOptions& read = one.recipe.source.read;
    const auto load = [&](Session& session, const VolumeFile& file) {
      return session.load_volume(file, read);
    };
    sha.update(digest_of_file(one.volume_path, recipe["source"].dump(), load));
  }
  const auto [masks, images] = side_paths(one.recipe, plan_.folder);
  for (const std::string& path : masks)
    sha.update(
        digest_of_file(path, "mask", [](Session& s, const VolumeFile& file) { return s.load_mask(file); }));
  for (const std::string& path : images)
    sha.update(digest_of_file(path, "image",
                              [](Session& s, const VolumeFile& file) { return s.load_size_image(file); }));
  return sha.hex();
}

}  // namespace voxtet
