// SPDX-License-Identifier: BSD-3-Clause
// Distributes independent pieces of work to the processes of a team.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "support/monitor.h"
#include "support/ranks/team.h"

namespace carreau {

/// Calls work(i, monitor) for each i below n once, in one of the processes, on as many threads as each has: a free
/// thread takes the next i. All processes receive the outcomes, by i. `step`: of Team::exchange. All processes call it.
/// All processes throw the error of the first i that has one, with its class and sentence; an error of a process (a
/// stop, no memory) comes first.
std::vector<std::string> deal_out(Team& team, std::string_view step, std::size_t n, int threads,
                                  const std::function<std::string(std::size_t, Monitor&)>& work, Monitor& monitor);

}  // namespace carreau
