// SPDX-License-Identifier: BSD-3-Clause
// Faults inside OpenCASCADE: errors of a face for a program that enables them, and without effect on other programs.
#include <faults.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <Standard_Failure.hxx>
#include <array>
#include <cfenv>
#include <cmath>
#include <csignal>
#include <thread>

#include "measured_mesh.h"
#include "odd_cylinder.h"

namespace {

carreau_occ::ShapeFile file_of(const TopoDS_Shape& shape) { return {.shape = shape, .labels = {}, .unit = ""}; }

// The compiler must not predict these values.
volatile int zero = 0, seven = 7;
int* volatile nowhere = nullptr;

// Sanitizers would report these intended faults before the processor does.
#define CARREAU_TEST_UNWATCHED __attribute__((noinline, no_sanitize("address", "undefined")))
CARREAU_TEST_UNWATCHED void write_nowhere() { *nowhere = 1; }
CARREAU_TEST_UNWATCHED void divide_by_zero() { seven = seven / zero; }

CARREAU_TEST_UNWATCHED void divide_numbers() {
  volatile double x = 0;
  x = 1 / x;
}

CARREAU_TEST_UNWATCHED int descend(int depth) {
  volatile char frame[4096];
  frame[depth % 4096] = 1;
  return zero == 0 ? descend(depth + 1) + frame[depth % 4096] : 0;
}
void recur_without_end() { zero = descend(0) == 0 ? 0 : 0; }

struct Fault {
  const char* name;
  void (*happens)();
  int signal;
};
constexpr Fault faults[] = {{"SIGSEGV", write_nowhere, SIGSEGV},
                            {"NumericError", divide_by_zero, SIGFPE},
                            {"SIGSEGV", recur_without_end, SIGSEGV}};

TEST(Faults, BecomeTheErrorOfTheFace) {
  const carreau_occ::FaultTrap trap;
  for (const Fault& fault : faults)
    for (const int threads : {1, 2}) {
      carreau_occ::BrepHost host(file_of(adapters::odd_cylinder([&](double u, double v) {
        if (adapters::is_inside(u, v)) fault.happens();
      })));
      const auto run = [&](const char* failing_faces) {
        return adapters::mesh_and_measure(host, 0.2, [&](carreau_session* s) {
          carreau_set_integer(s, "threads", threads);
          carreau_set_text(s, "failing_faces", failing_faces);
        });
      };
      const adapters::MeasuredMesh failed = run("stop");
      EXPECT_EQ(failed.status, CARREAU_ERR_CALLBACK);
      EXPECT_NE(failed.error.find("face 1"), std::string::npos) << failed.error;
      EXPECT_NE(host.failure(1).find(fault.name), std::string::npos) << host.failure(1);
      const adapters::MeasuredMesh others = run("leave_out");
      EXPECT_EQ(others.status, CARREAU_ERR_PARTIAL);
      EXPECT_EQ(others.failed.size(), 1U);
      EXPECT_NEAR(others.quality.area, 2 * std::acos(-1.0), 0.05);  // the two lids
    }
}

// A failure on a boundary is known before meshing, and costs no second run.
TEST(Faults, OnTheBoundaryLeaveTheFaceOutAtOnce) {
  const carreau_occ::FaultTrap trap;
  for (const Fault& fault : faults) {
    carreau_occ::BrepHost host(file_of(adapters::odd_cylinder([&](double, double v) {
      if (v > 1.9) fault.happens();
    })));
    ASSERT_EQ(host.excluded().size(), 1U);
    EXPECT_EQ(host.excluded().front().first, 1);
    EXPECT_NE(host.excluded().front().second.find(fault.name), std::string::npos);
    EXPECT_NEAR(host.diagonal(), 2 * std::sqrt(3.0), 1e-6);
    const adapters::MeasuredMesh others = adapters::mesh_and_measure(host, 0.2);
    EXPECT_EQ(others.status, CARREAU_ERR_PARTIAL);
    ASSERT_EQ(others.failed.size(), 1U);
    EXPECT_NE(others.failed.front().find(fault.name), std::string::npos);
    EXPECT_NEAR(others.quality.area, 2 * std::acos(-1.0), 0.05);  // the two lids
  }
}

TEST(Faults, BelongToTheirThread) {
  const carreau_occ::FaultTrap trap;
  for (int i = 0; i < 3; ++i) {
    std::array<int, 4> caught{};
    std::vector<std::thread> threads;
    for (int& mine : caught)
      threads.emplace_back([&mine] {
        for (const Fault& fault : faults) try {
            carreau_occ::guarded(fault.happens);
          } catch (const Standard_Failure& failure) {
            mine += std::string(failure.DynamicType()->Name()).find(fault.name) != std::string::npos ? 1 : 0;
          }
      });
    for (std::thread& thread : threads) thread.join();
    for (const int n : caught) EXPECT_EQ(n, 3);
  }
}

// Traps of the caller stay set after a fault.
TEST(Faults, LeaveTheProcessorsModesAsTheyWere) {
  const carreau_occ::FaultTrap trap;
  std::fenv_t before;
  std::fegetenv(&before);
  std::feclearexcept(FE_ALL_EXCEPT);
  feenableexcept(FE_DIVBYZERO);
  std::fesetround(FE_DOWNWARD);
  for (int i = 0; i < 2; ++i) EXPECT_THROW(carreau_occ::guarded(divide_numbers), Standard_Failure);
  EXPECT_EQ(fegetexcept(), FE_DIVBYZERO);
  EXPECT_EQ(std::fegetround(), FE_DOWNWARD);
  std::fesetenv(&before);
}

void own_handler(int) { _exit(42); }

TEST(Faults, SignalHandlersOfTheProgramStay) {
  struct sigaction own {
  }, found{};
  own.sa_handler = own_handler;
  std::array<struct sigaction, 4> before{};
  const std::array signals{SIGSEGV, SIGBUS, SIGFPE, SIGILL};
  for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &own, &before[i]);
  {
    const carreau_occ::FaultTrap trap;
    { const carreau_occ::FaultTrap second; }
    EXPECT_THROW(carreau_occ::guarded(write_nowhere), Standard_Failure);
  }
  for (const int signal : signals) {
    sigaction(signal, nullptr, &found);
    EXPECT_EQ(found.sa_handler, own_handler);
  }
  // Reading and meshing change nothing either.
  carreau_occ::BrepHost host(file_of(adapters::odd_cylinder([](double, double) {})));
  EXPECT_EQ(adapters::mesh_and_measure(host, 0.5).trouble(true), "");
  for (std::size_t i = 0; i < signals.size(); ++i) {
    sigaction(signals[i], &before[i], &found);
    EXPECT_EQ(found.sa_handler, own_handler);
  }
}

TEST(FaultsDeathTest, OutsideOfOpenCascadeOrNotTrappedAreAsEver) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  // A sanitizer's handler counts as a handler of the program: the test requires the default.
  const auto by_default = [] {
    for (const int signal : {SIGSEGV, SIGFPE}) std::signal(signal, SIG_DFL);
  };
  for (const Fault& fault : faults) {
    if (fault.happens == recur_without_end) continue;
    EXPECT_EXIT(by_default(); carreau_occ::guarded(fault.happens), testing::KilledBySignal(fault.signal), "");
    EXPECT_EXIT(by_default(); const carreau_occ::FaultTrap trap;
                fault.happens(), testing::KilledBySignal(fault.signal), "");
  }
  EXPECT_EXIT(by_default(); const carreau_occ::FaultTrap trap;
              carreau_occ::guarded([] { raise(SIGSEGV); }), testing::KilledBySignal(SIGSEGV), "");
  EXPECT_EXIT(std::signal(SIGSEGV, own_handler); const carreau_occ::FaultTrap trap;
              write_nowhere(), testing::ExitedWithCode(42), "");
}

}  // namespace
