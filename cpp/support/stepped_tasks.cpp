// SPDX-License-Identifier: BSD-3-Clause
#include "support/stepped_tasks.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <numeric>
#include <string>
#include <utility>

#include "support/threads/helpers.h"

namespace carreau {
namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);

/// Keeps the messages of a task until its turn has come; stops the task when the run stops, or when one before it has
/// failed.
class TaskMonitor final : public Monitor {
 public:
  TaskMonitor(std::size_t rank, Monitor& of_run, const std::atomic<std::size_t>& first_failed)
      : rank_(rank), of_run_(of_run), first_failed_(first_failed) {}

  void message(Level level, std::string_view text) override { messages_.emplace_back(level, text); }
  void checkpoint() override {
    of_run_.checkpoint();
    if (rank_ > first_failed_.load(std::memory_order_relaxed)) throw Cancelled("a task before this one has failed");
  }
  void deliver() {
    for (const auto& [level, text] : messages_) of_run_.message(level, text);
    messages_.clear();
  }

 private:
  std::size_t rank_;
  Monitor& of_run_;
  const std::atomic<std::size_t>& first_failed_;
  std::vector<std::pair<Level, std::string>> messages_;
};

void run_alone(std::span<const std::unique_ptr<SteppedTask>> tasks, const SteppedRun& run, Monitor& monitor) {
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    while (!tasks[i]->finished()) {
      monitor.checkpoint();
      tasks[i]->step(monitor);
    }
    if (run.on_finished) run.on_finished(i);
  }
}

