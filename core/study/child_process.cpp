#include "study/child_process.h"

#ifndef __EMSCRIPTEN__
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#endif

namespace voxtet {

#ifdef __EMSCRIPTEN__

Result<int> start_process(const std::function<int()>&, double) {
  return Error{ErrorCode::kInternal, "study", "there are no processes on WebAssembly", {}};
}
std::optional<ProcessEnd> wait_for_process() {
  return std::nullopt;
}
void relax_memory_limit() {}
std::string name_of_signal(int signal) {
  return "signal " + std::to_string(signal);
}

#else

namespace {

/// Writable memory of its own, in bytes. Only the soft limit, which the process may raise again.
void limit_memory(rlim_t bytes) {
  rlimit limit{};
  if (getrlimit(RLIMIT_DATA, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max == RLIM_INFINITY ? bytes : std::min(bytes, limit.rlim_max);
  setrlimit(RLIMIT_DATA, &limit);
}

}  // namespace

Result<int> start_process(const std::function<int()>& work, double memory_mb) {
  std::signal(SIGCHLD, SIG_DFL);  // where the caller of this program ignores it, no end would be told
  std::fflush(nullptr);           // or both would write it
  const pid_t parent = getpid(), id = fork();
  if (id < 0)
    return Error{ErrorCode::kOutOfMemory,
                 "study",
                 std::string("no process could be started: ") + std::strerror(errno),
                 {}};
  if (id > 0) return static_cast<int>(id);
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
#endif
  if (memory_mb > 0) limit_memory(static_cast<rlim_t>(memory_mb * 1e6));
  const int code = work();
  std::fflush(nullptr);
  _exit(code);
}

std::optional<ProcessEnd> wait_for_process() {
  int status = 0;
  pid_t id = 0;
  do {
    id = wait(&status);
  } while (id < 0 && errno == EINTR);
  if (id < 0) return std::nullopt;
  ProcessEnd end{.id = static_cast<int>(id)};
  if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  return end;
}

void relax_memory_limit() {
  limit_memory(RLIM_INFINITY);
}

std::string name_of_signal(int signal) {
  return "signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
}

#endif

}  // namespace voxtet
