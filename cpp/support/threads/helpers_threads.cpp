// SPDX-License-Identifier: BSD-3-Clause
// Replaces helpers_tbb.cpp if oneTBB is not built in.
#include <condition_variable>
#include <deque>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "support/threads/helpers.h"

namespace carreau {

struct Helpers::State {
  explicit State(int with_caller) : most(static_cast<std::size_t>(with_caller) - 1) {}

  void help() {
    std::unique_lock lock(mutex);
    for (;;) {
      changed.wait(lock, [this] { return ending || !waiting.empty(); });
      if (ending) return;
      std::function<void()> work = std::move(waiting.front());
      waiting.pop_front();
      ++at_work;
      lock.unlock();
      work();
      work = nullptr;
      lock.lock();
      --at_work;
    }
  }

  std::size_t most;
  std::mutex mutex;  // guards the following
  std::condition_variable changed;
  std::deque<std::function<void()>> waiting;
  std::vector<std::thread> threads;
  std::size_t at_work = 0;
  bool ending = false;
};

Helpers::Helpers(int threads) : state_(std::make_unique<State>(threads)) {}

Helpers::~Helpers() {
  State& s = *state_;
  {
    const std::scoped_lock lock(s.mutex);
    s.ending = true;
  }
  s.changed.notify_all();
  for (std::thread& thread : s.threads) thread.join();
}

void Helpers::send(std::function<void()> work) {
  State& s = *state_;
  const std::scoped_lock lock(s.mutex);
  s.waiting.push_back(std::move(work));
  if (s.threads.size() < s.most && s.at_work + s.waiting.size() > s.threads.size()) try {
      s.threads.reserve(s.most);
      s.threads.emplace_back([&s] { s.help(); });
    } catch (const std::exception&) {  // the system has no thread: other threads do the work, if there are any
    }
  s.changed.notify_all();
}

std::size_t Helpers::max_threads() noexcept {
  return 256;  // more would cost memory and gain nothing
}

}  // namespace carreau
