// SPDX-License-Identifier: BSD-3-Clause
// Dijkstra's order, in which all gradations propagate sizes.
#pragma once

#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "gradation/thresholds.h"
#include "support/monitor.h"
#include "support/work_sizes.h"

namespace carreau {

/// Places that wait to propagate their sizes: the smallest size first, among equal sizes the lowest number. In
/// ascending order few sizes are bounded twice.
class SmallestFirst {
 public:
  void push(double size, int place) { queue_.emplace(size, place); }

  /// Runs until no place waits. `counts(size, place)`: whether the place still has that size to hand on; `leave(place)`
  /// hands it on and pushes places whose sizes it has changed. Throws Cancelled.
  template <typename Counts, typename Leave>
  void run(const Counts& counts, const Leave& leave, Monitor& monitor) {
    std::size_t steps = 0;
    while (!queue_.empty()) {
      const auto [size, place] = queue_.top();
      queue_.pop();
      if (!counts(size, place)) continue;
      if (++steps % work_sizes::searches == 0) monitor.checkpoint();
      leave(place);
    }
  }

 private:
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace carreau
