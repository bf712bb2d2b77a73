// Memory of the process, for reports and forecasts.
#pragma once

namespace voxtet {

/// Starts a new measurement where the system allows it.
void reset_peak_memory();

/// Peak resident memory in MB since reset_peak_memory (Linux); size of the linear memory (wasm); 0 elsewhere.
double peak_memory_mb();

/// The most memory that the process can get, MB: 4295 in wasm, which is all that can be addressed; the
/// machine's memory on Linux; 0 elsewhere, where no bound is known.
double memory_space_mb();

}  // namespace voxtet
