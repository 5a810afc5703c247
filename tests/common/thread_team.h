// SPDX-License-Identifier: BSD-3-Clause
// A team of threads, each a process with its own Team.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "common/meeting.h"
#include "support/ranks/team.h"

namespace carreau::testing {

/// Data that the processes share.
struct CommonOfThreads {
  explicit CommonOfThreads(int n) : given(static_cast<std::size_t>(n)), meeting(n) {}
  std::vector<std::string> given;
  std::atomic<std::int64_t> next{0};
  Meeting meeting;
};

class ThreadLink final : public TeamLink {
 public:
  ThreadLink(CommonOfThreads& common, int rank) : common_(common), rank_(rank) {}
  [[nodiscard]] int rank() const noexcept override { return rank_; }
  [[nodiscard]] int size() const noexcept override { return static_cast<int>(common_.given.size()); }
  [[nodiscard]] bool takes_from_any_thread() const noexcept override { return true; }
  std::int64_t take(std::int64_t count) override { return common_.next.fetch_add(count); }
  std::vector<std::string> exchange(std::string_view mine) override {
    common_.given[static_cast<std::size_t>(rank_)] = mine;
    common_.meeting.arrive_and_wait();
    std::vector<std::string> all = common_.given;
    common_.next = 0;
    common_.meeting.arrive_and_wait();
    return all;
  }

 private:
  CommonOfThreads& common_;
  int rank_;
};

/// Runs body(team) in n processes; returns the exception of each, or "".
inline std::vector<std::string> in_processes(int n, const std::function<void(Team&)>& body) {
  CommonOfThreads common(n);
  std::vector<std::string> thrown(static_cast<std::size_t>(n));
  std::vector<std::thread> processes;
  for (int rank = 0; rank < n; ++rank)
    processes.emplace_back([&, rank] {
      ThreadLink link(common, rank);
      Team team(link);
      try {
        team.run([&] { body(team); });
      } catch (const std::exception& error) {
        thrown[static_cast<std::size_t>(rank)] = error.what();
      }
    });
  for (std::thread& process : processes) process.join();
  return thrown;
}

}  // namespace carreau::testing
