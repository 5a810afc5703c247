// SPDX-License-Identifier: BSD-3-Clause
// carreau_set_team without MPI: ranks are threads of this process, each with a session of its own.
#include <barrier>
#include <carreau.hpp>
#include <mutex>
#include <thread>

#include "abi_fixture.h"

namespace {

/// What threads share that stand for ranks.
struct Office {
  explicit Office(int ranks) : barrier(ranks), given(static_cast<std::size_t>(ranks)) {}

  std::barrier<> barrier;
  std::mutex mutex;
  std::int64_t taken = 0;
  std::vector<std::string> given;
};

/// One of them.
struct Rank {
  Office& office;
  std::int32_t number;
  std::string all;

  static std::int32_t take(std::int64_t count, std::int64_t* out_before, void* user) {
    Office& office = static_cast<Rank*>(user)->office;
    const std::scoped_lock lock(office.mutex);
    *out_before = office.taken;
    office.taken += count;
    return 0;
  }
  static std::int32_t exchange(std::int64_t n, const void* bytes, std::int64_t* out_sizes, const void** out_bytes, void* user) {
    Rank& rank = *static_cast<Rank*>(user);
    Office& office = rank.office;
    office.given[static_cast<std::size_t>(rank.number)].assign(static_cast<const char*>(bytes), static_cast<std::size_t>(n));
    office.barrier.arrive_and_wait();
    rank.all.clear();
    for (std::size_t r = 0; r < office.given.size(); ++r) {
      out_sizes[r] = static_cast<std::int64_t>(office.given[r].size());
      rank.all += office.given[r];
    }
    *out_bytes = rank.all.data();
    if (rank.number == 0) office.taken = 0;
    office.barrier.arrive_and_wait();
    return 0;
  }
  carreau_team team() {
    auto out = abi_tests::sized<carreau_team>();
    out.user = this;
    out.rank = number;
    out.size = static_cast<std::int32_t>(office.given.size());
    out.any_thread = 1;
    out.take = take;
    out.exchange = exchange;
    return out;
  }
};

/// Six squares side by side, joined; each is a face.
carreau::Session strip_of_squares() {
  carreau::Session session;
  std::vector<carreau::BezierPatch> squares;
  for (int i = 0; i < 6; ++i) {
    const double x = i;
    squares.push_back({.m = 1, .n = 1, .controls = {{x, 0, 0}, {x, 1, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}}});
  }
  carreau::add_bezier(session, squares);
  session.set("hphydef", 0.05);
  session.set("threads", 1);
  return session;
}

abi_tests::MeshData made_by(carreau::Session& session) {
  session.generate();
  return abi_tests::data_of(session.mesh().get());
}

TEST(Team, RanksMakeTheMeshOfOneProcess) {
  carreau::Session alone = strip_of_squares();
  const abi_tests::MeshData expected = made_by(alone);
  constexpr int ranks = 3;
  Office office(ranks);
  std::vector<abi_tests::MeshData> found(ranks);
  std::vector<std::thread> threads;
  for (int r = 0; r < ranks; ++r)
    threads.emplace_back([&, r] {
      Rank rank{office, r, {}};
      carreau::Session session = strip_of_squares();
      const carreau_team team = rank.team();
      session.set_team(&team);
      found[static_cast<std::size_t>(r)] = made_by(session);
      session.set_team(nullptr);
    });
  for (std::thread& thread : threads) thread.join();
  for (const abi_tests::MeshData& mesh : found) EXPECT_EQ(mesh, expected);
}

TEST(Team, RefusesARankThatIsNone) {
  Office office(2);
  Rank rank{office, 2, {}};
  const carreau_team team = rank.team();
  carreau_session* session = nullptr;
  ASSERT_EQ(carreau_session_create(&session), CARREAU_OK);
  EXPECT_EQ(carreau_set_team(session, &team), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_set_team(session, nullptr), CARREAU_OK);
  carreau_session_free(session);
}

TEST(Team, EncodesWhatAFileHolds) {
  carreau::Session session = strip_of_squares();
  session.generate();
  const carreau::Mesh mesh = session.mesh();
  const std::string path = testing::TempDir() + "encoded.meshb";
  mesh.write(path);
  std::FILE* file = std::fopen(path.c_str(), "rb");
  ASSERT_NE(file, nullptr);
  std::string written(10'000'000, '\0');
  written.resize(std::fread(written.data(), 1, written.size(), file));
  std::fclose(file);
  std::remove(path.c_str());
  EXPECT_EQ(mesh.encode(".meshb"), written);
  EXPECT_THROW(static_cast<void>(mesh.encode(".none")), carreau::Error);
}

}  // namespace
