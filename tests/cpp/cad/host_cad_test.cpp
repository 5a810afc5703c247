// SPDX-License-Identifier: BSD-3-Clause
#include "cad/host_cad.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "cad/checked_cad.h"
#include "support/infinity.h"
#include "surfaces.h"

namespace carreau {
namespace {

using namespace testing;

constexpr unsigned everything = want_position | want_first | want_second;

void put(Vec3 v, double* out) { out[0] = v.x(), out[1] = v.y(), out[2] = v.z(); }
void put(Vec2 v, double* out) { out[0] = v.x(), out[1] = v.y(); }
Vec2 taken(const double* uv) { return {uv[0], uv[1]}; }

// The face's reference is the torus' big radius, so that a reference that is lost shows.
SurfaceJet face_jet(int face, Vec2 p) { return torus_jet(p, face, 0.7); }
CurveJet curve_jet(int face, int ic, double t) {
  return {{face * t, ic * t * t}, {static_cast<double>(face), 2 * ic * t}, {0, 2.0 * ic}};
}

CadMTable cad_m() {
  CadMTable table;
  table.surf0 = [](const std::int32_t* refs, const double* uv, double* s) { put(face_jet(*refs, taken(uv)).s, s); };
  table.surf1 = [](const std::int32_t* refs, const double* uv, double* su, double* sv) {
    put(face_jet(*refs, taken(uv)).su, su);
    put(face_jet(*refs, taken(uv)).sv, sv);
  };
  table.surf2 = [](const std::int32_t* refs, const double* uv, double* suu, double* suv, double* svv) {
    put(face_jet(*refs, taken(uv)).suu, suu);
    put(face_jet(*refs, taken(uv)).suv, suv);
    put(face_jet(*refs, taken(uv)).svv, svv);
  };
  table.curv_int = [](const std::int32_t* refs, const std::int32_t* ic, double* a, double* b) {
    *a = *refs, *b = *refs + *ic;
  };
  table.curv0 = [](const std::int32_t* refs, const std::int32_t* ic, const double* t, double* c) {
    put(curve_jet(*refs, *ic, *t).c, c);
  };
  table.curv1 = [](const std::int32_t* refs, const std::int32_t* ic, const double* t, double* c) {
    put(curve_jet(*refs, *ic, *t).ct, c);
  };
  table.curv2 = [](const std::int32_t* refs, const std::int32_t* ic, const double* t, double* c) {
    put(curve_jet(*refs, *ic, *t).ctt, c);
  };
  return table;
}

/// The data of the test that the callbacks of a C host see.
struct User {
  std::int32_t status = 0;
  std::int64_t calls = 0, largest_batch = 0;
  std::int32_t last_order = -1;
  double size = 0.5;
  bool writes = true;
};

HostTable host(User& user) {
  HostTable table;
  table.user = &user;
  table.surface = [](std::int32_t face, double u, double v, std::int32_t order, double* s, double* su, double* sv,
                     double* suu, double* suv, double* svv, void* data) {
    auto& known = *static_cast<User*>(data);
    ++known.calls;
    known.last_order = order;
    const SurfaceJet jet = face_jet(face, {u, v});
    if (!known.writes) return known.status;
    put(jet.s, s);
    if (order >= 1) put(jet.su, su), put(jet.sv, sv);
    if (order >= 2) put(jet.suu, suu), put(jet.suv, suv), put(jet.svv, svv);
    return known.status;
  };
  table.curve_interval = [](std::int32_t face, std::int32_t ic, double* a, double* b, void* data) {
    *a = face, *b = face + ic;
    return static_cast<User*>(data)->status;
  };
  table.curve = [](std::int32_t face, std::int32_t ic, double t, std::int32_t order, double* c, double* ct, double* ctt,
                   void* data) {
    const CurveJet jet = curve_jet(face, ic, t);
    put(jet.c, c);
    if (order >= 1) put(jet.ct, ct);
    if (order >= 2) put(jet.ctt, ctt);
    return static_cast<User*>(data)->status;
  };
  return table;
}

std::int32_t batch(std::int32_t face, std::int64_t n, const double* uv, std::int32_t order, double* s, double* su,
                   double* sv, double* suu, double* suv, double* svv, void* data) {
  auto& known = *static_cast<User*>(data);
  ++known.calls;
  known.largest_batch = std::max(known.largest_batch, n);
  EXPECT_EQ(su != nullptr, order >= 1);
  EXPECT_EQ(svv != nullptr, order >= 2);
  for (std::int64_t i = 0; i < n; ++i) {
    const SurfaceJet jet = face_jet(face, {uv[2 * i], uv[2 * i + 1]});
    put(jet.s, s + 3 * i);
    if (order >= 1) put(jet.su, su + 3 * i), put(jet.sv, sv + 3 * i);
    if (order >= 2) put(jet.suu, suu + 3 * i), put(jet.suv, suv + 3 * i), put(jet.svv, svv + 3 * i);
  }
  return known.status;
}

void expect_same(const SurfaceJet& p, const SurfaceJet& q) {
  EXPECT_EQ(p.s, q.s);
  EXPECT_EQ(p.su, q.su);
  EXPECT_EQ(p.sv, q.sv);
  EXPECT_EQ(p.suu, q.suu);
  EXPECT_EQ(p.suv, q.suv);
  EXPECT_EQ(p.svv, q.svv);
}

TEST(HostCad, HandsAllArgumentsOfACadMModuleOn) {
  HostCad cad(cad_m());
  expect_same(surface_at(cad, 3, everything, {0.3, 0.4}), face_jet(3, {0.3, 0.4}));
  EXPECT_EQ(cad.curve_interval(2, 5).a, 2);
  EXPECT_EQ(cad.curve_interval(2, 5).b, 7);
  const CurveJet jet = cad.curve(2, 5, everything, 2.5);
  EXPECT_EQ(jet.c, curve_jet(2, 5, 2.5).c);
  EXPECT_EQ(jet.ct, curve_jet(2, 5, 2.5).ct);
  EXPECT_EQ(jet.ctt, curve_jet(2, 5, 2.5).ctt);
  EXPECT_FALSE(cad.reentrant());
}

TEST(HostCad, CallsOnlyTheRequestedRoutines) {
  HostCad cad(cad_m());
  surface_at(cad, 1, want_first, {0, 0});
  cad.curve(1, 1, want_second, 1.5);
  EXPECT_EQ(cad.counts(), (CallCounts{.surf1 = 1, .curv2 = 1}));
}

TEST(HostCad, HearsSizesOfACadMModuleAndItsSilence) {
  CadMTable table = cad_m();
  EXPECT_FALSE(HostCad(table).surface_size(1, {0, 0}));  // no routine, no answer
  table.cad_hphys = [](const std::int32_t* refs, const double* uv, double* h) {
    EXPECT_EQ(*h, -1e38);  // hvide (RT-0232 sec. 3.1.3)
    if (*refs == 1) *h = uv[0] + uv[1];
  };
  table.cad_hphyc = [](const std::int32_t* refs, const std::int32_t* ic, const double* t, double* h) {
    if (*refs == 1) *h = *ic * *t;
  };
  table.cad_hphyp = [](const std::int32_t* refp, double* h) {
    if (*refp == 4) *h = 0.125;
  };
  table.cad_rads = [](const std::int32_t* refs, const double*, double* rho) {
    if (*refs == 1) *rho = infinity;
  };
  table.cad_radc = [](const std::int32_t* refs, const std::int32_t*, const double* t, double* rho) {
    if (*refs == 1) *rho = 10 * *t;
  };
  HostCad cad(table);
  EXPECT_EQ(cad.surface_size(1, {0.25, 0.5}), 0.75);
  EXPECT_EQ(cad.curve_size(1, 3, 0.5), 1.5);
  EXPECT_EQ(cad.point_size(4), 0.125);
  EXPECT_EQ(cad.surface_radius(1, {0, 0}), infinity);
  EXPECT_EQ(cad.curve_radius(1, 1, 2), 20);
  EXPECT_FALSE(cad.surface_size(2, {0.25, 0.5}));
  EXPECT_FALSE(cad.curve_size(2, 3, 0.5));
  EXPECT_FALSE(cad.point_size(5));
  EXPECT_FALSE(cad.surface_radius(2, {0, 0}));
  EXPECT_FALSE(cad.curve_radius(2, 1, 2));
  EXPECT_EQ(cad.counts().sizes, 10);
}

TEST(HostCad, ReplacesMissingRoutinesOfACadMModuleByDifferences) {
  CadMTable table = cad_m();
  table.surf1 = nullptr;
  table.surf2 = nullptr;
  table.curv1 = nullptr;
  table.curv2 = nullptr;
  HostCad cad(table);
  EXPECT_EQ(cad.surface_gives(), unsigned{want_position});
  cad.set_parameter_box(2, {0, 0}, {3, 3});
  const SurfaceJet jet = surface_at(cad, 2, everything, {0, 1.5}), exact = face_jet(2, {0, 1.5});
  EXPECT_LE(norm(jet.su - exact.su), 1e-8);
  EXPECT_LE(norm(jet.suv - exact.suv), 1e-5);
  EXPECT_LE(norm(cad.curve(2, 1, want_first, 2).ct - curve_jet(2, 1, 2).ct), 1e-8);
  EXPECT_LE(norm(cad.curve(2, 1, want_second, 3).ctt - curve_jet(2, 1, 3).ctt), 1e-5);
}

TEST(HostCad, CanBeOfACHost) {
  User user;
  HostCad cad(host(user));
  expect_same(surface_at(cad, 3, everything, {0.3, 0.4}), face_jet(3, {0.3, 0.4}));
  EXPECT_EQ(user.calls, 1);  // one call for all orders
  EXPECT_EQ(user.last_order, 2);
  surface_at(cad, 3, want_position, {0.3, 0.4});
  EXPECT_EQ(user.last_order, 0);
  EXPECT_EQ(cad.curve(2, 5, want_first, 2.5).ct, curve_jet(2, 5, 2.5).ct);
  EXPECT_EQ(cad.curve_interval(2, 5).b, 7);
}

TEST(HostCad, NeverRequestsHigherOrdersThanACHostGives) {
  User user;
  HostTable table = host(user);
  table.surface_order = 1;
  table.curve_order = 0;
  HostCad cad(table);
  const SurfaceJet jet = surface_at(cad, 2, everything, {1, 1});
  EXPECT_LE(user.last_order, 1);
  EXPECT_LE(norm(jet.svv - face_jet(2, {1, 1}).svv), 1e-8);
  EXPECT_LE(norm(cad.curve(2, 1, want_first, 2.2).ct - curve_jet(2, 1, 2.2).ct), 1e-8);
  EXPECT_EQ(cad.surface_gives(), want_position | want_first);
  EXPECT_EQ(cad.curve_gives(), unsigned{want_position});
}

TEST(HostCad, UsesBatchesWhenTheyAreGiven) {
  User user;
  HostTable table = host(user);
  table.surface = nullptr;  // a batch will do
  table.surface_batch = batch;
  HostCad cad(table);
  std::vector<Vec2> points;
  for (int i = 0; i < 10'000; ++i) points.push_back({i * 1e-4, 1 - i * 1e-4});
  std::vector<SurfaceJet> jets(points.size());
  cad.surface(2, everything, points, jets);
  EXPECT_LT(user.calls, 10);
  EXPECT_GT(user.largest_batch, 1000);
  EXPECT_EQ(cad.counts(), (CallCounts{.surf0 = 10'000, .surf1 = 10'000, .surf2 = 10'000}));
  for (std::size_t i = 0; i < points.size(); i += 97) expect_same(jets[i], face_jet(2, points[i]));
}

TEST(HostCad, TurnsAStatusIntoAnErrorThatNamesThePlace) {
  User user;
  HostTable table = host(user);
  HostCad cad(table);
  user.status = 42;
  EXPECT_EQ(callback_error([&] {
              surface_at(cad, 3, want_position, {0.25, 1});
            }),
            "face 3, u = 0.25, v = 1: the callback surface returned the status 42");
  EXPECT_EQ(callback_error([&] { cad.curve(3, 2, want_position, 0.5); }),
            "face 3, curve 2, t = 0.5: the callback curve returned the status 42");
  EXPECT_EQ(callback_error([&] { cad.curve_interval(3, 2); }),
            "face 3, curve 2: the callback curve_interval returned the status 42");
  table.surface_batch = batch;
  HostCad batched(table);
  EXPECT_EQ(callback_error([&] {
              surface_at(batched, 3, want_position, {0.25, 1});
            }),
            "face 3, u = 0.25, v = 1: the callback surface_batch returned the status 42 for 1 points, of which this is "
            "the first");
}

TEST(HostCad, HearsSizesOfACHostItsSilenceAndItsFailures) {
  User user;
  HostTable table = host(user);
  table.surface_size = [](std::int32_t, double u, double v, double* h, void* data) {
    const auto& known = *static_cast<User*>(data);
    if (known.writes) *h = known.size * (u + v);
    return known.status;
  };
  table.curve_size = [](std::int32_t, std::int32_t ic, double t, double* h, void* data) {
    *h = ic * t;
    return static_cast<User*>(data)->status;
  };
  table.point_size = [](std::int32_t point, double* h, void* data) {
    *h = point;
    return static_cast<User*>(data)->status;
  };
  table.surface_radius = table.surface_size;
  table.curve_radius = table.curve_size;
  HostCad cad(table);
  EXPECT_EQ(cad.surface_size(1, {1, 2}), 1.5);
  EXPECT_EQ(cad.curve_size(1, 3, 0.5), 1.5);
  EXPECT_EQ(cad.point_size(7), 7);
  EXPECT_EQ(cad.surface_radius(1, {1, 2}), 1.5);
  EXPECT_EQ(cad.curve_radius(1, 3, 0.5), 1.5);
  user.writes = false;  // left as it was
  EXPECT_FALSE(cad.surface_size(1, {1, 2}));
  user.status = no_answer_status;
  EXPECT_FALSE(cad.curve_size(1, 3, 0.5));
  EXPECT_FALSE(cad.point_size(7));
  user.status = 5;
  EXPECT_EQ(callback_error([&] { cad.point_size(7); }),
            "point of reference 7: the callback point_size returned the status 5");
  EXPECT_EQ(callback_error([&] { cad.curve_radius(1, 3, 0.5); }),
            "face 1, curve 3, t = 0.5: the callback curve_radius returned the status 5");
}

TEST(HostCad, ReportsOrdersThatAHostDoesNotGive) {
  User user;
  HostTable table = host(user);
  table.surface = [](std::int32_t, double u, double v, std::int32_t, double* s, double*, double*, double*, double*,
                     double*, void*) { return s[0] = u, s[1] = v, s[2] = 0, 0; };
  table.curve = [](std::int32_t, std::int32_t, double t, std::int32_t, double* c, double*, double*, void*) {
    return c[0] = t, c[1] = 0, 0;
  };
  const auto told = [&](std::int32_t surface_order, std::int32_t curve_order, unsigned want) {
    table.surface_order = surface_order;
    table.curve_order = curve_order;
    HostCad host_cad(table);
    CheckedCad cad(host_cad);
    return std::pair{callback_error([&] {
                       surface_at(cad, 3, want, {0, 1});
                     }),
                     callback_error([&] { cad.curve(3, 2, want, 0.5); })};
  };
  const std::string surface = "face 3, u = 0, v = 1: the callback surface gave no ",
                    curve = "face 3, curve 2, t = 0.5: the callback curve gave no ";
  EXPECT_EQ(told(2, 2, want_position | want_first),
            std::pair(surface + "first derivatives: if it has none, surface_order must be 0",
                      curve + "first derivatives: if it has none, curve_order must be 0"));
  EXPECT_EQ(told(2, 2, want_second), std::pair(surface + "second derivatives: if it has none, surface_order must be 1",
                                               curve + "second derivatives: if it has none, curve_order must be 1"));
  EXPECT_EQ(told(0, 0, want_position | want_first), std::pair(std::string(), std::string()));
  table.surface_batch = [](std::int32_t, std::int64_t n, const double* uv, std::int32_t, double* s, double*, double*,
                           double*, double*, double*, void*) {
    for (std::int64_t i = 0; i < n; ++i) s[3 * i] = uv[2 * i], s[3 * i + 1] = uv[2 * i + 1], s[3 * i + 2] = 0;
    return 0;
  };
  EXPECT_EQ(told(1, 0, want_first).first,
            "face 3, u = 0, v = 1: the callback surface_batch gave no first derivatives: if it has none, surface_order "
            "must be 0");
}

TEST(HostCad, ShowsValuesThatAHostForgetsToWrite) {
  User user;
  user.writes = false;
  HostCad host_cad(host(user));
  CheckedCad cad(host_cad);
  EXPECT_EQ(callback_error([&] {
              surface_at(cad, 3, want_position, {0, 0});
            }),
            "face 3, u = 0, v = 0: surf0 returned a value that is not finite");
  CadMTable table = cad_m();
  table.curv_int = [](const std::int32_t*, const std::int32_t*, double* a, double*) { *a = 0; };
  HostCad silent(table);
  CheckedCad checked(silent);
  EXPECT_NE(callback_error([&] { checked.curve_interval(1, 1); }), "");
}

TEST(HostCad, RejectsTablesWithoutTheRoutinesOfAGeometry) {
  const auto refuses = [](const auto& table) {
    try {
      HostCad cad(table);
    } catch (const InvalidArgument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CadMTable table = cad_m();
  table.surf0 = nullptr;
  EXPECT_EQ(refuses(table), "the routine surf0 is missing: geometry needs it");
  table = cad_m();
  table.curv_int = nullptr;
  EXPECT_EQ(refuses(table), "the routine curv_int is missing: geometry needs it");
  table = cad_m();
  table.curv0 = nullptr;
  EXPECT_EQ(refuses(table), "the routine curv0 is missing: geometry needs it");
  User user;
  HostTable c = host(user);
  c.surface = nullptr;
  EXPECT_EQ(refuses(c), "the routine surface (or surface_batch) is missing: geometry needs it");
  c = host(user);
  c.curve = nullptr;
  EXPECT_EQ(refuses(c), "the routine curve is missing: geometry needs it");
  c = host(user);
  c.curve_order = 3;
  EXPECT_EQ(refuses(c), "curve_order must be 0, 1 or 2; it is 3");
}

}  // namespace
}  // namespace carreau
