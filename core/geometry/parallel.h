// The one place that knows threads: a loop cut into contiguous parts.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <limits>
#include <system_error>
#include <thread>
#include <vector>

#include "types/run_context.h"

namespace voxtet {

#ifdef VOXTET_MOST_THREADS
constexpr int kMostThreads = VOXTET_MOST_THREADS;  ///< of WebAssembly (cmake/flags.cmake)
#else
constexpr int kMostThreads = std::numeric_limits<int>::max();
#endif

/// Calls body(first, last) for contiguous parts that together make [0, count), one part a thread; the
/// caller's own thread takes the first, and those for which no thread is to be had. `body` must write to
/// places that belong to its indices alone, so that the result is that of body(0, count). An exception of the
/// lowest part that threw is rethrown after all have ended. For `threads` < 2, and in WebAssembly that was
/// built without threads, it is the plain call.
template <class Body>
void parallel_for(int threads, std::size_t count, Body&& body) {
  const std::size_t parts = std::min(count, static_cast<std::size_t>(std::clamp(threads, 1, kMostThreads)));
  if (parts < 2) {
    if (count > 0) body(std::size_t{0}, count);
    return;
  }
  std::vector<std::exception_ptr> failures(parts);
  const auto run = [&](std::size_t part) {
    try {
      body(count * part / parts, count * (part + 1) / parts);
    } catch (...) {
      failures[part] = std::current_exception();
    }
  };
  std::vector<std::thread> others;
  others.reserve(parts - 1);
  std::size_t started = 1;
  try {
    for (; started < parts; ++started)
      others.emplace_back([&run, part = started] {
        is_helper_thread = true;
        run(part);
      });
  } catch (const std::system_error&) {
    for (std::size_t part = started; part < parts; ++part) run(part);
  }
  run(0);
  for (std::thread& other : others) other.join();
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

/// Runs every task once, each on whichever thread is free, the first ones first. No task may write what
/// another one reads or writes.
inline void run_tasks(int threads, const std::vector<std::function<void()>>& tasks) {
  std::atomic<std::size_t> next = 0;
  parallel_for(threads, tasks.size(), [&](std::size_t, std::size_t) {
    for (std::size_t task = next++; task < tasks.size(); task = next++) tasks[task]();
  });
}

/// How many threads are worth asking for on this machine, at least 1.
inline int hardware_threads() {
  return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostThreads);
}

}  // namespace voxtet
