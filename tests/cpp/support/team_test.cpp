// SPDX-License-Identifier: BSD-3-Clause
// A team of threads, each a process with its own Team.
#include "support/ranks/team.h"

#include <gtest/gtest.h>

#include <atomic>
#include <barrier>
#include <new>
#include <thread>

#include "support/error.h"
#include "support/ranks/packet.h"

namespace carreau {
namespace {

/// What the processes share.
struct Common {
  explicit Common(int n) : given(static_cast<std::size_t>(n)), meeting(n) {}
  std::vector<std::string> given;
  std::atomic<std::int64_t> next{0};
  std::barrier<> meeting;
};

class ThreadLink final : public TeamLink {
 public:
  ThreadLink(Common& common, int rank) : common_(common), rank_(rank) {}
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
  Common& common_;
  int rank_;
};

/// Runs body(team) in n processes; what each threw, or "".
std::vector<std::string> in_processes(int n, const std::function<void(Team&)>& body) {
  Common common(n);
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

TEST(Team, ExchangeGivesWhatEachRankHasGiven) {
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

TEST(Team, RanksAtDifferentStepsAreTold) {
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

TEST(Packet, GivesBackWhatWasPut) {
  PacketWriter packet;
  packet.put(std::int64_t{-5}), packet.put(0.1), packet.put(true), packet.put(std::string_view("text"));
  packet.put(std::vector<std::int32_t>{1, -2}), packet.put(std::vector<Vec3>{Vec3{1, 2, 3}});
  PacketReader reader(packet.bytes());
  EXPECT_EQ(reader.integer(), -5);
  EXPECT_EQ(reader.real(), 0.1);
  EXPECT_TRUE(reader.flag());
  EXPECT_EQ(reader.text(), "text");
  EXPECT_EQ(reader.integers(), (std::vector<std::int32_t>{1, -2}));
  EXPECT_EQ(reader.points(), (std::vector<Vec3>{Vec3{1, 2, 3}}));
  EXPECT_TRUE(reader.at_end());
}

TEST(Packet, RefusesBytesThatEndEarly) {
  PacketWriter packet;
  packet.put(std::vector<double>(10, 1.));
  for (std::size_t n = 0; n < packet.bytes().size(); ++n) {
    PacketReader reader(std::string_view(packet.bytes()).substr(0, n));
    EXPECT_THROW(reader.reals(), Error) << n;
  }
}

TEST(Checksum, IsFnv1a) {
  // Of the authors' test vectors.
  EXPECT_EQ(checksum(""), "cbf29ce484222325");
  EXPECT_EQ(checksum("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(checksum("foobar"), "85944171f73967e8");
}

}  // namespace
}  // namespace carreau
