#include "base/parallel.h"

#include <condition_variable>
#include <mutex>
#include <system_error>

#ifndef __EMSCRIPTEN__
#include <pthread.h>
#endif

namespace voxtet {
namespace {

/// How often a thread that waits looks before it sleeps: some tens of microseconds, what it takes to wake
/// one.
constexpr int kLooks = 100;

template <class Condition>
void look_for(const Condition& condition) {
  for (int look = 0; look < kLooks && !condition(); ++look) std::this_thread::yield();
}

/// A call of run_parts whose parts are taken in order.
struct Loop {
  const std::function<void(std::size_t)>& run;
  std::size_t parts;
  std::size_t next = 1;
  std::atomic<std::size_t> running = 0;  ///< parts that workers have begun and not ended
};

/// The threads that all callers share: as many as all loops at once had use for so far, without loops inside
/// of a worker's part.
class Workers {
 public:
  void run(Loop& loop) {
    const std::size_t wanted = is_helper_thread ? 0 : loop.parts - 1;
    post(loop, wanted);
    loop.run(0);
    std::unique_lock lock(mutex_);
    while (loop.next < loop.parts) run_next(loop, lock);
    lock.unlock();
    look_for([&loop] { return loop.running == 0; });
    lock.lock();
    ended_.wait(lock, [&loop] { return loop.running == 0; });
    wanted_ -= wanted;
  }

 private:
  void post(Loop& loop, std::size_t wanted) {
    {
      const std::lock_guard lock(mutex_);
      wanted_ += wanted;
      while (may_start_ && workers_ < wanted_) start_worker();
      loops_.push_back(&loop);
      ++posted_;
    }
    for (std::size_t part = 1; part < loop.parts; ++part) wake_.notify_one();
  }

  void start_worker() {
    try {
      std::thread([this] { work(); }).detach();
      ++workers_;
    } catch (const std::system_error&) {
      may_start_ = false;
    }
  }

  void run_next(Loop& loop, std::unique_lock<std::mutex>& lock) {
    const std::size_t part = loop.next++;
    if (loop.next == loop.parts) std::erase(loops_, &loop);
    lock.unlock();
    loop.run(part);
    lock.lock();
  }

  void work() {
    is_helper_thread = true;
    for (std::unique_lock lock(mutex_);;) {
      while (!loops_.empty()) {
        Loop& loop = *loops_.front();
        ++loop.running;
        run_next(loop, lock);
        if (--loop.running == 0) ended_.notify_all();
      }
      lock.unlock();
      look_for([this, seen = posted_.load()] { return posted_ != seen; });
      lock.lock();
      wake_.wait(lock, [this] { return !loops_.empty(); });
    }
  }

  std::mutex mutex_;
  std::condition_variable wake_, ended_;
  std::vector<Loop*> loops_;  ///< those with parts that nobody has begun
  std::atomic<std::size_t> posted_ = 0;
  std::size_t workers_ = 0, wanted_ = 0;
  bool may_start_ = true;
};

/// Never destroyed: its threads sleep in it until the process ends. A child of fork() has none of them.
Workers*& workers() {
  static Workers* all = [] {
#ifndef __EMSCRIPTEN__
    pthread_atfork(nullptr, nullptr, [] { workers() = new Workers; });
#endif
    return new Workers;
  }();
  return all;
}

}  // namespace

void run_parts(std::size_t parts, const std::function<void(std::size_t)>& run) {
  if (parts < 2) {
    run(0);
    return;
  }
  Loop loop{.run = run, .parts = parts};
  workers()->run(loop);
}

}  // namespace voxtet
