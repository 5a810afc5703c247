// SPDX-License-Identifier: BSD-3-Clause
// carreau_set_team without MPI: ranks are threads of this process, each with its own session.
#include <algorithm>
#include <array>
#include <carreau.hpp>
#include <functional>
#include <mutex>
#include <thread>

#include "abi_fixture.h"
#include "common/meeting.h"

namespace {

/// The data shared by threads that stand for ranks.
struct Office {
  explicit Office(int ranks) : barrier(ranks), given(static_cast<std::size_t>(ranks)) {}

  carreau::testing::Meeting barrier;
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

/// The results that one rank keeps.
struct Kept {
  std::string bytes;
  carreau_part_counts counts{};
  carreau_quality quality{};
  carreau::PartVertices vertices;
  carreau::PartTriangles triangles;
};

std::vector<Kept> kept_by(int ranks, const std::function<carreau::Session()>& make_session) {
  Office office(ranks);
  std::vector<Kept> kept(static_cast<std::size_t>(ranks));
  std::vector<std::thread> threads;
  for (int r = 0; r < ranks; ++r)
    threads.emplace_back([&, r] {
      Rank rank{office, r, {}};
      carreau::Session session = make_session();
      const carreau_team team = rank.team();
      session.set_team(&team);
      carreau::Mesh part;
      session.generate_part(part);
      kept[static_cast<std::size_t>(r)] = {part.encode(".meshb"), part.part_counts(), part.part_quality(), part.part_vertices(), part.part_triangles()};
      session.set_team(nullptr);
    });
  for (std::thread& thread : threads) thread.join();
  return kept;
}

/// The file of all parts.
std::string file_of(const std::vector<Kept>& kept) {
  std::string all;
  for (const Kept& each : kept) {
    all.resize(std::max(all.size(), each.bytes.size()), '\0');
    for (std::size_t k = 0; k < each.bytes.size(); ++k) all[k] = static_cast<char>(all[k] | each.bytes[k]);
  }
  return all;
}

TEST(Team, RanksKeepPartsOfTheMeshOfOneProcess) {
  carreau::Session alone = strip_of_squares();
  alone.generate();
  const std::vector<Kept> kept = kept_by(3, strip_of_squares);
  std::int64_t own = 0;
  for (const Kept& each : kept) {
    own += each.counts.own_triangles;
    EXPECT_EQ(each.counts.all_triangles, alone.mesh().quality().triangles);
    EXPECT_EQ(each.quality.edges, alone.mesh().quality().edges);
    EXPECT_EQ(each.vertices.owners.size(), each.vertices.rows.size());
    EXPECT_LE(static_cast<std::size_t>(each.counts.own_triangles), each.triangles.numbers.size());
  }
  EXPECT_EQ(own, alone.mesh().quality().triangles);
  EXPECT_EQ(file_of(kept), alone.mesh().encode(".meshb"));
}

/// Two bowls z = x^2 + y^2, one .02 above the other and over another square: coarse chords of one cross the other. Rounds part them.
carreau::Session close_bowls(int rounds) {
  carreau::Session session;
  std::vector<carreau::BezierPatch> bowls;
  for (const auto& [low, high, lift] : {std::array{-1., 1., 0.}, {-0.93, 0.97, 0.02}}) {
    carreau::BezierPatch bowl{.m = 2, .n = 2, .controls = {}};
    const std::array<double, 3> x{low, (low + high) / 2, high}, squared{low * low, low * high, high * high};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) bowl.controls.push_back({x[i], x[j], squared[i] + squared[j] + lift});
    bowls.push_back(bowl);
  }
  carreau::add_bezier(session, bowls);
  session.set("hphydef", 0.3);
  session.set("threads", 1);
  session.set("crossing_rounds", rounds);
  return session;
}

TEST(Team, PartsFindTrianglesThatCrossAndSeparateThem) {
  carreau::Session coarse = close_bowls(0), alone = close_bowls(5);
  coarse.generate(), alone.generate();
  ASSERT_GT(alone.mesh().quality().triangles, coarse.mesh().quality().triangles);
  for (const int ranks : {1, 2, 3}) {
    const std::vector<Kept> kept = kept_by(ranks, [] { return close_bowls(5); });
    EXPECT_EQ(file_of(kept), alone.mesh().encode(".meshb")) << ranks;
    for (const Kept& each : kept) EXPECT_EQ(each.counts.crossings, alone.mesh().intersections().count) << ranks;
  }
}

/// A bowl and a strip .001 wide at its border, which narrow_faces=collapse lets vanish.
carreau::Session bowl_with(const char* name, const char* value) {
  carreau::Session session;
  std::vector<carreau::BezierPatch> patches;
  for (const auto& [low, high] : {std::array{0., 1.}, {1., 1.001}, {1.001, 2.}}) {
    const double middle = (low + high) / 2;
    patches.push_back({.m = 2, .n = 1, .controls = {{low, 0, 0}, {low, 1, 0}, {middle, 0, 0.4}, {middle, 1, 0.4}, {high, 0, 0}, {high, 1, 0}}});
  }
  carreau::add_bezier(session, patches);
  session.set("hphydef", 0.2);
  session.set("hgeo_flag", 1);
  session.set("angle_mesh", 8);
  session.set("threads", 1);
  session.set_word(name, value);
  return session;
}

/// Rows are numbers from 0, and each vertex and triangle has one owner.
void expect_one_owner(const std::vector<Kept>& kept, const carreau_quality& whole) {
  std::vector<int> rows(static_cast<std::size_t>(whole.vertices)), triangles(static_cast<std::size_t>(whole.triangles));
  for (std::size_t r = 0; r < kept.size(); ++r) {
    const Kept& each = kept[r];
    for (std::size_t v = 0; v < static_cast<std::size_t>(each.counts.own_vertices); ++v) {
      EXPECT_EQ(each.vertices.owners[v], static_cast<int>(r));
      ++rows.at(static_cast<std::size_t>(each.vertices.rows[v]));
    }
    for (std::size_t t = 0; t < static_cast<std::size_t>(each.counts.own_triangles); ++t) ++triangles.at(static_cast<std::size_t>(each.triangles.numbers[t]));
  }
  EXPECT_EQ(rows, std::vector<int>(rows.size(), 1));
  EXPECT_EQ(triangles, std::vector<int>(triangles.size(), 1));
}

TEST(Team, EveryOptionHasParts) {
  for (const auto& [name, value] : {std::array{"element", "p2"}, {"element", "q1.0"}, {"element", "q2.1"}, {"patches", "independent"},
                                    {"gradation", "1.2"}, {"narrow_faces", "collapse"}, {"cracks", "1"}, {"measure", "1"}, {"flag", "1"}}) {
    SCOPED_TRACE(std::string(name) + " " + value);
    carreau::Session alone = bowl_with(name, value);
    alone.generate();
    const carreau_quality whole = alone.mesh().quality();
    for (const int ranks : {1, 3}) {
      const std::vector<Kept> kept = kept_by(ranks, [&] { return bowl_with(name, value); });
      EXPECT_EQ(file_of(kept), alone.mesh().encode(".meshb")) << ranks;
      expect_one_owner(kept, whole);
      for (const Kept& each : kept) {
        EXPECT_EQ(each.quality.q2_min, whole.q2_min);
        EXPECT_EQ(each.counts.all_triangles, whole.triangles);
      }
    }
  }
}

/// The spout of the teapot crosses its body: it is meshed again in vain.
carreau::Session teapot() {
  carreau::Session session;
  carreau::load_bezier(session, CARREAU_SOURCE_DIR "/fortran_examples/teapot/teapot.bpt");
  session.set("hphydef", 0.3);
  session.set("threads", 1);
  session.set("crossing_rounds", 3);
  return session;
}

TEST(Team, PartsOfTheTeapotCrossWhereItDoes) {
  carreau::Session alone = teapot();
  alone.generate();
  const std::int64_t crossings = alone.mesh().intersections().count;
  ASSERT_GT(crossings, 0);
  const std::vector<Kept> kept = kept_by(4, teapot);
  for (const Kept& each : kept) EXPECT_EQ(each.counts.crossings, crossings);
  EXPECT_EQ(file_of(kept), alone.mesh().encode(".meshb"));
}

TEST(Team, RejectsInvalidRanks) {
  Office office(2);
  Rank rank{office, 2, {}};
  const carreau_team team = rank.team();
  carreau_session* session = nullptr;
  ASSERT_EQ(carreau_session_create(&session), CARREAU_OK);
  EXPECT_EQ(carreau_set_team(session, &team), CARREAU_ERR_ARGUMENT);
  EXPECT_EQ(carreau_set_team(session, nullptr), CARREAU_OK);
  carreau_session_free(session);
}

TEST(Team, EncodesTheContentOfAFile) {
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
