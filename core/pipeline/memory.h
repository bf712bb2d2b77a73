// Memory of the process, for reports and forecasts.
#pragma once

namespace voxtet {

/// Starts a new measurement where the system allows it.
void reset_peak_memory();

/// Peak resident memory in MB since reset_peak_memory (Linux); size of the linear memory (wasm); 0 elsewhere.
double peak_memory_mb();

/// MB that can be had at most: 4295, which can be addressed, in wasm; the machine's memory (Linux); 0, for no
/// bound that is known, elsewhere.
double memory_space_mb();

}  // namespace voxtet
