// SPDX-License-Identifier: BSD-3-Clause
// A barrier of threads.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace carreau::testing {

/// A barrier. GCC 12's std::barrier loses wakeups on systems without futex, such as Windows: it reads the phase before it locks.
class Meeting {
 public:
  explicit Meeting(int n) : n_(n) {}
  void arrive_and_wait() {
    std::unique_lock lock(mutex_);
    const std::int64_t phase = phase_;
    if (++arrived_ == n_) {
      arrived_ = 0, ++phase_;
      all_.notify_all();
    } else {
      all_.wait(lock, [&] { return phase_ != phase; });
    }
  }

 private:
  const int n_;
  std::mutex mutex_;  // guards the following
  std::condition_variable all_;
  int arrived_ = 0;
  std::int64_t phase_ = 0;
};

}  // namespace carreau::testing
