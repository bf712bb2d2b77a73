// Peak memory of the process, for reports.
#pragma once

namespace voxtet {

/// Starts a new measurement where the system allows it.
void reset_peak_memory();

/// Peak resident memory in MB since reset_peak_memory (Linux); size of the linear memory (wasm); 0 elsewhere.
double peak_memory_mb();

}  // namespace voxtet
