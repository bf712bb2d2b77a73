#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "io/header_text.h"
#include "io/write_mesh.h"

namespace voxtet {
namespace {

Error failure(const std::string& path, const std::string& what) {
  return {ErrorCode::kBadInput, "write_files", path + ": " + what, {}};
}

std::string reason(const char* action) {
  return std::string(action) + ": " + std::strerror(errno);
}

/// Removes the files that it knows of unless told to keep them.
struct Cleanup {
  std::vector<std::string> paths;
  ~Cleanup() {
    for (const std::string& path : paths) std::remove(path.c_str());
  }
};

/// Creates a new file beside `target`, never one that is already there.
std::FILE* create_beside(const std::string& target, std::string& path) {
  for (int attempt = 0; attempt < 100; ++attempt) {
    path = target + ".part" + (attempt == 0 ? "" : std::to_string(attempt));
    if (std::FILE* file = std::fopen(path.c_str(), "wbx")) return file;
    if (errno != EEXIST) return nullptr;
  }
  return nullptr;
}

Status write_temporary(const std::string& target, const Bytes& bytes, Cleanup& temporaries) {
  std::error_code ignored;
  if (std::filesystem::is_directory(target, ignored)) return failure(target, "is a folder, expected a file");
  std::string path;
  std::FILE* file = create_beside(target, path);
  if (file == nullptr) return failure(target, reason("cannot be created"));
  temporaries.paths.push_back(path);
  const bool written =
      std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() && std::fflush(file) == 0;
  const std::string why = written ? "" : reason("cannot be written");
  if (std::fclose(file) != 0 && written) return failure(target, reason("cannot be written"));
  if (!written) return failure(target, why);
  return std::monostate{};
}

}  // namespace

Status write_files(const std::string& path, const std::vector<OutputFile>& files) {
  if (const Result<MeshFormat> format = mesh_format_of(path); !format.ok()) return format.error();
  const std::string base = path.substr(0, path.size() - mesh_ending_of(path).size());
  std::vector<std::string> targets;
  Cleanup temporaries;
  for (const OutputFile& file : files) {
    // The ending that was asked for keeps its case.
    targets.push_back(lower_case(mesh_ending_of(path)) == file.suffix ? path : base + file.suffix);
    if (Status status = write_temporary(targets.back(), file.bytes, temporaries); !status.ok()) return status;
  }
  // A set of which only some files could be put in place is removed: its parts do not belong together.
  Cleanup placed;
  const std::vector<std::string> sources = temporaries.paths;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (std::rename(sources[i].c_str(), targets[i].c_str()) != 0)
      return failure(targets[i], reason("cannot be put in place"));
    placed.paths.push_back(targets[i]);
  }
  temporaries.paths.clear();
  placed.paths.clear();
  return std::monostate{};
}

}  // namespace voxtet
