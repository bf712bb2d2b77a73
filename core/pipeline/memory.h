// Memory of the process, for reports and forecasts.
#pragma once

namespace voxtet {

/// Starts a new measurement where the system allows it.
void reset_peak_memory();

/// Peak resident memory in MB since reset_peak_memory (Linux); size of the linear memory (wasm); 0 elsewhere.
double peak_memory_mb();

/// MB that the process can address at most: 4295 in wasm, 0 (no bound worth a word) with 64 bits.
constexpr double memory_space_mb() {
  return sizeof(void*) == 4 ? 4294.967296 : 0;
}

}  // namespace voxtet
