// SPDX-License-Identifier: BSD-3-Clause
#include "support/stepped_tasks.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

namespace {

using carreau::Level;
using carreau::Monitor;
using carreau::SteppedTask;

/// Counts up `steps` steps; every second one, the first among them, is bound. Adds to its own result only.
class Counter final : public SteppedTask {
 public:
  Counter(int steps, int fails_at, bool always_free = false)
      : steps_(steps), fails_at_(fails_at), always_free_(always_free) {}
  [[nodiscard]] bool finished() const override { return done == steps_; }
  [[nodiscard]] bool bound() const override { return !always_free_ && done % 2 == 0; }
  void step(Monitor& monitor) override {
    if (bound() && std::this_thread::get_id() != caller) wrong_thread = true;
    for (int i = 0; i < 2000; ++i) {
      sum = sum * 6364136223846793005U + 1442695040888963407U;
      if (i % 100 == 0) monitor.checkpoint();
    }
    if (done == fails_at_) throw std::runtime_error("step " + std::to_string(done));
    monitor.message(Level::detail, std::to_string(steps_) + "." + std::to_string(done));
    ++done;
  }

  const std::thread::id caller = std::this_thread::get_id();
  int done = 0;
  bool wrong_thread = false;
  std::uint64_t sum = 1;

 private:
  int steps_, fails_at_;
  bool always_free_;
};

class Recorder final : public Monitor {
 public:
  void message(Level, std::string_view text) override { texts.emplace_back(text); }
  std::vector<std::string> texts;
};

struct Trial {
  std::vector<std::unique_ptr<SteppedTask>> tasks;
  std::vector<std::size_t> finished;
  Recorder monitor;
  std::string error;

  explicit Trial(int n, const std::vector<int>& failing = {}, bool always_free = false) {
    for (int i = 0; i < n; ++i) {
      const bool fails = std::find(failing.begin(), failing.end(), i) != failing.end();
      tasks.push_back(std::make_unique<Counter>(3 + i % 7, fails ? 2 : -1, always_free));
    }
  }

  void go(int threads, std::vector<std::size_t> order = {}) {
    const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 8);
    try {
      carreau::run_stepped(
          tasks,
          {.threads = threads, .order = std::move(order), .on_finished = [&](std::size_t i) { finished.push_back(i); }},
          monitor);
    } catch (const std::exception& e) {
      error = e.what();
    }
  }
  Counter& counter(std::size_t i) { return static_cast<Counter&>(*tasks[i]); }
};

TEST(SteppedTasks, AreTheSameInAnyNumberOfThreads) {
  Trial alone(60);
  alone.go(1);
  ASSERT_EQ(alone.error, "");
  ASSERT_EQ(alone.finished.size(), 60U);
  for (const int threads : {2, 3, 8}) {
    Trial run(60);
    std::vector<std::size_t> order;
    for (std::size_t i = 60; i-- > 0;) order.push_back(i);
    run.go(threads, order);
    EXPECT_EQ(run.error, "");
    EXPECT_EQ(run.finished, alone.finished);
    EXPECT_EQ(run.monitor.texts, alone.monitor.texts);
    for (std::size_t i = 0; i < 60; ++i) {
      EXPECT_EQ(run.counter(i).sum, alone.counter(i).sum);
      EXPECT_FALSE(run.counter(i).wrong_thread) << "task " << i;
    }
  }
}

TEST(SteppedTasks, TheFirstFailureIsTheSameInAnyNumberOfThreads) {
  for (const int threads : {1, 2, 8})
    for (int repeat = 0; repeat < 20; ++repeat) {
      Trial run(40, {11, 12, 30});
      run.go(
          threads, threads == 1 ? std::vector<std::size_t>{} : [] {
            std::vector<std::size_t> order;
            for (std::size_t i = 40; i-- > 0;) order.push_back(i);
            return order;
          }());
      EXPECT_EQ(run.error, "step 2");
      ASSERT_EQ(run.finished.size(), 11U);
      for (std::size_t i = 0; i < 11; ++i) EXPECT_EQ(run.finished[i], i);
    }
}

TEST(SteppedTasks, AStopIsObeyed) {
  class Endless final : public SteppedTask {
   public:
    [[nodiscard]] bool finished() const override { return false; }
    [[nodiscard]] bool bound() const override { return false; }
    void step(Monitor& monitor) override {
      for (;;) monitor.checkpoint();
    }
  };
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 8);
  for (const int threads : {1, 4}) {
    std::vector<std::unique_ptr<SteppedTask>> tasks;
    for (int i = 0; i < 6; ++i) tasks.push_back(std::make_unique<Endless>());
    Monitor monitor;
    std::thread other([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      monitor.request_stop();
    });
    EXPECT_THROW(carreau::run_stepped(tasks, {.threads = threads}, monitor), carreau::Cancelled);
    other.join();
  }
}

/// Ends when `others` tasks have: the last ones must run while this one is at work.
class Waiter final : public SteppedTask {
 public:
  explicit Waiter(const std::atomic<int>& ended, int others) : ended_(ended), others_(others) {}
  [[nodiscard]] bool finished() const override { return done_; }
  [[nodiscard]] bool bound() const override { return false; }
  void step(Monitor&) override {
    const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (ended_ < others_ && std::chrono::steady_clock::now() < limit) std::this_thread::yield();
    saw_all = ended_ == others_;
    done_ = true;
  }
  bool saw_all = false;

 private:
  const std::atomic<int>& ended_;
  int others_;
  bool done_ = false;
};

