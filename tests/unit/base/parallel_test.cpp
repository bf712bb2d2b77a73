#include "base/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#ifndef __EMSCRIPTEN__
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace voxtet {
namespace {

/// The sum of what `count` loops of 100 indices on these threads visit.
std::size_t visits_of_loops(int threads, int count) {
  std::atomic<std::size_t> visits = 0;
  for (int loop = 0; loop < count; ++loop)
    parallel_for(threads, 100, [&](std::size_t first, std::size_t last) { visits += last - first; });
  return visits;
}

TEST(ParallelFor, VisitsEveryIndexOnce) {
  for (const int threads : {-1, 0, 1, 2, 7})
    for (const std::size_t count : {0U, 1U, 3U, 100U, 50'000U}) {
      std::vector<int> visits(count, 0);
      parallel_for(threads, count, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) ++visits[i];
      });
      EXPECT_EQ(visits, std::vector<int>(count, 1)) << threads;
    }
}

TEST(InStretches, VisitsEveryIndexInOrder) {
  for (const std::size_t first : {0U, 5U})
    for (const std::size_t last : {0U, 5U, 6U, (1U << 14U) + 5U, 50'000U}) {
      std::size_t next = first;
      in_stretches(first, last, [&](std::size_t begin, std::size_t end) {
        EXPECT_EQ(begin, next);
        EXPECT_LT(begin, end);
        next = end;
      });
      EXPECT_EQ(next, std::max(first, last)) << first;
    }
}

TEST(ParallelFor, RethrowsAfterAllPartsHaveEnded) {
  for (const int threads : {1, 3}) {
    std::vector<int> visits(30, 0);
    EXPECT_THROW(parallel_for(threads, visits.size(),
                              [&](std::size_t first, std::size_t last) {
                                for (std::size_t i = first; i < last; ++i) visits[i] = 1;
                                if (last == visits.size()) throw std::runtime_error("last part");
                              }),
                 std::runtime_error);
    EXPECT_EQ(visits, std::vector<int>(30, 1));
  }
}

TEST(ParallelFor, CatchesByTypeOnEveryThread) {
  // In WebAssembly this needs a landing pad for each thread (wasm/landing_pad.h).
  constexpr std::size_t kCount = 20'000;
  std::vector<int> caught(kCount, 0);
  parallel_for(4, kCount, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) try {
        if (i % 3 == 0) throw std::runtime_error("a third");
        if (i % 3 == 1) throw static_cast<int>(i);
        throw static_cast<double>(i);
      } catch (const std::exception&) {
        caught[i] = i % 3 == 0;
      } catch (int value) {
        caught[i] = i % 3 == 1 && value == static_cast<int>(i);
      } catch (double value) {
        caught[i] = i % 3 == 2 && value == static_cast<double>(i);
      }
  });
  EXPECT_EQ(caught, std::vector<int>(kCount, 1));
}

TEST(ParallelFor, OnlyTheCallersThreadCallsBack) {
  const std::thread::id own = std::this_thread::get_id();
  std::atomic<int> asked = 0, told = 0, foreign = 0;
  RunContext ctx;
  ctx.on_cancelled = [&] { return ++asked, foreign += own != std::this_thread::get_id(), true; };
  ctx.on_progress = [&](const std::string&, double) { ++told, foreign += own != std::this_thread::get_id(); };
  for (const int threads : {1, 4}) {
    parallel_for(threads, 40, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        EXPECT_EQ(ctx.cancelled(), own == std::this_thread::get_id());
        ctx.progress("stage", 0.5);
      }
    });
    EXPECT_GE(asked, 10);
    EXPECT_EQ(asked, told);
    EXPECT_EQ(foreign, 0);
  }
}

TEST(ParallelFor, UsesTheSameThreadsAgain) {
  std::mutex mutex;
  std::set<std::thread::id> ids;
  for (int loop = 0; loop < 200; ++loop)
    parallel_for(4, 4, [&](std::size_t, std::size_t) {
      const std::lock_guard lock(mutex);
      ids.insert(std::this_thread::get_id());
    });
  // Loops of other cases may have left more of them.
  EXPECT_LE(ids.size(), 9U);
}

TEST(ParallelFor, RunsInsideOfItself) {
  for (const int threads : {1, 2, 5}) {
    std::vector<int> visits(40, 0);
    parallel_for(threads, 8, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        parallel_for(threads, 5, [&](std::size_t begin, std::size_t end) {
          for (std::size_t j = begin; j < end; ++j) ++visits[5 * i + j];
        });
    });
    EXPECT_EQ(visits, std::vector<int>(40, 1)) << threads;
  }
}

#ifndef __EMSCRIPTEN__
TEST(ParallelFor, ServesSeveralCallersAtOnce) {
  std::vector<std::size_t> visits(4, 0);
  std::vector<std::thread> callers;
  callers.reserve(visits.size());
  for (std::size_t& of_caller : visits)
    callers.emplace_back([&of_caller] { of_caller = visits_of_loops(3, 200); });
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(visits, std::vector<std::size_t>(4, 20'000));
}

// Each of three loops waits for its other part, on a thread that nobody else may hold back.
TEST(ParallelFor, GivesCallersAtOnceThreadsOfTheirOwn) {
  constexpr int kCallers = 3;
  std::atomic<int> parts = 0;
  std::atomic<bool> all_began = true;
  const auto wait_for_all = [&](std::size_t, std::size_t) {
    ++parts;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (parts < 2 * kCallers && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    if (parts < 2 * kCallers) all_began = false;
  };
  std::vector<std::thread> callers;
  callers.reserve(kCallers);
  for (int i = 0; i < kCallers; ++i) callers.emplace_back([&] { parallel_for(2, 2, wait_for_all); });
  for (std::thread& caller : callers) caller.join();
  EXPECT_TRUE(all_began);
}

TEST(ParallelFor, RunsInAChildOfFork) {
  ASSERT_EQ(visits_of_loops(3, 5), 500U);
  const pid_t child = fork();
  if (child == 0) _exit(visits_of_loops(3, 5) == 500 ? 7 : 1);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 7);
  EXPECT_EQ(visits_of_loops(3, 5), 500U);
}
#endif

TEST(RunTasks, RunsEveryTaskOnce) {
  for (const int threads : {0, 1, 2, 9})
    for (const std::size_t count : {0U, 1U, 5U}) {
      std::vector<int> runs(count, 0);
      std::vector<std::function<void()>> tasks;
      tasks.reserve(count);
      for (int& run : runs) tasks.emplace_back([&run] { ++run; });
      run_tasks(threads, tasks);
      EXPECT_EQ(runs, std::vector<int>(count, 1)) << threads;
    }
}

TEST(RunTasks, RethrowsWhatATaskThrew) {
  const std::vector<std::function<void()>> tasks{[] {}, [] { throw std::runtime_error("second"); }, [] {}};
  for (const int threads : {1, 3}) EXPECT_THROW(run_tasks(threads, tasks), std::runtime_error);
}

}  // namespace
}  // namespace voxtet
