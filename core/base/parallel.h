// Loops on threads, which only parallel.cpp starts. A loop is cut into contiguous parts, one per thread, and
// each part into stretches.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <limits>
#include <thread>
#include <type_traits>
#include <vector>

#include "types/run_context.h"

namespace voxtet {

#ifdef VOXTET_MOST_THREADS
constexpr int kMostThreads = VOXTET_MOST_THREADS;  ///< set for WebAssembly (cmake/flags.cmake)
#else
constexpr int kMostThreads = std::numeric_limits<int>::max();
#endif

#ifdef __EMSCRIPTEN__
/// One call of `body`, which neither compiler nor linker (cmake/flags.cmake) may inline. `body` is copied so
/// that its captures need not be read again after each write to memory.
template <class Body>
[[gnu::noinline]] void run_stretch(const Body& body, std::size_t first, std::size_t last) {
  static_assert(std::is_trivially_copyable_v<Body>);
  const Body own = body;
  own(first, last);
}
#endif

/// Calls body(first, last) for stretches that together make [first, last), one after the other. A WebAssembly
/// engine switches to optimised code only when a function is called: a long loop in a single call would run
/// at half the speed to its end. Native builds make one plain call.
template <class Body>
void in_stretches(std::size_t first, std::size_t last, Body&& body) {
#ifdef __EMSCRIPTEN__
  constexpr std::size_t kStretch = 1U << 14U;
  for (; first < last; first += std::min(kStretch, last - first))
    run_stretch(body, first, first + std::min(kStretch, last - first));
#else
  if (first < last) body(first, last);
#endif
}

/// Calls visit(i) for each i in [first, last), in stretches.
template <class Visit>
void for_indices(std::size_t first, std::size_t last, Visit&& visit) {
  in_stretches(first, last, [visit](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) visit(i);
  });
}

/// Calls run(part) once for each part below `parts`, at least 1, and returns after the last has ended. The
/// caller's thread runs part 0, and then those that no other thread has begun. The other threads are kept
/// from call to call, asleep while there is nothing to do; all callers share them, parts may call this again,
/// and a child of fork() starts its own. `run` must not throw.
void run_parts(std::size_t parts, const std::function<void(std::size_t)>& run);

/// Cuts [0, count) into contiguous parts, one per thread, and calls body(first, last) for the stretches of
/// each, the first part on the caller's thread. `body` must write only to places that belong to its own
/// indices, so that the result is that of body(0, count). If parts throw, the exception of the lowest such
/// part is rethrown after all have ended. For `threads` < 2, and in WebAssembly built without threads, there
/// is one part.
template <class Body>
void parallel_for(int threads, std::size_t count, Body&& body) {
  const std::size_t parts = std::min(count, static_cast<std::size_t>(std::clamp(threads, 1, kMostThreads)));
  if (parts < 2) {
    in_stretches(0, count, body);
    return;
  }
  std::vector<std::exception_ptr> failures(parts);
  const auto run = [&](std::size_t part) {
    try {
      in_stretches(count * part / parts, count * (part + 1) / parts, body);
    } catch (...) {
      failures[part] = std::current_exception();
    }
  };
  run_parts(parts, std::ref(run));
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

/// Calls task(i, own) once for each i below `count`, each on whichever thread is free, the first ones first.
/// `own` is what make_own() returned on that thread. No task may write what another one reads or writes.
template <class MakeOwn, class Task>
void run_tasks_with(int threads, std::size_t count, const MakeOwn& make_own, const Task& task) {
  std::atomic<std::size_t> next = 0;
  parallel_for(threads, count, [&](std::size_t, std::size_t) {
    auto own = make_own();
    for (std::size_t i = next++; i < count; i = next++) task(i, own);
  });
}

/// The same with one of `owns` for each thread; so many threads at most.
template <class Own, class Task>
void run_tasks_with(std::vector<Own>& owns, std::size_t count, const Task& task) {
  std::atomic<std::size_t> next = 0;
  const std::size_t threads = std::min(owns.size(), count);
  parallel_for(static_cast<int>(threads), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t own = first; own < last; ++own)
      for (std::size_t i = next++; i < count; i = next++) task(i, owns[own]);
  });
}

/// The same where a task needs nothing of its own.
template <class Task>
void run_tasks(int threads, std::size_t count, const Task& task) {
  run_tasks_with(
      threads, count, [] { return 0; }, [&task](std::size_t i, int) { task(i); });
}

/// The same for tasks that have nothing in common.
inline void run_tasks(int threads, const std::vector<std::function<void()>>& tasks) {
  run_tasks(threads, tasks.size(), [&tasks](std::size_t i) { tasks[i](); });
}

/// How many threads are worth asking for on this machine, at least 1.
inline int hardware_threads() {
  return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostThreads);
}

}  // namespace voxtet
