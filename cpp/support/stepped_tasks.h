// SPDX-License-Identifier: BSD-3-Clause
// Independent tasks made of steps, in one or more threads: some steps only the calling thread may run.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "support/monitor.h"

namespace carreau {

/// Used by one thread at a time, not always the same one.
class SteppedTask {
 public:
  virtual ~SteppedTask() = default;
  [[nodiscard]] virtual bool finished() const = 0;
  /// The next step calls a host that must be called from the calling thread only.
  [[nodiscard]] virtual bool bound() const = 0;
  /// Runs the next step. `monitor` accepts checkpoints and messages from the thread at work; they reach the host in
  /// order of the tasks. Never called again after it has thrown.
  virtual void step(Monitor& monitor) = 0;
};

struct SteppedRun {
  int threads = 1;  ///< at most; 1: only the calling thread works
  /// Ranks of the tasks, in the order in which they are started (longest first); empty: as they are. One thread takes
  /// them as they are.
  std::vector<std::size_t> order = {};
  /// Called from the calling thread for 0, 1, 2, ... each as soon as it and all before it are finished; may be empty.
  std::function<void(std::size_t)> on_finished = {};
};

/// Runs all tasks to their end. If steps or on_finished throw, rethrows the exception of the first such task, in rank,
/// after on_finished of all tasks before it, whatever the number of threads. Throws Cancelled soon after a stop was
/// requested. No thread works when it returns.
void run_stepped(std::span<const std::unique_ptr<SteppedTask>> tasks, const SteppedRun& run, Monitor& monitor);

/// Calls work(i, monitor) for each i below n. `bound`: from the calling thread only, in order. Exceptions and messages
/// propagate as in run_stepped().
void run_each(std::size_t n, bool bound, int threads, const std::function<void(std::size_t, Monitor&)>& work,
              Monitor& monitor);

}  // namespace carreau
