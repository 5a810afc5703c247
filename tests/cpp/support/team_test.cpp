// SPDX-License-Identifier: BSD-3-Clause
#include "support/ranks/team.h"

#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <set>

#include "common/thread_team.h"
#include "support/error.h"
#include "support/ranks/executor.h"
#include "support/ranks/dealt_work.h"
#include "support/ranks/packet.h"
#include "support/ranks/triangle_packet.h"

namespace carreau {
namespace {

using testing::in_processes;

// All processes receive the data of each process, in the order of ranks.
TEST(Team, ProcessesGiveInTurn) {
  constexpr int n = 4;
  std::vector<std::vector<std::string>> heard(n);
  const auto thrown = in_processes(n, [&](Team& team) {
    auto& mine = heard[static_cast<std::size_t>(team.rank())];
    team.exchange_in_turn("turn", std::string(static_cast<std::size_t>(team.rank()), 'x'), [&](int rank, const std::string& given) {
      EXPECT_EQ(rank, static_cast<int>(mine.size()));
      mine.push_back(given);
    });
  });
  for (const std::string& sentence : thrown) EXPECT_EQ(sentence, "");
  for (const auto& all : heard) EXPECT_EQ(all, (std::vector<std::string>{"", "x", "xx", "xxx"}));
}

// A process that cannot read its input leaves, and the others do not wait for it.
TEST(Team, OneThatLeavesInItsTurnIsNotWaitedFor) {
  const auto thrown = in_processes(3, [&](Team& team) {
    team.exchange_in_turn("turn", "bytes", [&](int rank, const std::string&) {
      if (team.rank() == 1 && rank == 0) throw std::bad_alloc();
    });
  });
  EXPECT_EQ(thrown.size(), 3U);
  for (std::size_t r = 0; r < thrown.size(); ++r) EXPECT_NE(thrown[r], "") << r;
}

TEST(Team, EveryJobIsTakenOnceInEachRound) {
  constexpr std::size_t jobs = 1000, rounds = 3;
  std::vector<std::atomic<int>> taken(jobs);
  const auto thrown = in_processes(5, [&](Team& team) {
    for (std::size_t round = 0; round < rounds; ++round) {
      while (const std::optional<std::size_t> job = team.take(jobs)) ++taken[*job];
      team.exchange("round", "");
    }
  });
  for (const std::string& sentence : thrown) EXPECT_EQ(sentence, "");
  for (const auto& times : taken) EXPECT_EQ(times, static_cast<int>(rounds));
}

TEST(Team, ExchangeGivesTheBytesOfEachRank) {
  in_processes(4, [](Team& team) {
    const std::string mine(static_cast<std::size_t>(team.rank()), 'x');
    const std::vector<std::string> all = team.exchange("step", mine);
    for (std::size_t r = 0; r < 4; ++r) EXPECT_EQ(all[r], std::string(r, 'x'));
  });
}

TEST(Team, TheErrorOfOneRankReachesThoseThatWaitForIt) {
  const auto thrown = in_processes(4, [](Team& team) {
    team.exchange("first", "");
    if (team.rank() == 2) throw CallbackError(Where{.face = 7}, "surf0 gave NaN");
    team.exchange("second", "");
    team.exchange("third", "");
  });
  EXPECT_EQ(thrown[2], "face 7: surf0 gave NaN");
  for (const std::size_t r : {0, 1, 3}) EXPECT_EQ(thrown[r], "rank 2 of 4: face 7: surf0 gave NaN");
}

TEST(Team, AnErrorAfterTheLastStepReachesAllAsWell) {
  const auto thrown = in_processes(3, [](Team& team) {
    if (team.rank() == 0) throw std::bad_alloc();
  });
  for (const std::size_t r : {1, 2}) EXPECT_EQ(thrown[r], "rank 0 of 3: there is not enough memory");
}

TEST(Team, RanksAtDifferentStepsAreReported) {
  const auto thrown = in_processes(2, [](Team& team) { team.exchange(team.rank() == 0 ? "curves" : "patches", ""); });
  EXPECT_EQ(thrown[0],
            "the processes do not make the same mesh: rank 1 is at \"patches\" (step 1), rank 0 at \"curves\" (step 1)");
  EXPECT_NE(thrown[1], "");
}

TEST(Team, ARankThatGoesOnAfterTheEndDoesNotWait) {
  const auto thrown = in_processes(2, [](Team& team) {
    try {
      if (team.rank() == 0) throw DomainError("no mesh");
      team.exchange("step", "");
    } catch (const DomainError&) {
      if (team.rank() == 0) throw;
    }
    team.exchange("next step", "");
  });
  EXPECT_EQ(thrown[0], "no mesh");
  EXPECT_EQ(thrown[1], "another process has left the run");
}

TEST(Team, DifferentValuesNameTheRank) {
  const auto thrown = in_processes(3, [](Team& team) {
    team.require_same("mesh", team.rank() == 1 ? "a" : "b", [](int rank) { return "rank " + std::to_string(rank) + " differs"; });
  });
  for (const std::string& sentence : thrown) EXPECT_EQ(sentence, "rank 1 differs");
}

std::string squared(std::size_t i) { return std::to_string(i * i); }

TEST(DealtWork, ReachesAllProcesses) {
  for (const int threads : {1, 3}) {
    std::vector<std::atomic<int>> times(100);
    const auto thrown = in_processes(4, [&](Team& team) {
      Monitor monitor;
      for (const std::size_t n : {100, 0, 1, 7}) {
        const auto work = [&](std::size_t i, Monitor&) {
          if (n == 100) ++times[i];
          return squared(i);
        };
        const std::vector<std::string> all = deal_out(team, "squares", n, threads, work, monitor);
        ASSERT_EQ(all.size(), n);
        for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(all[i], squared(i));
      }
    });
    for (const std::string& sentence : thrown) EXPECT_EQ(sentence, "");
    for (const auto& each : times) EXPECT_EQ(each, 1);
  }
}

TEST(DealtWork, ErrorsKeepTheirClassAndTheFirstComesOutOfAll) {
  in_processes(3, [](Team& team) {
    Monitor monitor;
    const auto work = [](std::size_t i, Monitor&) -> std::string {
      if (i == 5 || i == 9) throw DomainError(Where{.face = static_cast<int>(i)}, "no mesh");
      return squared(i);
    };
    try {
      deal_out(team, "squares", 12, 1, work, monitor);
      ADD_FAILURE() << "nothing was thrown";
    } catch (const DomainError& error) {
      EXPECT_STREQ(error.what(), "face 5: no mesh");
    }
    // They may go on in another way.
    EXPECT_EQ(team.exchange("next", "").size(), 3u);
  });
}

TEST(DealtWork, TheStopOfOneProcessReachesAll) {
  const auto thrown = in_processes(3, [](Team& team) {
    Monitor monitor;
    if (team.rank() == 1) monitor.request_stop();
    const auto work = [](std::size_t i, Monitor&) { return squared(i); };
    deal_out(team, "squares", 1000, 1, work, monitor);
  });
  for (const std::string& sentence : thrown) EXPECT_NE(sentence.find("stop"), std::string::npos) << sentence;
}

TEST(DealtWork, LackOfMemoryInOneProcessReachesAll) {
  const auto thrown = in_processes(3, [](Team& team) {
    Monitor monitor;
    const auto work = [](std::size_t i, Monitor&) -> std::string {
      if (i == 2) throw std::bad_alloc();
      return squared(i);
    };
    deal_out(team, "squares", 6, 1, work, monitor);
  });
  for (const std::string& sentence : thrown) EXPECT_NE(sentence.find("there is not enough memory"), std::string::npos);
}

TEST(SharedRows, AreMadeOnceAndReachAll) {
  constexpr std::size_t n = 1001, width = 3;
  std::vector<std::atomic<int>> times(n);
  const auto fill = [&](std::size_t first, std::size_t last, double* out, Monitor&) {
    for (std::size_t i = first; i < last; ++i) {
      ++times[i];
      for (std::size_t k = 0; k < width; ++k) *out++ = static_cast<double>(10 * i + k);
    }
  };
  const auto check = [&](const std::vector<double>& rows) {
    ASSERT_EQ(rows.size(), n * width);
    for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(rows[i], static_cast<double>(10 * (i / width) + i % width));
  };
  Monitor silent;
  const SharedRows rows{.count = n, .width = width, .at_once = 10};
  check(shared_rows({nullptr, 3}, "rows", rows, fill, silent));
  const auto thrown = in_processes(4, [&](Team& team) {
    Monitor own;
    check(shared_rows({&team, 2}, "rows", rows, fill, own));
    check(shared_rows({&team, 1}, "rows", {.count = n, .width = width, .at_once = 400, .bound = true}, fill, own));
    EXPECT_TRUE(shared_rows({&team, 1}, "rows", {.count = 0, .width = width, .at_once = 10}, fill, own).empty());
  });
  for (const std::string& sentence : thrown) EXPECT_EQ(sentence, "");
  for (const auto& each : times) EXPECT_EQ(each, 3);
}

TEST(SharedWork, ResultsMatchTheirNumbers) {
  const auto work = [](std::size_t i, Monitor&) { return std::string(i, 'x'); };
  const auto put = [](PacketWriter& packet, const std::string& text) { packet.put(std::string_view(text)); };
  const auto get = [](PacketReader& packet) { return packet.text(); };
  const auto make = [&](const Executor& executor) {
    Monitor silent;
    return shared_work<std::string>(executor, "work", 20, false, work, put, get, silent);
  };
  const std::vector<std::string> one = make({});
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].size(), i);
  const auto thrown = in_processes(3, [&](Team& team) { EXPECT_EQ(make({&team, 2}), one); });
  for (const std::string& sentence : thrown) EXPECT_EQ(sentence, "");
}

