// SPDX-License-Identifier: BSD-3-Clause
// Work that processes and their threads share, with results of any type.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "support/error.h"
#include "support/monitor.h"
#include "support/ranks/dealt_work.h"
#include "support/ranks/packet.h"
#include "support/ranks/team.h"
#include "support/stepped_tasks.h"

namespace carreau {

/// The resources that share independent work: threads of this process, or of all processes of a team. Results do not depend on it.
/// Algorithms pass it on; only support/ranks and the steps that distribute faces look at the team.
struct Executor {
  Team* team = nullptr;  ///< null: this process alone
  int threads = 1;       ///< of each process

  [[nodiscard]] bool is_alone() const noexcept { return team == nullptr; }
  [[nodiscard]] Executor alone() const noexcept { return {nullptr, threads}; }
  /// This executor if `worth`, else this process alone: for less work processes would wait longer for each other.
  [[nodiscard]] Executor shared_if(bool worth) const noexcept { return worth ? *this : alone(); }
  [[nodiscard]] Executor with(int other_threads) const noexcept { return {team, other_threads}; }

  /// Throws Failure with `sentence(rank)` of the first process whose sum() differs from the first process's. Does not call sum() for
  /// one process.
  template <typename Failure = Error>
  void require_same(std::string_view step, const std::function<std::string()>& sum, const std::function<std::string(int)>& sentence) const {
    if (team != nullptr) team->require_same<Failure>(step, sum(), sentence);
  }
};

/// Returns the result of work(i, monitor) for each i below n; each is called once, in one of the processes. `bound`: calls work from the
/// calling thread only, for hosts that other threads must not call. put(packet, result) and get(packet) carry results from one process
/// to the others. With a team all processes call it, and errors propagate as in deal_out().
template <typename Result, typename Work, typename Put, typename Get>
std::vector<Result> shared_work(const Executor& executor, std::string_view step, std::size_t n, bool bound, const Work& work,
                                const Put& put, const Get& get, Monitor& monitor) {
  std::vector<Result> results(n);
  if (executor.team == nullptr) {
    run_each(
        n, bound, executor.threads, [&](std::size_t i, Monitor& of_task) { results[i] = work(i, of_task); }, monitor);
    return results;
  }
  const auto packed = [&](std::size_t i, Monitor& of_task) {
    PacketWriter packet;
    put(packet, work(i, of_task));
    return packet.take();
  };
  std::vector<std::string> all = deal_out(*executor.team, step, n, bound ? 1 : executor.threads, packed, monitor);
  for (std::size_t i = 0; i < n; ++i) {
    PacketReader packet(all[i]);
    results[i] = get(packet);
    all[i] = {};
  }
  return results;
}

/// Rows of numbers that threads and processes fill.
struct SharedRows {
  std::size_t count = 0;    ///< of rows
  std::size_t width = 1;    ///< numbers of a row
  std::size_t at_once = 1;  ///< rows of a piece of work
  bool bound = false;       ///< to the calling thread
};

/// fill(first, last, out, monitor) writes rows first to last - 1 to `out`, for pieces that do not depend on the executor. All
/// processes get all rows.
using FillRows = std::function<void(std::size_t first, std::size_t last, double* out, Monitor& monitor)>;
std::vector<double> shared_rows(const Executor& executor, std::string_view step, const SharedRows& rows, const FillRows& fill, Monitor& monitor);

}  // namespace carreau
