// SPDX-License-Identifier: BSD-3-Clause
// Hosts are called once for each place over all processes, and an error names a host with other answers.
#include "support/ranks/shared_answers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <new>

#include "common/thread_team.h"
#include "support/error.h"

namespace carreau {
namespace {

using testing::in_processes;

constexpr std::size_t places = 5000;
constexpr int processes = 4;

std::vector<Vec2> spread() {
  std::vector<Vec2> uv;
  for (std::size_t k = 0; k < places; ++k) uv.push_back({0.001 * static_cast<double>(k), 1.0 / static_cast<double>(k + 1)});
  return uv;
}

void say(const Vec2& p, double* out) { out[0] = std::sin(p.x()), out[1] = p.y() * p.y(); }

/// The exceptions of each process. The process that evaluates a place calls `misbehave` there.
std::vector<std::string> thrown_by(const std::function<void(int rank, const Vec2& p)>& misbehave, std::atomic<std::size_t>* asked = nullptr) {
  const std::vector<Vec2> uv = spread();
  return in_processes(processes, [&](Team& team) {
    Monitor monitor;
    const auto ask = [&](std::span<const Vec2> some, double* out, Monitor&) {
      if (asked != nullptr) *asked += some.size();
      for (std::size_t k = 0; k < some.size(); ++k) misbehave(team.rank(), some[k]), say(some[k], out + 2 * k);
    };
    const std::vector<double> all = shared_answers({&team, 1}, 7, {"answers", 2, 1, ask}, uv, monitor);
    ASSERT_EQ(all.size(), 2 * places);
    for (std::size_t k = 0; k < places; ++k) {
      double expected[2];
      say(uv[k], expected);
      EXPECT_EQ(all[2 * k], expected[0]);
      EXPECT_EQ(all[2 * k + 1], expected[1]);
    }
  });
}

TEST(SharedAnswers, AreEvaluatedOnceAndReachAll) {
  std::atomic<std::size_t> asked{0};
  for (const std::string& sentence : thrown_by([](int, const Vec2&) {}, &asked)) EXPECT_EQ(sentence, "");
  EXPECT_EQ(asked, places + processes * ((places + 63) / 64));
}

TEST(SharedAnswers, AHostThatDiffersIsNamedWithTheFace) {
  const std::vector<Vec2> uv = spread();
  const auto thrown = in_processes(processes, [&](Team& team) {
    Monitor monitor;
    const auto ask = [&](std::span<const Vec2> some, double* out, Monitor&) {
      for (std::size_t k = 0; k < some.size(); ++k) out[k] = some[k].x() + (team.rank() == 2 ? 1e-15 : 0);
    };
    try {
      (void)shared_answers({&team, 1}, 7, {"answers", 1, 1, ask}, uv, monitor);
      ADD_FAILURE() << "nothing was thrown";
    } catch (const InvalidModel& error) {
      EXPECT_EQ(std::string(error.what()).find("face 7 differs on rank 2 from rank 0"), 0U) << error.what();
    }
  });
  for (const std::string& sentence : thrown) EXPECT_EQ(sentence, "");
}

TEST(SharedAnswers, TheErrorOfOneHostEndsTheRunOfAll) {
  const auto thrown = thrown_by([](int rank, const Vec2&) {
    if (rank == 3) throw CallbackError(Where{.face = 7}, "surf0 gave NaN");
  });
  for (const std::string& sentence : thrown) EXPECT_EQ(sentence, "rank 3: face 7: surf0 gave NaN");
}

// As in one process, so that the face alone fails if the options allow it.
TEST(SharedAnswers, AnErrorOfAllHostsEqualsTheErrorOfOne) {
  const std::vector<Vec2> uv = spread();
  const auto thrown = in_processes(processes, [&](Team& team) {
    Monitor monitor;
    const auto ask = [](std::span<const Vec2> some, double*, Monitor&) {
      for (const Vec2& p : some)
        if (p.x() >= 1) throw CallbackError(Where{.face = 7, .uv = p}, "surf0 gave NaN");
    };
    try {
      (void)shared_answers({&team, 1}, 7, {"answers", 1, 1, ask}, uv, monitor);
      ADD_FAILURE() << "nothing was thrown";
    } catch (const CallbackError& error) {
      EXPECT_EQ(error.where().face, 7);
      EXPECT_EQ(error.where().uv->x(), 1);  // the first of all
    }
    EXPECT_EQ(team.exchange("next", "").size(), 4U);  // they go on
  });
  for (const std::string& sentence : thrown) EXPECT_EQ(sentence, "");
}

TEST(SharedAnswers, AStopAndALackOfMemoryReachAll) {
  for (const std::string& sentence : thrown_by([](int rank, const Vec2&) {
         if (rank == 1) throw Cancelled("stopped by the host");
       }))
    EXPECT_NE(sentence.find("stopped"), std::string::npos) << sentence;
  for (const std::string& sentence : thrown_by([](int rank, const Vec2&) {
         if (rank == 1) throw std::bad_alloc();
       }))
    EXPECT_TRUE(sentence.find("memory") != std::string::npos || sentence == "std::bad_alloc") << sentence;
}

TEST(SharedAnswers, FewPlacesAreEvaluatedByEachProcess) {
  EXPECT_FALSE(is_shared({}, places));
  in_processes(2, [](Team& team) {
    EXPECT_TRUE(is_shared({&team, 1}, places));
    EXPECT_FALSE(is_shared({&team, 1}, 100));
  });
}

}  // namespace
}  // namespace carreau