template <typename E>
void expect_same_back(const E& error) {
  const SharedError shared = SharedError::of(std::make_exception_ptr(error));
  try {
    shared.raise();
  } catch (const E& back) {
    EXPECT_STREQ(back.what(), error.what());
    EXPECT_EQ(back.where().face, error.where().face);
    EXPECT_EQ(back.where().uv.has_value(), error.where().uv.has_value());
    EXPECT_EQ(back.where().file, error.where().file);
    return;
  }
  FAIL() << "another class";
}

TEST(SharedError, KeepsClassSentenceAndPlace) {
  const Where where{.face = 3, .curve_index = 2, .uv = Vec2{0.5, 0.25}, .file = "x.pardom", .line = 12};
  expect_same_back(InvalidArgument(where, "a"));
  expect_same_back(InvalidModel(where, "b"));
  expect_same_back(FileError(where, "c"));
  expect_same_back(CallbackError(where, "d"));
  expect_same_back(DomainError(where, "e"));
  expect_same_back(LimitError("without a place"));
  expect_same_back(Cancelled("stopped by the host"));
  EXPECT_THROW(SharedError::of(std::make_exception_ptr(std::logic_error("f"))).raise(), std::runtime_error);
}

TEST(Packet, RestoresItsValues) {
  PacketWriter packet;
  packet.put(std::int64_t{-5}), packet.put(0.1), packet.put(true), packet.put(std::string_view("text"));
  packet.put(std::vector<std::int32_t>{1, -2}), packet.put(std::vector<Vec3>{Vec3{1, 2, 3}});
  put_triangles(packet, {{0, 1, 2}, {2, 1, 3}}), packet.put(std::vector<Vec2>{{4, 5}});
  PacketReader reader(packet.bytes());
  EXPECT_EQ(reader.integer(), -5);
  EXPECT_EQ(reader.real(), 0.1);
  EXPECT_TRUE(reader.flag());
  EXPECT_EQ(reader.text(), "text");
  EXPECT_EQ(reader.integers(), (std::vector<std::int32_t>{1, -2}));
  EXPECT_EQ(reader.points(), (std::vector<Vec3>{Vec3{1, 2, 3}}));
  EXPECT_EQ(triangles_of(reader), (TriangleList{{0, 1, 2}, {2, 1, 3}}));
  EXPECT_EQ(reader.plane_points(), (std::vector<Vec2>{{4, 5}}));
  EXPECT_TRUE(reader.at_end());
}

