// SPDX-License-Identifier: BSD-3-Clause
// A host that goes wrong at its n-th callback, for every n of a run.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "abi_fixture.h"

namespace abi_tests {
namespace {

enum class Wrong { status, nan, infinity, huge, large, exception };

/// Hands every callback on to another host; that number `at` of all of them goes wrong.
struct Saboteur {
  carreau_cad inner{};
  std::int64_t calls = 0, at = 0;  // from 1; 0: none
  Wrong how = Wrong::status;

  /// Spoils `value` when its turn has come.
  std::int32_t pass(std::int32_t status, double* value) {
    if (++calls != at) return status;
    switch (how) {
      case Wrong::status:
        return 42;
      case Wrong::nan:
        *value = std::numeric_limits<double>::quiet_NaN();
        break;
      case Wrong::infinity:
        *value = std::numeric_limits<double>::infinity();
        break;
      case Wrong::huge:
        *value = 1e300;
        break;
      case Wrong::large:
        *value = 1e7;
        break;
      case Wrong::exception:
        throw std::runtime_error("thrown on purpose");
    }
    return status;
  }

  static std::int32_t surface(std::int32_t face, double u, double v, std::int32_t order, double* S, double* Su,
                              double* Sv, double* Suu, double* Suv, double* Svv, void* user) {
    auto* self = static_cast<Saboteur*>(user);
    return self->pass(self->inner.surface(face, u, v, order, S, Su, Sv, Suu, Suv, Svv, self->inner.user), S + 1);
  }
  static std::int32_t interval(std::int32_t face, std::int32_t ic, double* a, double* b, void* user) {
    auto* self = static_cast<Saboteur*>(user);
    return self->pass(self->inner.curve_interval(face, ic, a, b, self->inner.user), b);
  }
  static std::int32_t curve(std::int32_t face, std::int32_t ic, double t, std::int32_t order, double* C, double* Ct,
                            double* Ctt, void* user) {
    auto* self = static_cast<Saboteur*>(user);
    return self->pass(self->inner.curve(face, ic, t, order, C, Ct, Ctt, self->inner.user), C);
  }
  static std::int32_t surface_size(std::int32_t, double, double, double* value, void* user) {
    *value = 1.5;
    return static_cast<Saboteur*>(user)->pass(0, value);
  }
  static std::int32_t curve_size(std::int32_t, std::int32_t, double, double* value, void* user) {
    *value = 1.5;
    return static_cast<Saboteur*>(user)->pass(0, value);
  }
  static std::int32_t point_size(std::int32_t, double* value, void* user) {
    *value = 1.5;
    return static_cast<Saboteur*>(user)->pass(0, value);
  }
};

class InjectionTest : public SessionTest {
 protected:
  /// A torus with a size callback everywhere, and its mesh.
  void SetUp() override {
    SessionTest::SetUp();
    host.session = session;
    saboteur.inner = torus_cad(&host);
    carreau_cad cad = saboteur.inner;
    cad.user = &saboteur;
    cad.surface = Saboteur::surface;
    cad.curve_interval = Saboteur::interval;
    cad.curve = Saboteur::curve;
    cad.surface_size = Saboteur::surface_size;
    cad.curve_size = Saboteur::curve_size;
    cad.point_size = Saboteur::point_size;
    ASSERT_EQ(carreau_set_cad(session, &cad), CARREAU_OK) << error();
    ASSERT_EQ(torus_model(session), CARREAU_OK) << error();
    ASSERT_EQ(carreau_set_integer(session, "hphy_flag", 2), CARREAU_OK);
    ASSERT_EQ(carreau_set_real(session, "angle_smo", 8), CARREAU_OK);
    ASSERT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
    ASSERT_EQ(defects_of(mesh(), true), "");
    before = data_of(mesh());
    calls_of_a_run = saboteur.calls;
  }

  /// Gives the number of runs that failed.
  std::int64_t sabotage(Wrong how, const std::function<void(carreau_status)>& check) {
    std::int64_t failed = 0;
    MeshData latest = before;
    for (std::int64_t n = 1; n <= calls_of_a_run; ++n) {
      saboteur.calls = 0;
      saboteur.at = n;
      saboteur.how = how;
      const carreau_status status = carreau_mesh_generate(session);
      const std::string sentence = error();
      check(status);
      if (status != CARREAU_OK) {
        ++failed;
        EXPECT_NE(sentence, "") << n;
        if (status != CARREAU_ERR_PARTIAL) {
          EXPECT_TRUE(data_of(mesh()) == latest) << n;  // the mesh of the run before
        }
      }
      if (HasFailure()) {
        ADD_FAILURE() << "at callback " << n << ": " << carreau_status_name(status) << ": " << sentence;
        break;
      }
      latest = data_of(mesh());
    }
    saboteur.at = 0;
    EXPECT_EQ(carreau_mesh_generate(session), CARREAU_OK) << error();
    EXPECT_TRUE(data_of(mesh()) == before);
    return failed;
  }

  /// Wrong answers of a host do not stop the run while its derivatives are tested on a few points.
  void expect_callback_error_or_the_same_mesh(carreau_status status, const std::string& word) {
    if (status == CARREAU_OK) {
      EXPECT_TRUE(data_of(mesh()) == before);
      return;
    }
    EXPECT_EQ(status, CARREAU_ERR_CALLBACK);
    EXPECT_NE(error().find(word), std::string::npos) << error();
  }

  Saboteur saboteur;
  MeshData before;
  std::int64_t calls_of_a_run = 0;
};

TEST_F(InjectionTest, AStatusAtAnyCallStopsTheRunAndNothingElse) {
  const auto check = [&](carreau_status status) {
    // The host is not called again.
    if (status != CARREAU_OK) {
      EXPECT_EQ(saboteur.calls, saboteur.at);
    }
    expect_callback_error_or_the_same_mesh(status, "42");
  };
  EXPECT_GT(sabotage(Wrong::status, check), calls_of_a_run / 2);
}

TEST_F(InjectionTest, NotANumberAtAnyCallStopsTheRun) {
  const auto check = [&](carreau_status status) { expect_callback_error_or_the_same_mesh(status, "not finite"); };
  EXPECT_GT(sabotage(Wrong::nan, check), calls_of_a_run / 2);
}

TEST_F(InjectionTest, InfinityAtAnyCallStopsTheRun) {
  const auto check = [&](carreau_status status) { expect_callback_error_or_the_same_mesh(status, "not finite"); };
  EXPECT_GT(sabotage(Wrong::infinity, check), calls_of_a_run / 2);
}

TEST_F(InjectionTest, AnExceptionAtAnyCallBecomesAStatusWithItsText) {
  const auto check = [&](carreau_status status) {
    expect_callback_error_or_the_same_mesh(status, "thrown on purpose");
  };
  EXPECT_GT(sabotage(Wrong::exception, check), calls_of_a_run / 2);
}

// A value that is finite but absurd may pass for a size, whose limits it obeys; it must not make a mesh with holes.
TEST_F(InjectionTest, AHugeValueAtAnyCallIsRejectedOrLeavesASoundMesh) {
  const auto check = [&](carreau_status status) {
    if (status != CARREAU_OK && status != CARREAU_ERR_PARTIAL) return;
    EXPECT_EQ(defects_of(mesh(), status == CARREAU_OK), "");
    if (const MeshData data = data_of(mesh()); !data.xyz.empty()) {
      EXPECT_LT(*std::max_element(data.xyz.begin(), data.xyz.end()), 5);
    }
  };
  sabotage(Wrong::huge, check);
  sabotage(Wrong::large, check);
}

}  // namespace
}  // namespace abi_tests
