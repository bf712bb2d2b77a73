// The one place that knows threads: a loop cut into contiguous parts.
#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <vector>
#ifndef __EMSCRIPTEN__
#include <thread>
#endif

namespace voxtet {

/// Calls body(first, last) for contiguous parts that together make [0, count), one part a thread; the
/// caller's own thread takes the first. `body` must write to places that belong to its indices alone, so that
/// the result is that of body(0, count). An exception of the lowest part that threw is rethrown after all
/// have ended. WebAssembly has one thread: there, and for `threads` < 2, it is the plain call.
template <class Body>
void parallel_for(int threads, std::size_t count, Body&& body) {
#ifdef __EMSCRIPTEN__
  threads = 1;
#endif
  const std::size_t parts = std::min(count, static_cast<std::size_t>(std::max(threads, 1)));
  if (parts < 2) {
    if (count > 0) body(std::size_t{0}, count);
    return;
  }
#ifndef __EMSCRIPTEN__
  std::vector<std::exception_ptr> failures(parts);
  const auto run = [&](std::size_t part) {
    try {
      body(count * part / parts, count * (part + 1) / parts);
    } catch (...) {
      failures[part] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    others.reserve(parts - 1);
    for (std::size_t part = 1; part < parts; ++part) others.emplace_back(run, part);
    run(0);
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
#endif
}

/// How many threads are worth asking for on this machine, at least 1.
inline int hardware_threads() {
#ifdef __EMSCRIPTEN__
  return 1;
#else
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
#endif
}

}  // namespace voxtet
