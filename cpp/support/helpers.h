// SPDX-License-Identifier: BSD-3-Clause
// Threads that help the calling one: oneTBB's where it is built in, else some of the standard library.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace carreau {

class Helpers {
 public:
  /// At most `threads` at work, the calling one among them: above 1.
  explicit Helpers(int threads);
  /// Nothing may be under way: wait() first.
  ~Helpers();
  Helpers(const Helpers&) = delete;
  Helpers& operator=(const Helpers&) = delete;

  /// Runs `work`, which throws nothing, in another thread soon, or in wait(). From any thread. Throws when there is no
  /// memory; `work` is not run then.
  void send(std::function<void()> work);
  /// Runs what no thread has begun with, and returns when all is done. From the calling thread.
  void wait();

  /// That may be at work at a time in this process.
  static std::size_t most_threads() noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace carreau
