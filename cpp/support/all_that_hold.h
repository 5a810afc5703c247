// SPDX-License-Identifier: BSD-3-Clause
// A long list searched by several threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "support/monitor.h"
#include "support/stepped_tasks.h"

namespace carreau {

/// The i below n for which holds(i), ascending. The same for any number of threads.
template <typename Holds>
std::vector<std::int32_t> all_that_hold(std::size_t n, int threads, Monitor& monitor, const Holds& holds) {
  constexpr std::size_t at_once = 1 << 15;  // [time only]
  std::vector<std::vector<std::int32_t>> found((n + at_once - 1) / at_once);
  const auto look = [&](std::size_t part, Monitor&) {
    for (std::size_t i = part * at_once; i < std::min((part + 1) * at_once, n); ++i)
      if (holds(i)) found[part].push_back(static_cast<std::int32_t>(i));
  };
  run_each(found.size(), false, found.size() > 1 ? threads : 1, look, monitor);
  if (found.size() == 1) return std::move(found.front());
  std::vector<std::int32_t> all;
  for (const std::vector<std::int32_t>& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace carreau
