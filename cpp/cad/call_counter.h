// SPDX-License-Identifier: BSD-3-Clause
// Counters of calls that several threads may advance at a time.
#pragma once

#include <atomic>
#include <cstddef>

#include "cad/cad.h"

namespace carreau {

/// Counts as CallCounts defines them; safe to advance from several threads (a host may be re-entrant).
class CallCounter {
 public:
  /// `points` evaluations of each routine that the Want bits stand for.
  void add_surface(unsigned want, std::size_t points) noexcept {
    const auto n = static_cast<std::int64_t>(points);
    if ((want & want_position) != 0) add(surf0_, n);
    if ((want & want_first) != 0) add(surf1_, n);
    if ((want & want_second) != 0) add(surf2_, n);
  }
  void add_curve(unsigned want) noexcept {
    if ((want & want_position) != 0) add(curv0_, 1);
    if ((want & want_first) != 0) add(curv1_, 1);
    if ((want & want_second) != 0) add(curv2_, 1);
  }
  void add_size() noexcept { add(sizes_, 1); }

  [[nodiscard]] CallCounts counts() const noexcept {
    return {.surf0 = surf0_.load(std::memory_order_relaxed),
            .surf1 = surf1_.load(std::memory_order_relaxed),
            .surf2 = surf2_.load(std::memory_order_relaxed),
            .curv0 = curv0_.load(std::memory_order_relaxed),
            .curv1 = curv1_.load(std::memory_order_relaxed),
            .curv2 = curv2_.load(std::memory_order_relaxed),
            .sizes = sizes_.load(std::memory_order_relaxed)};
  }

 private:
  using Count = std::atomic<std::int64_t>;
  static void add(Count& count, std::int64_t n) noexcept { count.fetch_add(n, std::memory_order_relaxed); }

  Count surf0_{0}, surf1_{0}, surf2_{0}, curv0_{0}, curv1_{0}, curv2_{0}, sizes_{0};
};

}  // namespace carreau
