#include "io/bytes/files.h"

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

/// Where a file is put: behind links, as others look for it there.
std::string behind_links(const std::string& path) {
  std::error_code failed;
  if (!std::filesystem::is_symlink(path, failed)) return path;
  const std::filesystem::path target = std::filesystem::weakly_canonical(path, failed);
  return failed ? path : target.string();
}

/// Whether something is there that is neither a file nor a folder, as /dev/stdout: it is written into, never
/// replaced.
bool is_device(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::file_type type = std::filesystem::status(path, ignored).type();
  using enum std::filesystem::file_type;
  return type != not_found && type != none && type != regular && type != directory;
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

/// Writes an opened file and closes it.
Status write_whole(const TargetFile& target, std::FILE* file) {
  const bool written =
      std::fwrite(target.bytes.data(), 1, target.bytes.size(), file) == target.bytes.size() &&
      std::fflush(file) == 0;
  const Error broken = failure_with_reason(target.path, "cannot be written");
  if (std::fclose(file) != 0 && written) return failure_with_reason(target.path, "cannot be written");
  if (!written) return broken;
  return std::monostate{};
}

/// Creates the temporary file beside a target, and remembers it.
Result<std::FILE*> create_temporary(const std::string& target, Cleanup& temporaries) {
  if (is_folder(target)) return failure(target, "is a folder, expected a file");
  std::string path;
  std::FILE* file = create_beside(target, path);
  if (file == nullptr) return failure_with_reason(target, "cannot be created");
  temporaries.paths.push_back(path);
  return file;
}

Status write_device(const TargetFile& target) {
  std::FILE* file = std::fopen(target.path.c_str(), "wb");
  if (file == nullptr) return failure_with_reason(target.path, "cannot be opened");
  return write_whole(target, file);
}

/// What is left in an opened file.
Result<Bytes> read_whole(const std::string& path, std::FILE* file) {
  Bytes bytes;
  std::size_t got = 0;
  do {
    const std::size_t start = bytes.size();
    bytes.resize(start + kChunk);
    got = std::fread(bytes.data() + start, 1, kChunk, file);
    bytes.resize(start + got);
  } while (got > 0);
  if (std::ferror(file) != 0) return failure_with_reason(path, "cannot be read");
  return bytes;
}

}  // namespace

Result<Bytes> read_file(const std::string& path) {
  if (is_folder(path)) return failure(path, "is a folder, expected a file");
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (!file) return failure_with_reason(path, "cannot be opened");
  Result<Bytes> bytes = read_whole(path, file);
  std::fclose(file);
  return bytes;
}

Result<Bytes> read_standard_input() {
  return read_whole("standard input", stdin);
}

Status write_standard_output(std::span<const std::uint8_t> bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0)
    return failure_with_reason("standard output", "cannot be written");
  return std::monostate{};
}

Status place_files(const std::vector<TargetFile>& files) {
  Cleanup temporaries, placed;
  std::vector<std::string> targets;
  for (const TargetFile& file : files) {
    if (is_device(file.path)) {
      if (Status status = write_device(file); !status) return status;
      continue;
    }
    targets.push_back(behind_links(file.path));
    Result<std::FILE*> temporary = create_temporary(targets.back(), temporaries);
    if (!temporary) return temporary.error();
    if (Status status = write_whole(file, *temporary); !status) return status;
  }
  // A set of which only some files could be put in place is removed: its parts do not belong together.
  const std::vector<std::string> sources = temporaries.paths;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (std::rename(sources[i].c_str(), targets[i].c_str()) != 0)
      return failure_with_reason(targets[i], "cannot be put in place");
    placed.paths.push_back(targets[i]);
  }
  temporaries.paths.clear();
  placed.paths.clear();
  return std::monostate{};
}

Status check_place(const std::string& path) {
  if (is_device(path)) return std::monostate{};
  Cleanup temporaries;
  Result<std::FILE*> temporary = create_temporary(behind_links(path), temporaries);
  if (!temporary) return temporary.error();
  std::fclose(*temporary);
  return std::monostate{};
}

Status write_text_file(const std::string& path, const std::string& text) {
  return place_files({{path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}}});
}

}  // namespace voxtet
