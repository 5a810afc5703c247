// SPDX-License-Identifier: BSD-3-Clause
#include "support/all_that_hold.h"

#include <gtest/gtest.h>

#include "support/error.h"

namespace carreau {
namespace {

TEST(AllThatHold, AreThoseOfALoopForAnyNumberOfThreads) {
  for (const std::size_t n : {0, 1, 32'768, 32'769, 200'001}) {
    const auto holds = [](std::size_t i) { return i % 7 == 3 || i > 150'000; };
    std::vector<std::int32_t> expected;
    for (std::size_t i = 0; i < n; ++i)
      if (holds(i)) expected.push_back(static_cast<std::int32_t>(i));
    for (const int threads : {1, 3}) {
      Monitor monitor;
      EXPECT_EQ(all_that_hold(n, threads, monitor, holds), expected) << n;
    }
  }
}

TEST(AllThatHold, StopsWhenAsked) {
  Monitor monitor;
  monitor.request_stop();
  EXPECT_THROW((void)all_that_hold(10, 1, monitor, [](std::size_t) { return true; }), Cancelled);
}

}  // namespace
}  // namespace carreau
