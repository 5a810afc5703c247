// SPDX-License-Identifier: BSD-3-Clause
// Small exchanges of an executor's processes. One process alone keeps its own values.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "support/ranks/executor.h"
#include "support/ranks/packet.h"

namespace carreau {

/// Appends the items of other processes. `shown` selects the items that other processes may have, too; put(packet, item) and
/// get(packet, item) carry them. `step`: of Team::exchange.
template <typename Item, typename Shown>
void add_of_others(const Executor& executor, std::string_view step, const Shown& shown, std::vector<Item>& items) {
  if (executor.is_alone()) return;
  PacketWriter packet;
  packet.put(static_cast<std::int64_t>(std::count_if(items.begin(), items.end(), shown)));
  for (const Item& item : items)
    if (shown(item)) put(packet, item);
  const std::vector<std::string> all = executor.team->exchange(step, packet.bytes());
  for (std::size_t rank = 0; rank < all.size(); ++rank) {
    if (static_cast<int>(rank) == executor.team->rank()) continue;
    PacketReader reader(all[rank]);
    for (std::size_t n = reader.count(sizeof(std::int64_t)); n > 0; --n) get(reader, items.emplace_back());
  }
}

/// Sum of the numbers that mine() returns in all processes. Errors propagate as in Team::exchange_results().
inline std::int64_t sum_of_all(const Executor& executor, std::string_view step, const std::function<std::int64_t()>& mine) {
  if (executor.is_alone()) return mine();
  const std::vector<std::string> all = executor.team->exchange_results(step, [&] {
    PacketWriter packet;
    packet.put(mine());
    return packet.take();
  });
  std::int64_t sum = 0;
  for (const std::string& of_rank : all) sum += PacketReader(of_rank).integer();
  return sum;
}

}  // namespace carreau
