// Work in a process of its own, which may die without harm.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "types/result.h"

namespace voxtet {

/// WebAssembly has no processes but its own.
#ifdef __EMSCRIPTEN__
inline constexpr bool kHasProcesses = false;
#else
inline constexpr bool kHasProcesses = true;
#endif

/// How a process ended.
struct ProcessEnd {
  int id = 0;
  int exit_code = 0;
  int signal = 0;  ///< that ended it; 0: none
};

/// Starts `work` in a copy of this process and returns its id; what `work` returns is its exit code. It ends
/// with its parent. `memory_mb` > 0: it gets no more memory for data than that. Errors: kOutOfMemory with the
/// system's reason.
Result<int> start_process(const std::function<int()>& work, double memory_mb);

/// Waits for the next of them to end; nullopt if there is none.
std::optional<ProcessEnd> wait_for_process();

/// Lets this process, whose memory was limited, take a little more, to say so.
void relax_memory_limit();

/// "signal 9 (Killed)"
std::string name_of_signal(int signal);

}  // namespace voxtet
