// SPDX-License-Identifier: BSD-3-Clause
#include "cad/checked_cad.h"

#include <gtest/gtest.h>

#include <limits>

#include "cad/host_cad.h"
#include "support/infinity.h"
#include "surfaces.h"

namespace carreau {
namespace {

using namespace testing;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Answers every size and radius with one number.
struct SizedCad : FaceCad {
  std::optional<double> value;
  std::optional<double> surface_size(int, Vec2) override { return value; }
  std::optional<double> curve_size(int, int, double) override { return value; }
  std::optional<double> point_size(int) override { return value; }
  std::optional<double> surface_radius(int, Vec2) override { return value; }
  std::optional<double> curve_radius(int, int, double) override { return value; }
};

TEST(CheckedCad, NamesTheRoutineWithNonFiniteValues) {
  FaceCad host;
  CheckedCad cad(host);
  SurfaceJet broken = enneper_jet({1, 2});
  host.jet = [&](Vec2) { return broken; };
  const auto sentence = [&](unsigned want) { return callback_error([&] { surface_at(cad, 4, want, {0.5, 2}); }); };
  broken.s.y() = nan;
  EXPECT_EQ(sentence(want_position), "face 4, u = 0.5, v = 2: surf0 returned a value that is not finite");
  EXPECT_EQ(sentence(want_first), "");  // it ignores derivatives that are not requested
  broken = enneper_jet({1, 2});
  broken.sv.x() = infinity;
  EXPECT_EQ(sentence(want_first | want_position), "face 4, u = 0.5, v = 2: surf1 returned a value that is not finite");
  broken = enneper_jet({1, 2});
  broken.suv.z() = -infinity;
  EXPECT_EQ(sentence(want_second), "face 4, u = 0.5, v = 2: surf2 returned a value that is not finite");
}

TEST(CheckedCad, NamesTheCurveWithNonFiniteValues) {
  FaceCad host;
  CheckedCad cad(host);
  host.along = [](double) { return CurveJet{{1, nan}, {nan, 0}, {0, infinity}}; };
  EXPECT_EQ(callback_error([&] { cad.curve(2, 3, want_position, 0.25); }),
            "face 2, curve 3, t = 0.25: curv0 returned a value that is not finite");
  EXPECT_EQ(callback_error([&] { cad.curve(2, 3, want_first, 0.25); }),
            "face 2, curve 3, t = 0.25: curv1 returned a value that is not finite");
  EXPECT_EQ(callback_error([&] { cad.curve(2, 3, want_second, 0.25); }),
            "face 2, curve 3, t = 0.25: curv2 returned a value that is not finite");
}

TEST(CheckedCad, RejectsIntervalsThatAreReversedEmptyOrNotFinite) {
  FaceCad host;
  CheckedCad cad(host);
  host.interval = {1, 0};
  EXPECT_EQ(callback_error([&] { cad.curve_interval(1, 2); }),
            "face 1, curve 2: curv_int returned the interval [1, 0], which is reversed or empty");
  for (const Interval bad : {Interval{3, 3}, Interval{nan, 1}, Interval{0, infinity}, Interval{-infinity, 0}}) {
    host.interval = bad;
    EXPECT_NE(callback_error([&] { cad.curve_interval(1, 2); }), "");
  }
  host.interval = {-2, 5};
  EXPECT_EQ(cad.curve_interval(1, 2).b, 5);
}

TEST(CheckedCad, RejectsSizesThatAreNotFiniteAndRadiiThatAreNotNumbers) {
  SizedCad host;
  CheckedCad cad(host);
  host.value = infinity;
  EXPECT_EQ(callback_error([&] {
              cad.surface_size(1, {0, 0});
            }),
            "face 1, u = 0, v = 0: cad_hphys returned a value that is not finite");
  EXPECT_EQ(callback_error([&] { cad.curve_size(1, 2, 0.5); }),
            "face 1, curve 2, t = 0.5: cad_hphyc returned a value that is not finite");
  EXPECT_EQ(callback_error([&] { cad.point_size(9); }),
            "point of reference 9: cad_hphyp returned a value that is not finite");
  for (const double bad : {0.0, -0.5}) {
    host.value = bad;
    const std::string text = bad == 0 ? "0" : "-0.5";
    EXPECT_EQ(callback_error([&] {
                cad.surface_size(1, {0.25, 0.5});
              }),
              "face 1, u = 0.25, v = 0.5: cad_hphys returned the size " + text + ", which is not positive");
    EXPECT_EQ(callback_error([&] { cad.curve_size(1, 2, 0.5); }),
              "face 1, curve 2, t = 0.5: cad_hphyc returned the size " + text + ", which is not positive");
    EXPECT_EQ(callback_error([&] { cad.point_size(9); }),
              "point of reference 9: cad_hphyp returned the size " + text + ", which is not positive");
  }
  host.value = infinity;
  // A plane, a straight line (RT-0232 sec. 3.1.3 b).
  EXPECT_EQ(cad.surface_radius(1, {0, 0}), infinity);
  EXPECT_EQ(cad.curve_radius(1, 1, 0), infinity);
  host.value = nan;
  EXPECT_EQ(callback_error([&] {
              cad.surface_radius(1, {0, 0});
            }),
            "face 1, u = 0, v = 0: cad_rads returned a value that is not a number");
  EXPECT_EQ(callback_error([&] { cad.curve_radius(1, 2, 0); }),
            "face 1, curve 2, t = 0: cad_radc returned a value that is not a number");
  host.value.reset();
  EXPECT_FALSE(cad.surface_size(1, {0, 0}));
  EXPECT_FALSE(cad.curve_radius(1, 1, 0));
}

TEST(CheckedCad, CountsEachRoutineAndPointOnce) {
  SizedCad host;
  CheckedCad cad(host);
  const std::vector<Vec2> points(17, Vec2{0.1, 0.2});
  std::vector<SurfaceJet> jets(points.size());
  cad.surface(1, want_position, points, jets);
  cad.surface(1, want_position | want_first, points, jets);
  surface_at(cad, 1, want_second, {0, 0});
  cad.curve(1, 1, want_position, 0);
  cad.curve(1, 1, want_first | want_second, 0);
  cad.surface_size(1, {0, 0});
  cad.point_size(1);
  EXPECT_EQ(cad.counts(),
            (CallCounts{.surf0 = 34, .surf1 = 17, .surf2 = 1, .curv0 = 1, .curv1 = 1, .curv2 = 1, .sizes = 2}));
  EXPECT_EQ(cad.counts().surface(), 52);
  EXPECT_EQ(host.calls.surf0, 34);
}

TEST(CheckedCad, CountsTheFiniteDifferencesOfTheHostSinceItsOwnBeginning) {
  static int calls = 0;
  calls = 0;
  CadMTable table;
  table.surf0 = [](const std::int32_t*, const double* uv, double* s) {
    ++calls;
    s[0] = uv[0], s[1] = uv[1], s[2] = uv[0] * uv[1];
  };
  table.curv_int = [](const std::int32_t*, const std::int32_t*, double* a, double* b) { *a = 0, *b = 1; };
  table.curv0 = [](const std::int32_t*, const std::int32_t*, const double* t, double* c) { c[0] = *t, c[1] = 0; };
  HostCad host(table);
  surface_at(host, 1, want_position, {0, 0});
  CheckedCad cad(host);
  surface_at(cad, 1, want_position | want_first, {0.5, 0.5});
  EXPECT_EQ(cad.counts().surf0, calls - 1);
  EXPECT_EQ(cad.counts().surf0, 5);
  EXPECT_EQ(cad.counts().surf1, 0);
}

}  // namespace
}  // namespace carreau
