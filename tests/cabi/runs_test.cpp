// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cfenv>
#include <cmath>
#include <filesystem>
#include <thread>

#include "abi_fixture.h"

namespace abi_tests {
namespace {

class FailingHostTest : public SessionTest {
 protected:
  /// The session has a mesh; then the host misbehaves from a call in the midst of a run.
  void SetUp() override {
    SessionTest::SetUp();
    use_paraboloid(0.5);
    ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
    before = data_of(mesh());
    middle = host.calls / 2;
  }
  carreau_status run_with(std::int32_t misbehaviour, std::int64_t from) {
    host.calls = 0;
    host.misbehaviour = misbehaviour;
    host.misbehave_from = from;
    return carreau_mesh_generate(session);
  }
  void expect_old_mesh_and_a_usable_session() {
    EXPECT_TRUE(data_of(mesh()) == before);
    host.misbehaviour = HOST_FINE;
    EXPECT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
    EXPECT_TRUE(data_of(mesh()) == before);
  }

  MeshData before;
  std::int64_t middle = 0;
};

TEST_F(FailingHostTest, NotANumberStopsTheRunAndIsNamed) {
  for (const std::int64_t from : {std::int64_t{1}, middle}) {
    EXPECT_EQ(run_with(HOST_NAN, from), CARREAU_ERR_CALLBACK);
    EXPECT_NE(error().find("face 1"), std::string::npos) << error();
    EXPECT_NE(error().find("surf0 returned a value that is not finite"), std::string::npos) << error();
    auto place = sized<carreau_error_place>();
    ASSERT_EQ(carreau_last_error_place(session, &place), CARREAU_OK);
    EXPECT_EQ(place.face, 1);
    EXPECT_LE(std::abs(place.uv[0]), 2.5);
    EXPECT_LE(std::abs(place.uv[1]), 2.5);
    EXPECT_NE(error().find("u = "), std::string::npos) << error();
  }
  expect_old_mesh_and_a_usable_session();
}

TEST_F(FailingHostTest, InfinityStopsTheRunAndIsNamed) {
  EXPECT_EQ(run_with(HOST_INFINITY, middle), CARREAU_ERR_CALLBACK);
  EXPECT_NE(error().find("surf0 returned a value that is not finite"), std::string::npos) << error();
  expect_old_mesh_and_a_usable_session();
}

TEST_F(FailingHostTest, AStatusStopsTheRunAndIsNamed) {
  EXPECT_EQ(run_with(HOST_STATUS, middle), CARREAU_ERR_CALLBACK);
  EXPECT_NE(error().find("42"), std::string::npos) << error();
  EXPECT_NE(error().find("face 1"), std::string::npos) << error();
  expect_old_mesh_and_a_usable_session();
}

TEST_F(FailingHostTest, AReversedIntervalIsNamed) {
  EXPECT_EQ(run_with(HOST_REVERSED_INTERVAL, 0), CARREAU_ERR_CALLBACK);
  EXPECT_NE(error().find("face 1, curve 1"), std::string::npos) << error();
  auto place = sized<carreau_error_place>();
  ASSERT_EQ(carreau_last_error_place(session, &place), CARREAU_OK);
  EXPECT_EQ(place.ic, 1);
  EXPECT_TRUE(std::isnan(place.uv[0]));
  expect_old_mesh_and_a_usable_session();
}

TEST_F(FailingHostTest, AWrongDerivativeIsFoundBeforeMeshing) {
  EXPECT_EQ(run_with(HOST_WRONG_DERIVATIVE, 0), CARREAU_ERR_CALLBACK);
  EXPECT_NE(error().find("face 1"), std::string::npos) << error();
  expect_old_mesh_and_a_usable_session();
}

TEST_F(FailingHostTest, CallsFromInsideACallbackAreRejected) {
  host.probe_busy = 1;
  host.busy_status = CARREAU_OK;
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  EXPECT_EQ(host.busy_status, CARREAU_ERR_BUSY);
  double hphydef = 0;
  EXPECT_EQ(carreau_get_real(session, "hphydef", &hphydef), CARREAU_OK);
  EXPECT_EQ(hphydef, 0.5);
}

// ---- stop ----

TEST_F(FailingHostTest, AStopFromACallbackIsObeyedBeforeTheNextOne) {
  for (const std::int64_t at : {std::int64_t{1}, middle, 2 * middle - 1}) {
    host.calls = 0;
    host.stop_at = at;
    EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_CANCELLED);
    EXPECT_EQ(host.calls, at);
    EXPECT_EQ(error(), "stopped by the host");
  }
  host.stop_at = 0;
  expect_old_mesh_and_a_usable_session();
}

struct ProgressLog {
  std::vector<double> fractions;
  std::vector<std::int32_t> phases;
  std::int64_t stop_at = -1;
};

std::int32_t log_progress(std::int32_t phase, std::int32_t, double fraction, void* user) {
  auto* log = static_cast<ProgressLog*>(user);
  log->phases.push_back(phase);
  log->fractions.push_back(fraction);
  return std::int64_t(log->fractions.size()) == log->stop_at ? 1 : 0;
}

TEST_F(FailingHostTest, ProgressGrowsAndCanStopTheRun) {
  ProgressLog log;
  ASSERT_EQ(carreau_set_progress_callback(session, log_progress, &log), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  ASSERT_GE(log.fractions.size(), 3u);
  for (std::size_t i = 0; i < log.fractions.size(); ++i) {
    EXPECT_GE(log.fractions[i], i == 0 ? 0 : log.fractions[i - 1]);
    EXPECT_LE(log.fractions[i], 1);
    EXPECT_GE(log.phases[i], CARREAU_PHASE_IDLE);
    EXPECT_LE(log.phases[i], CARREAU_PHASE_WRITING);
  }
  EXPECT_EQ(log.fractions.back(), 1);
  const std::size_t reports = log.fractions.size();
  log = {};
  log.stop_at = 2;
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_CANCELLED);
  EXPECT_LT(log.fractions.size(), reports);
  ASSERT_EQ(carreau_set_progress_callback(session, nullptr, nullptr), CARREAU_OK);
  expect_old_mesh_and_a_usable_session();
}

TEST_F(FailingHostTest, ProgressNeverFallsWhateverTheRunConsistsOf) {
  ASSERT_EQ(carreau_set_integer(session, "measure", 1), CARREAU_OK);
  ASSERT_EQ(carreau_set_real(session, "gradation", 1.5), CARREAU_OK);
  ProgressLog log;
  ASSERT_EQ(carreau_set_progress_callback(session, log_progress, &log), CARREAU_OK);
  const auto expect_growth = [&](std::int32_t phase) {
    EXPECT_TRUE(std::is_sorted(log.fractions.begin(), log.fractions.end()));
    EXPECT_NE(std::find(log.phases.begin(), log.phases.end(), phase), log.phases.end());
    ASSERT_FALSE(log.fractions.empty());
    EXPECT_GT(log.fractions.back(), log.fractions.front());
    log = {};
  };
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  EXPECT_EQ(log.fractions.back(), 1);
  expect_growth(CARREAU_PHASE_MEASURE);
  const std::string path = testing::TempDir() + "carreau_progress.exr";
  carreau_exr_options options{};
  options.struct_size = sizeof options;
  options.longest = 64, options.multi_part = 1;
  ASSERT_EQ(carreau_write_exr(session, path.c_str(), &options), CARREAU_OK) << error();
  expect_growth(CARREAU_PHASE_WRITING);
  std::filesystem::remove(path);
  ASSERT_EQ(carreau_set_progress_callback(session, nullptr, nullptr), CARREAU_OK);
}

TEST_F(FailingHostTest, AStopWithoutARunDoesNothing) {
  carreau_stop(session);
  expect_old_mesh_and_a_usable_session();
}

struct MessageLog {
  std::vector<std::int32_t> levels;
  std::vector<std::string> texts;
};

void log_message(std::int32_t level, const char* text, void* user) {
  static_cast<MessageLog*>(user)->levels.push_back(level);
  static_cast<MessageLog*>(user)->texts.emplace_back(text);
}

TEST_F(FailingHostTest, MessagesComeUpToTheLevelOfVerb) {
  MessageLog log;
  ASSERT_EQ(carreau_set_message_callback(session, log_message, &log), CARREAU_OK);
  ASSERT_EQ(carreau_set_integer(session, "verb", 1), CARREAU_OK);
  ASSERT_EQ(carreau_set_real(session, "eps_ends", 100), CARREAU_OK);  // every curve is reported as short: warnings
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  EXPECT_GE(log.levels.size(), 4u);
  for (std::size_t i = 0; i < log.levels.size(); ++i) {
    EXPECT_LE(log.levels[i], 1);
    EXPECT_EQ(log.texts[i].find('\n'), std::string::npos);
  }
  log = {};
  ASSERT_EQ(carreau_set_integer(session, "verb", 0), CARREAU_OK);
  ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
  EXPECT_TRUE(log.levels.empty());
}

// ---- independence ----

MeshData mesh_alone(double h) {
  carreau_session* session = nullptr;
  EXPECT_EQ(mesh_paraboloid(h, &session), CARREAU_OK) << carreau_last_error(session);
  carreau_mesh* mesh = nullptr;
  EXPECT_EQ(carreau_session_mesh(session, &mesh), CARREAU_OK);
  MeshData data = data_of(mesh);
  carreau_session_free(session);
  return data;
}

TEST(Sessions, InTwoThreadsAtOnceGiveTheMeshOfOneAlone) {
  const MeshData fine = mesh_alone(0.12), coarse = mesh_alone(0.2);
  for (int round = 0; round < 3; ++round) {
    MeshData in_thread;
    std::thread other([&] { in_thread = mesh_alone(0.12); });
    EXPECT_TRUE(mesh_alone(0.2) == coarse);
    other.join();
    EXPECT_TRUE(in_thread == fine);
  }
}

TEST(Sessions, DoNotDependOnTheFloatingPointEnvironmentNorChangeIt) {
  const MeshData expected = mesh_alone(0.3);
  std::fenv_t kept;
  ASSERT_EQ(std::fegetenv(&kept), 0);
  std::feclearexcept(FE_ALL_EXCEPT);
  ASSERT_EQ(std::fesetround(FE_DOWNWARD), 0);
  std::feraiseexcept(FE_UNDERFLOW);
#ifdef __GLIBC__
  feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);  // as gfortran -ffpe-trap does: a signal on the first NaN
#endif
  carreau_session* session = nullptr;
  const carreau_status status = mesh_paraboloid(0.3, &session);
  const int rounding = std::fegetround(), flags = std::fetestexcept(FE_ALL_EXCEPT);
#ifdef __GLIBC__
  const int traps = fegetexcept();
#endif
  std::fesetenv(&kept);
  ASSERT_EQ(status, CARREAU_OK) << carreau_last_error(session);
  EXPECT_EQ(rounding, FE_DOWNWARD);
  EXPECT_EQ(flags, FE_UNDERFLOW);
#ifdef __GLIBC__
  EXPECT_EQ(traps, FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
#endif
  carreau_mesh* mesh = nullptr;
  ASSERT_EQ(carreau_session_mesh(session, &mesh), CARREAU_OK);
  EXPECT_TRUE(data_of(mesh) == expected);
  carreau_session_free(session);
}

// A stop from another thread, in the midst of pure computation.
TEST_F(SessionTest, CanBeStoppedFromAnotherThread) {
  use_paraboloid(0.012);  // some 800 000 triangles
  ASSERT_EQ(carreau_set_real(session, "hphymin", 1e-3), CARREAU_OK);
  struct Waiting {
    std::thread thread;
    carreau_session* session;
  } waiting{{}, session};
  // The thread starts when the patches do, and requests the stop some time later.
  const auto start = [](std::int32_t phase, std::int32_t, double, void* user) -> std::int32_t {
    auto* w = static_cast<Waiting*>(user);
    if (phase == CARREAU_PHASE_PATCHES && !w->thread.joinable())
      w->thread = std::thread([s = w->session] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        carreau_stop(s);
      });
    return 0;
  };
  ASSERT_EQ(carreau_set_progress_callback(session, start, &waiting), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_CANCELLED) << error();
  ASSERT_TRUE(waiting.thread.joinable());
  waiting.thread.join();
  carreau_mesh* mesh = nullptr;
  EXPECT_EQ(carreau_session_mesh(session, &mesh), CARREAU_ERR_SEQUENCE);
}

TEST_F(SessionTest, AMeshAboveTheLimitIsRejected) {
  use_paraboloid(0.1);
  ASSERT_EQ(carreau_set_integer(session, "max_triangles", 1000), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_ERR_LIMIT);
  EXPECT_NE(error().find("1000"), std::string::npos) << error();
  ASSERT_EQ(carreau_set_integer(session, "max_triangles", 0), CARREAU_OK);
  EXPECT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
}

}  // namespace
}  // namespace abi_tests
