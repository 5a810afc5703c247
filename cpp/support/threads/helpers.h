// SPDX-License-Identifier: BSD-3-Clause
// Threads that help the calling one: oneTBB's if it is built in, else some of the standard library.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace carreau {

class Helpers {
 public:
  /// For `threads` threads, the calling one among them: above 1. If oneTBB has more, more of them may run work; then
  /// the work itself limits their number.
  explicit Helpers(int threads);
  /// Work that no thread has begun may be left undone, or be done later on; threads of the standard library end.
  ~Helpers();
  Helpers(const Helpers&) = delete;
  Helpers& operator=(const Helpers&) = delete;

  /// Runs `work`, which throws nothing, in another thread soon. From any thread. Throws when there is no memory or no
  /// thread; `work` may run nevertheless.
  void send(std::function<void()> work);

  /// Number of threads that may work at a time in this process.
  static std::size_t max_threads() noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace carreau
