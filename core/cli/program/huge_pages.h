// Memory in huge pages, where the system grants them to programs that ask (Linux: transparent_hugepage =
// madvise).
#pragma once

#if defined(__linux__)
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>
#endif

namespace voxtet {

/// Starts the program once more with a malloc that asks for huge pages (a page fault then maps 2 MB instead
/// of 4 kB); glibc offers this in no other way. Does nothing if GLIBC_TUNABLES is already set. Call it first.
inline void use_huge_pages([[maybe_unused]] char** argv) {
#if defined(__linux__)
  constexpr const char* kName = "GLIBC_TUNABLES";
  if (std::getenv(kName)) return;
  std::error_code failed;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", failed);
  if (!failed && setenv(kName, "glibc.malloc.hugetlb=1", 0) == 0) execv(self.c_str(), argv);
#endif
}

}  // namespace voxtet
