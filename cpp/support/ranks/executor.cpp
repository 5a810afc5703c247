// SPDX-License-Identifier: BSD-3-Clause
#include "support/ranks/executor.h"

#include <algorithm>
#include <cstring>

#include "support/error.h"

namespace carreau {

std::vector<double> shared_rows(const Executor& executor, std::string_view step, const SharedRows& rows, const FillRows& fill, Monitor& monitor) {
  std::vector<double> all(rows.count * rows.width);
  const std::size_t pieces = (rows.count + rows.at_once - 1) / rows.at_once;
  const auto first_of = [&](std::size_t piece) { return piece * rows.at_once; };
  const auto last_of = [&](std::size_t piece) { return std::min(first_of(piece + 1), rows.count); };
  if (executor.team == nullptr) {
    run_each(
        pieces, rows.bound, executor.threads,
        [&](std::size_t i, Monitor& of_task) {
          of_task.checkpoint();
          fill(first_of(i), last_of(i), all.data() + first_of(i) * rows.width, of_task);
        },
        monitor);
    return all;
  }
  const auto packed = [&](std::size_t i, Monitor& of_task) {
    of_task.checkpoint();
    std::vector<double> some((last_of(i) - first_of(i)) * rows.width);
    fill(first_of(i), last_of(i), some.data(), of_task);
    return std::string(reinterpret_cast<const char*>(some.data()), some.size() * sizeof(double));
  };
  std::vector<std::string> pieces_of_all = deal_out(*executor.team, step, pieces, rows.bound ? 1 : executor.threads, packed, monitor);
  for (std::size_t i = 0; i < pieces; ++i) {
    std::string& bytes = pieces_of_all[i];
    if (bytes.size() != (last_of(i) - first_of(i)) * rows.width * sizeof(double))
      throw Error("another process has sent other rows than its own");
    if (!bytes.empty()) std::memcpy(all.data() + first_of(i) * rows.width, bytes.data(), bytes.size());
    bytes = {};
  }
  return all;
}

}  // namespace carreau
