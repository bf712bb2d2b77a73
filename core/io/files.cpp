#include "io/files.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace voxtet {
namespace {

Error failed(const std::string& path, const std::string& what) {
  return {ErrorCode::kBadInput, "files", path + ": " + what + ": " + std::strerror(errno), {}};
}

}  // namespace

Result<Bytes> read_file(const std::string& path) {
  std::error_code ec;
  if (std::filesystem::is_directory(path, ec))
    return Error{ErrorCode::kBadInput, "files", path + ": is a folder, expected a file", {}};
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (!file) return failed(path, "cannot be opened");
  Bytes bytes;
  std::size_t got = 0;
  do {
    const std::size_t start = bytes.size();
    bytes.resize(start + (std::size_t{1} << 20));
    got = std::fread(bytes.data() + start, 1, std::size_t{1} << 20, file);
    bytes.resize(start + got);
  } while (got > 0);
  const bool broken = std::ferror(file) != 0;
  std::fclose(file);
  if (broken) return failed(path, "cannot be read");
  return bytes;
}

Status write_file(const std::string& path, const void* data, std::size_t size) {
  const std::string temporary = path + ".part";
  std::FILE* file = std::fopen(temporary.c_str(), "wb");
  if (!file) return failed(path, "cannot be written");
  const bool written = std::fwrite(data, 1, size, file) == size;
  const bool closed = std::fclose(file) == 0;
  if (!written || !closed || std::rename(temporary.c_str(), path.c_str()) != 0) {
    const Error error = failed(path, "cannot be written");
    std::remove(temporary.c_str());
    return error;
  }
  return std::monostate{};
}

Status write_file(const std::string& path, const std::string& text) {
  return write_file(path, text.data(), text.size());
}

}  // namespace voxtet