class Adder final : public SteppedTask {
 public:
  explicit Adder(std::atomic<int>& ended) : ended_(ended) {}
  [[nodiscard]] bool finished() const override { return done_; }
  [[nodiscard]] bool bound() const override { return false; }
  void step(Monitor&) override { ++ended_, done_ = true; }

 private:
  std::atomic<int>& ended_;
  bool done_ = false;
};

TEST(SteppedTasks, GoOnWhileOneIsLong) {
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 8);
  constexpr int others = 100;
  std::atomic<int> ended = 0;
  std::vector<std::unique_ptr<SteppedTask>> tasks;
  tasks.push_back(std::make_unique<Waiter>(ended, others));
  for (int i = 0; i < others; ++i) tasks.push_back(std::make_unique<Adder>(ended));
  Monitor monitor;
  carreau::run_stepped(tasks, {.threads = 2}, monitor);
  EXPECT_TRUE(static_cast<Waiter&>(*tasks.front()).saw_all);
}

/// Keeps its thread until it is let go.
class Holder final : public SteppedTask {
 public:
  Holder(std::atomic<int>& held, const std::atomic<bool>& let_go) : held_(held), let_go_(let_go) {}
  [[nodiscard]] bool finished() const override { return done_; }
  [[nodiscard]] bool bound() const override { return false; }
  void step(Monitor&) override {
    const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    ++held_;
    while (!let_go_ && std::chrono::steady_clock::now() < limit) std::this_thread::yield();
    --held_;
    done_ = true;
  }

 private:
  std::atomic<int>& held_;
  const std::atomic<bool>& let_go_;
  bool done_ = false;
};

/// Two that keep two threads, the second one of oneTBB.
struct TwoHeld {
  std::atomic<int> held = 0;
  std::atomic<bool> let_go = false;
  std::vector<std::unique_ptr<SteppedTask>> tasks;
  Monitor monitor;
  std::thread other;

  TwoHeld() {
    for (int i = 0; i < 2; ++i) tasks.push_back(std::make_unique<Holder>(held, let_go));
    other = std::thread([this] { carreau::run_stepped(tasks, {.threads = 2}, monitor); });
    const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (held < 2 && std::chrono::steady_clock::now() < limit) std::this_thread::yield();
  }
  TwoHeld(const TwoHeld&) = delete;
  TwoHeld& operator=(const TwoHeld&) = delete;
  ~TwoHeld() {
    let_go = true;
    other.join();
  }
};

TEST(SteppedTasks, FreeStepsRunElsewhereToo) {
  const tbb::global_control two(tbb::global_control::max_allowed_parallelism, 2);
  const TwoHeld both;
  EXPECT_EQ(both.held, 2);
}

// As on a machine that is busy with other programs: the only thread that could help does not come.
TEST(SteppedTasks, EndWithoutHelpersThatNoThreadHasBegun) {
  const tbb::global_control two(tbb::global_control::max_allowed_parallelism, 2);
  const TwoHeld both;
  Trial run(60, {}, true);
  carreau::run_stepped(run.tasks, {.threads = 2}, run.monitor);
  EXPECT_EQ(both.held, 2);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they need an address space without limit
// oneTBB throws when there is no room for the stack of a thread, after it has taken the task.
TEST(SteppedTasksDeathTest, EndWithoutAddressSpaceForAThread) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto run_without_room = [] {
    alarm(60);
    rlimit room{};
    std::ifstream statm("/proc/self/statm");
    rlim_t pages = 0;
    statm >> pages;
    constexpr rlim_t left = 4 << 20;  // bytes; the stack of a thread takes 8 MB
    room.rlim_cur = room.rlim_max = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + left;
    if (pages == 0 || setrlimit(RLIMIT_AS, &room) != 0) std::exit(0);
    const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 4);
    Trial run(60, {}, false);
    carreau::run_stepped(run.tasks, {.threads = 4}, run.monitor);
    std::exit(0);
  };
  EXPECT_EXIT(run_without_room(), testing::ExitedWithCode(0), "");
}
#endif

TEST(SteppedTasks, NoneAreNothing) {
  Monitor monitor;
  EXPECT_NO_THROW(carreau::run_stepped({}, {.threads = 4}, monitor));
}

TEST(RunEach, CallsEveryIndexOnceAndThrowsTheFirstException) {
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 8);
  for (const int threads : {1, 2, 8})
    for (const std::size_t n : {0U, 1U, 7U, 1000U}) {
      std::vector<int> calls(n, 0);
      Recorder monitor;
      const auto work = [&](std::size_t i, Monitor& of_task) {
        ++calls[i];
        of_task.message(Level::detail, std::to_string(i));
      };
      carreau::run_each(n, false, threads, work, monitor);
      EXPECT_EQ(calls, std::vector<int>(n, 1));
      ASSERT_EQ(monitor.texts.size(), n);
      for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(monitor.texts[i], std::to_string(i));
      const auto failing = [&](std::size_t i, Monitor&) {
        if (i >= 3) throw std::runtime_error(std::to_string(i));
      };
      std::string error;
      try {
        carreau::run_each(n, false, threads, failing, monitor);
      } catch (const std::runtime_error& e) {
        error = e.what();
      }
      EXPECT_EQ(error, n > 3 ? "3" : "");
    }
}

TEST(RunEach, IsOfTheCallingThreadWhenItIsBound) {
  std::vector<std::size_t> seen;
  Monitor monitor;
  const auto caller = std::this_thread::get_id();
  carreau::run_each(
      50, true, 8,
      [&](std::size_t i, Monitor&) {
        EXPECT_EQ(std::this_thread::get_id(), caller);
        seen.push_back(i);
      },
      monitor);
  for (std::size_t i = 0; i < 50; ++i) EXPECT_EQ(seen[i], i);
}

}  // namespace
