#include "io/files.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace voxtet {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 20;

Error failure(const std::string& path, const std::string& what) {
  return {ErrorCode::kBadInput, "files", path + ": " + what, {}};
}

Error failure_with_reason(const std::string& path, const std::string& what) {
  return failure(path, what + ": " + std::strerror(errno));
}

bool is_folder(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored);
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

Status write_temporary(const TargetFile& target, Cleanup& temporaries) {
  if (is_folder(target.path)) return failure(target.path, "is a folder, expected a file");
  std::string path;
  std::FILE* file = create_beside(target.path, path);
  if (file == nullptr) return failure_with_reason(target.path, "cannot be created");
  temporaries.paths.push_back(path);
  const bool written =
      std::fwrite(target.bytes.data(), 1, target.bytes.size(), file) == target.bytes.size() &&
      std::fflush(file) == 0;
  const Error broken = failure_with_reason(target.path, "cannot be written");
  if (std::fclose(file) != 0 && written) return failure_with_reason(target.path, "cannot be written");
  if (!written) return broken;
  return std::monostate{};
}

}  // namespace

Result<Bytes> read_file(const std::string& path) {
  if (is_folder(path)) return failure(path, "is a folder, expected a file");
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (!file) return failure_with_reason(path, "cannot be opened");
  Bytes bytes;
  std::size_t got = 0;
  do {
    const std::size_t start = bytes.size();
    bytes.resize(start + kChunk);
    got = std::fread(bytes.data() + start, 1, kChunk, file);
    bytes.resize(start + got);
  } while (got > 0);
  const bool broken = std::ferror(file) != 0;
  std::fclose(file);
  if (broken) return failure_with_reason(path, "cannot be read");
  return bytes;
}

Status place_files(const std::vector<TargetFile>& files) {
  Cleanup temporaries, placed;
  for (const TargetFile& file : files)
    if (Status status = write_temporary(file, temporaries); !status) return status;
  // A set of which only some files could be put in place is removed: its parts do not belong together.
  const std::vector<std::string> sources = temporaries.paths;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (std::rename(sources[i].c_str(), files[i].path.c_str()) != 0)
      return failure_with_reason(files[i].path, "cannot be put in place");
    placed.paths.push_back(files[i].path);
  }
  temporaries.paths.clear();
  placed.paths.clear();
  return std::monostate{};
}

Status write_text_file(const std::string& path, const std::string& text) {
  return place_files({{path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}}});
}

}  // namespace voxtet
