#include "pipeline/memory.h"

#if defined(__EMSCRIPTEN__)
#include <emscripten/heap.h>
#else
#include <fstream>
#include <string>
#endif

namespace voxtet {

#if defined(__EMSCRIPTEN__)

void reset_peak_memory() {}
double peak_memory_mb() {
  return static_cast<double>(emscripten_get_heap_size()) / 1e6;
}
double memory_space_mb() {
  return 4294.967296;
}

#else

namespace {

/// Of a file of the system's that tells kilobytes by name, in MB; 0 where it does not.
double number_in(const char* path, const char* key) {
  std::ifstream file(path);
  for (std::string word; file >> word;) {
    double kilobytes = 0;
    if (word == key && file >> kilobytes) return kilobytes * 1024 / 1e6;
  }
  return 0;
}

}  // namespace

void reset_peak_memory() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

double peak_memory_mb() {
  return number_in("/proc/self/status", "VmHWM:");
}

double memory_space_mb() {
  return number_in("/proc/meminfo", "MemTotal:");
}

#endif

}  // namespace voxtet