/// Lets as many helpers into a run as it may have. A helper that arrives after the run finds the gate closed, and the run
/// never waits for an absent helper. Without memory oneTBB may fail to start a helper that it has taken, or start it although it has thrown.
class Gate {
 public:
  explicit Gate(int helpers) : helpers_(helpers) {}
  [[nodiscard]] bool enter() {
    const std::scoped_lock lock(mutex_);
    const bool open = !closed_ && inside_ < helpers_;
    if (open) ++inside_;
    return open;
  }
  void leave() {
    const std::scoped_lock lock(mutex_);
    --inside_;
    left_.notify_all();
  }
  /// Waits until all have left.
  void close() {
    std::unique_lock lock(mutex_);
    closed_ = true;
    left_.wait(lock, [this] { return inside_ == 0; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable left_;
  int helpers_;
  int inside_ = 0;
  bool closed_ = false;
};

/// The calling thread runs bound steps first, so that others never wait for it longer than one step; without any it
/// works like the others.
class ThreadedRun {
 public:
  ThreadedRun(std::span<const std::unique_ptr<SteppedTask>> tasks, const SteppedRun& run, int threads, Monitor& monitor)
      : tasks_(tasks),
        run_(run),
        threads_(threads),
        monitor_(monitor),
        errors_(tasks.size()),
        done_(tasks.size(), 0),
        gate_(std::make_shared<Gate>(threads - 1)),
        helping_(threads) {
    for (std::size_t i = 0; i < tasks.size(); ++i)
      monitors_.push_back(std::make_unique<TaskMonitor>(i, monitor, first_failed_));
    if (run.order.empty()) {
      waiting_.resize(tasks.size());
      std::iota(waiting_.begin(), waiting_.end(), std::size_t{0});
    } else {
      waiting_.assign(run.order.begin(), run.order.end());
    }
  }
  ThreadedRun(const ThreadedRun&) = delete;
  ThreadedRun& operator=(const ThreadedRun&) = delete;
  ~ThreadedRun() {
    first_failed_ = 0;  // running tasks end at their next checkpoint
    {
      const std::scoped_lock lock(mutex_);
      waiting_.clear();
      free_.clear();
    }
    gate_->close();
  }

  void run() {
    while (evaluation_ < tasks_.size()) {
      monitor_.checkpoint();
      deliver();
      if (evaluation_ == tasks_.size()) break;
      start_some();
      const std::size_t task = take_any();
      if (task != none) {
        work_on(task);
        continue;
      }
      std::unique_lock lock(mutex_);
      // The timeout is for checkpoints: a stop can come without notice.
      changed_.wait_for(lock, std::chrono::milliseconds(20),
                        [this] { return !bound_.empty() || !free_.empty() || done_[evaluation_] != 0; });
    }
  }

 private:
  /// Starts tasks that wait for a thread, enough to occupy all threads: tasks that have not started take no memory.
  void start_some() {
    const std::size_t most = 2 * static_cast<std::size_t>(threads_);
    for (;;) {
      bool bound = false;
      {
        const std::scoped_lock lock(mutex_);
        if (waiting_.empty() || free_.size() + bound_.size() >= most) return;
        bound = make_ready(waiting_.front());
        waiting_.pop_front();
      }
      call_for(bound);
    }
  }

  /// Queues the next step of a task. Under the lock; whether it is bound.
  bool make_ready(std::size_t task) {
    const bool bound = tasks_[task]->bound();
    (bound ? bound_ : free_).push_back(task);
    return bound;
  }

  /// Someone for a task that has been made ready.
  void call_for(bool bound) {
    changed_.notify_all();
    if (bound) return;
    try {
      helping_.send([this, gate = gate_] {
        if (!gate->enter()) return;
        help();
        gate->leave();
      });
    } catch (...) {  // no memory or no thread for a helper: the calling thread takes the task
    }
  }

  /// One is sent for each task that becomes free, and works as long as there are free tasks; it finds none when the
  /// others were faster.
  void help() {
    for (;;) {
      std::size_t task = none;
      {
        const std::scoped_lock lock(mutex_);
        task = pop(free_);
      }
      if (task == none) return;
      work_on(task);
      // The calling thread may be long at work.
      try {
        start_some();
      } catch (...) {  // no memory: the calling thread does the steps that have not started
      }
    }
  }

  static std::size_t pop(std::deque<std::size_t>& queue) {
    if (queue.empty()) return none;
    const std::size_t task = queue.front();
    queue.pop_front();
    return task;
  }

  /// For the calling thread.
  std::size_t take_any() {
    const std::scoped_lock lock(mutex_);
    const std::size_t task = pop(bound_);
    return task != none ? task : pop(free_);
  }

  void work_on(std::size_t task) {
    try {
      monitors_[task]->checkpoint();
      tasks_[task]->step(*monitors_[task]);
      if (!tasks_[task]->finished()) {
        bool bound = false;
        {
          const std::scoped_lock lock(mutex_);
          bound = make_ready(task);
        }
        call_for(bound);
        return;
      }
    } catch (...) {
      fail(task, std::current_exception());
      return;
    }
    const std::scoped_lock lock(mutex_);
    done_[task] = 1;
    changed_.notify_all();
  }

  void fail(std::size_t task, std::exception_ptr error) {
    const std::scoped_lock lock(mutex_);
    errors_[task] = std::move(error);
    done_[task] = 1;
    first_failed_ = std::min(first_failed_.load(), task);
    changed_.notify_all();
  }

  /// Tells of the tasks that are finished, in order.
  void deliver() {
    while (evaluation_ < tasks_.size()) {
      {
        const std::scoped_lock lock(mutex_);
        if (done_[evaluation_] == 0) return;
      }
      monitors_[evaluation_]->deliver();
      if (errors_[evaluation_]) std::rethrow_exception(errors_[evaluation_]);
      if (run_.on_finished) run_.on_finished(evaluation_);
      ++evaluation_;
    }
  }

  std::span<const std::unique_ptr<SteppedTask>> tasks_;
  const SteppedRun& run_;
  int threads_;
  Monitor& monitor_;
  std::vector<std::unique_ptr<TaskMonitor>> monitors_;
  std::atomic<std::size_t> first_failed_{none};
  std::size_t evaluation_ = 0;  // of the calling thread

  std::mutex mutex_;  // guards the following
  std::condition_variable changed_;
  std::deque<std::size_t> waiting_;  // not started
  std::deque<std::size_t> bound_, free_;
  std::vector<std::exception_ptr> errors_;
  std::vector<char> done_;
  std::shared_ptr<Gate> gate_;
  Helpers helping_;
};

// Enough that one long range does not keep the others waiting.
constexpr std::size_t ranges_per_thread = 16;

/// One step for several indices: most of them are cheap.
class Range final : public SteppedTask {
 public:
  Range(std::size_t begin, std::size_t end, const std::function<void(std::size_t, Monitor&)>& work)
      : next_(begin), end_(end), work_(work) {}
  [[nodiscard]] bool finished() const override { return next_ == end_; }
  [[nodiscard]] bool bound() const override { return false; }
  void step(Monitor& monitor) override {
    for (; next_ < end_; ++next_) {
      monitor.checkpoint();
      work_(next_, monitor);
    }
  }

 private:
  std::size_t next_, end_;
  const std::function<void(std::size_t, Monitor&)>& work_;
};

}  // namespace

void run_stepped(std::span<const std::unique_ptr<SteppedTask>> tasks, const SteppedRun& run, Monitor& monitor) {
  // Asked for more than it has, oneTBB would print a warning.
  const std::size_t most = Helpers::max_threads();
  const int threads =
      static_cast<int>(std::min({static_cast<std::size_t>(std::max(run.threads, 1)), most, tasks.size()}));
  if (threads <= 1) {
    run_alone(tasks, run, monitor);
  } else {
    // On the heap: on the stack the thread sanitizer reports a race with earlier data there.
    std::make_unique<ThreadedRun>(tasks, run, threads, monitor)->run();
  }
}

void run_each(std::size_t n, bool bound, int threads, const std::function<void(std::size_t, Monitor&)>& work,
              Monitor& monitor) {
  if (bound || threads <= 1) {
    for (std::size_t i = 0; i < n; ++i) {
      monitor.checkpoint();
      work(i, monitor);
    }
    return;
  }
  const std::size_t ranges = std::min(n, ranges_per_thread * static_cast<std::size_t>(threads));
  std::vector<std::unique_ptr<SteppedTask>> tasks;
  for (std::size_t r = 0; r < ranges; ++r)
    tasks.push_back(std::make_unique<Range>(r * n / ranges, (r + 1) * n / ranges, work));
  run_stepped(tasks, {.threads = threads}, monitor);
}

}  // namespace carreau
