// SPDX-License-Identifier: BSD-3-Clause
#include "support/ranks/all_that_hold.h"

#include <gtest/gtest.h>

#include "common/thread_team.h"
#include "support/error.h"

namespace carreau {
namespace {

TEST(AllThatHold, MatchALoopForAnyNumberOfThreadsAndProcesses) {
  for (const std::size_t n : {0, 1, 32'768, 32'769, 200'001}) {
    const auto holds = [](std::size_t i) { return i % 7 == 3 || i > 150'000; };
    std::vector<std::int32_t> expected;
    for (std::size_t i = 0; i < n; ++i)
      if (holds(i)) expected.push_back(static_cast<std::int32_t>(i));
    for (const int threads : {1, 3}) {
      Monitor monitor;
      EXPECT_EQ(all_that_hold(n, {nullptr, threads}, "", monitor, holds), expected) << n;
    }
    const auto thrown = testing::in_processes(3, [&](Team& team) {
      Monitor monitor;
      EXPECT_EQ(all_that_hold(n, {&team, 2}, "those that hold", monitor, holds), expected) << n;
    });
    for (const std::string& sentence : thrown) EXPECT_EQ(sentence, "");
  }
}

TEST(AllThatHold, StopsOnRequest) {
  Monitor monitor;
  monitor.request_stop();
  EXPECT_THROW((void)all_that_hold(10, {}, "", monitor, [](std::size_t) { return true; }), Cancelled);
}

}  // namespace
}  // namespace carreau
