// SPDX-License-Identifier: BSD-3-Clause
// Tasks of a divided domain: for the threads of this process, or of a team of processes.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "plane/division/options.h"
#include "support/monitor.h"
#include "support/ranks/dealt_work.h"
#include "support/ranks/packet.h"
#include "support/stepped_tasks.h"

namespace carreau::plane {

/// A result as bytes for another process, and back.
template <typename Result>
struct Packing {
  void (*put)(PacketWriter&, const Result&);
  Result (*get)(PacketReader&);
};

/// work(i, monitor) for each i below n.
template <typename Result, typename Work>
std::vector<Result> results_of(std::string_view step, std::size_t n, const PlaneMesherOptions& options,
                               Monitor& monitor, const Packing<Result>& packing, const Work& work) {
  std::vector<Result> results(n);
  if (options.team == nullptr) {
    run_each(
        n, false, options.threads, [&](std::size_t i, Monitor& of_task) { results[i] = work(i, of_task); }, monitor);
    return results;
  }
  const auto packed = [&](std::size_t i, Monitor& of_task) {
    PacketWriter packet;
    packing.put(packet, work(i, of_task));
    return packet.take();
  };
  std::vector<std::string> all = deal_out(*options.team, step, n, options.threads, packed, monitor);
  for (std::size_t i = 0; i < n; ++i) {
    monitor.checkpoint();
    PacketReader packet(all[i]);
    results[i] = packing.get(packet);
    all[i] = {};
  }
  return results;
}

}  // namespace carreau::plane
