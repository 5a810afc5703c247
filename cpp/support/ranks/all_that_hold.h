// SPDX-License-Identifier: BSD-3-Clause
// A long list searched by several threads or processes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "support/monitor.h"
#include "support/ranks/executor.h"

namespace carreau {

/// The i below n for which holds(i), ascending. All processes of an executor, which must hold equal values, search long
/// lists together. The result does not depend on the executor. `step`: of Team::exchange.
template <typename Holds>
std::vector<std::int32_t> all_that_hold(std::size_t n, const Executor& executor, std::string_view step, Monitor& monitor,
                                        const Holds& holds) {
  constexpr std::size_t at_once = 1 << 15;           // [time only]
  constexpr std::size_t least_shared = 4 * at_once;  // [time only] below some ms of work processes wait longer for each other
  const std::size_t parts = (n + at_once - 1) / at_once;
  const auto look = [&](std::size_t part, Monitor&) {
    std::vector<std::int32_t> found;
    for (std::size_t i = part * at_once; i < std::min((part + 1) * at_once, n); ++i)
      if (holds(i)) found.push_back(static_cast<std::int32_t>(i));
    return found;
  };
  const auto put = [](PacketWriter& packet, const std::vector<std::int32_t>& found) { packet.put(found); };
  const auto get = [](PacketReader& packet) { return packet.integers(); };
  const Executor searching{n >= least_shared ? executor.team : nullptr, parts > 1 ? executor.threads : 1};
  std::vector<std::vector<std::int32_t>> found =
      shared_work<std::vector<std::int32_t>>(searching, step, parts, false, look, put, get, monitor);
  if (found.size() == 1) return std::move(found.front());
  std::vector<std::int32_t> all;
  for (const std::vector<std::int32_t>& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace carreau
