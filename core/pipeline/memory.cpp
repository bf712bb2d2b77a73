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

#else

void reset_peak_memory() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

double peak_memory_mb() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kilobytes = 0;
    if (word == "VmHWM:" && status >> kilobytes) return kilobytes * 1024 / 1e6;
  }
  return 0;
}

#endif

}  // namespace voxtet
