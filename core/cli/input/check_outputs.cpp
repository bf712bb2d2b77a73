#include "cli/input/check_outputs.h"

#include <filesystem>

#include "cli/words/option_texts.h"
#include "io/bytes/files.h"
#include "io/mesh/write_mesh.h"

namespace voxtet {
namespace {

namespace fs = std::filesystem;

/// One file under two names, or one name of a file to be. Devices can be written more than once.
bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code failed;
  if (fs::exists(a, failed) && fs::exists(b, failed))
    return fs::is_regular_file(a, failed) && fs::equivalent(a, b, failed);
  const fs::path whole_a = fs::weakly_canonical(a, failed), whole_b = fs::weakly_canonical(b, failed);
  return !whole_a.empty() && whole_a == whole_b;
}

}  // namespace

Status check_no_fibres(const NamedPath& output) {
  const Result<MeshFormat> format = mesh_format_of(output.path);
  if (!format || *format != MeshFormat::kCarp) return std::monostate{};
  const std::string fibres =
      output.path.substr(0, output.path.size() - mesh_ending_of(output.path).size()) + ".lon";
  std::error_code failed;
  if (!fs::exists(fibres, failed)) return std::monostate{};
  return usage_error("cli",
                     output.word + ": " + fibres +
                         " holds the fibres of another mesh, and the one written has none; expected no "
                         "such file (move it away, or give another name)");
}

Status check_outputs(const std::vector<NamedPath>& outputs, const std::vector<NamedPath>& inputs) {
  std::vector<NamedPath> taken;
  for (const NamedPath& input : inputs)
    if (!input.path.empty()) taken.push_back(input);
  for (const NamedPath& output : outputs) {
    if (output.path.empty()) continue;
    if (output.path == kDash)
      return usage_error("cli", output.word + " -: found standard output, expected the name of a file");
    std::vector<NamedPath> own;
    for (const std::string& path : files_of_mesh(output.path)) own.push_back({output.word, path});
    for (const NamedPath& file : own) {
      for (const NamedPath& other : taken)
        if (is_same_file(file.path, other.path))
          return usage_error("cli", file.word + ": " + file.path + " is also the file of " + other.word +
                                        ", expected another one");
      if (Status there = check_place(file.path); !there) return there;
    }
    taken.insert(taken.end(), own.begin(), own.end());
  }
  return std::monostate{};
}

}  // namespace voxtet
