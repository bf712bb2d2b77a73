#include "study/volume_paths.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

namespace voxtet {
namespace {

namespace fs = std::filesystem;

bool is_utf8(const std::string& text) {
  try {
    (void)nlohmann::json(text).dump();
    return true;
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

/// Whether a name is as a pattern says: * stands for any text, ? for one character.
bool fits(std::string_view name, std::string_view pattern) {
  if (pattern.empty()) return name.empty();
  if (pattern[0] == '*')
    return fits(name, pattern.substr(1)) || (!name.empty() && fits(name.substr(1), pattern));
  return !name.empty() && (pattern[0] == '?' || pattern[0] == name[0]) &&
         fits(name.substr(1), pattern.substr(1));
}

/// The paths from `base` on that begin with `start` and go on as the parts of a pattern say; sorted. Names
/// that begin with a dot only where the pattern does. A path without * and ? need not be there.
std::vector<fs::path> paths_like(const fs::path& base, const fs::path& start, fs::path::const_iterator part,
                                 fs::path::const_iterator end) {
  if (part == end) return {start};
  const std::string pattern = part->string();
  ++part;
  if (pattern.find_first_of("*?") == std::string::npos) return paths_like(base, start / pattern, part, end);
  std::vector<fs::path> names, found;
  std::error_code failed;
  const fs::path folder = base / start;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder, failed)) {
    const std::string name = entry.path().filename().string();
    if (fits(name, pattern) && (name[0] != '.' || pattern[0] == '.')) names.emplace_back(name);
  }
  std::sort(names.begin(), names.end());
  for (const fs::path& name : names)
    for (fs::path& path : paths_like(base, start / name, part, end))
      if (fs::exists(base / path, failed)) found.push_back(std::move(path));
  return found;
}

}  // namespace

Result<std::vector<std::string>> volumes_like(const std::string& folder, const std::string& text) {
  const auto bad = [](const std::string& what) { return Error{ErrorCode::kBadInput, "study", what, {}}; };
  const fs::path pattern = text;
  std::vector<std::string> found;
  for (const fs::path& path : paths_like(folder, {}, pattern.begin(), pattern.end())) {
    found.push_back(path.string());
    if (!is_utf8(found.back()))
      return bad("volumes: found " +
                 nlohmann::json(found.back()).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) +
                 ", a name that is no UTF-8; expected one that is");
  }
  if (found.empty()) return bad("volumes: found no file " + text + ", expected some");
  return found;
}

}  // namespace voxtet
