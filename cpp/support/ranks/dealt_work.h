// SPDX-License-Identifier: BSD-3-Clause
// Independent pieces of work dealt out to the processes of a team.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "support/monitor.h"
#include "support/ranks/team.h"

namespace carreau {

/// Calls work(i, monitor) for each i below n once, in one of the processes, on as many threads as each has: whoever is
/// free takes the next one. What came of them reaches all processes, by i. `step`: of Team::exchange. All processes
/// call it. The error of the first i that has one comes out of all processes with its class and sentence; that of a
/// process (a stop, no memory) comes first.
std::vector<std::string> deal_out(Team& team, std::string_view step, std::size_t n, int threads,
                                  const std::function<std::string(std::size_t, Monitor&)>& work, Monitor& monitor);

}  // namespace carreau