TEST(Packet, RejectsBytesThatEndEarly) {
  PacketWriter packet;
  packet.put(std::vector<double>(10, 1.));
  for (std::size_t n = 0; n < packet.bytes().size(); ++n) {
    PacketReader reader(std::string_view(packet.bytes()).substr(0, n));
    EXPECT_THROW(reader.reals(), Error) << n;
  }
}

TEST(Checksum, IsFnv1a) {
  // From the authors' test vectors.
  EXPECT_EQ(checksum(""), "cbf29ce484222325");
  EXPECT_EQ(checksum("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(checksum("foobar"), "85944171f73967e8");
}

TEST(Checksum, DependsOnEachBitAndTheOrderOfLongArrays) {
  std::vector<std::int32_t> values(101);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = static_cast<std::int32_t>(k);
  const auto sum = [](const std::vector<std::int32_t>& of) {
    LongChecksum sum;
    sum.add(of);
    return sum.text();
  };
  std::set<std::string> seen{sum(values)};
  for (std::size_t k = 0; k < values.size(); ++k)
    for (int bit = 0; bit < 32; ++bit) {
      values[k] = static_cast<std::int32_t>(static_cast<std::uint32_t>(values[k]) ^ (1U << bit));
      EXPECT_TRUE(seen.insert(sum(values)).second) << k << ", bit " << bit;
      values[k] = static_cast<std::int32_t>(static_cast<std::uint32_t>(values[k]) ^ (1U << bit));
    }
  std::swap(values[3], values[90]);
  EXPECT_TRUE(seen.insert(sum(values)).second);
  EXPECT_EQ(sum(values).size(), 16u);
  // Zeros at the end count.
  EXPECT_NE(sum({0}), sum({0, 0}));
  EXPECT_NE(sum({}), sum({0}));
}

}  // namespace
}  // namespace carreau
