// Where the real label volumes stand: $VOXTET_DATA, or ../shared/data from the project's root.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace voxtet::test {

/// Full path of a shared data file, or empty where the folder is absent (then: GTEST_SKIP and say so).
inline std::string shared_data(const std::string& name) {
  const char* set = std::getenv("VOXTET_DATA");
  const std::filesystem::path root =
      set ? set : std::filesystem::path(VOXTET_SOURCE_DIR) / ".." / "shared" / "data";
  const std::filesystem::path file = root / name;
  std::error_code ec;
  return std::filesystem::exists(file, ec) ? file.string() : std::string{};
}

}  // namespace voxtet::test
