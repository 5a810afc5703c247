// SPDX-License-Identifier: BSD-3-Clause
// Built-in geometries beside callbacks: the same surfaces, called directly and through the callbacks of a C host. One line of
// JSON a case and road: seconds of a million evaluations of each order, and of meshing, by the processor's clock (one thread).
// Usage: bench_geometry [REPEAT]
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <random>
#include <string>

#include "cad/host_cad.h"
#include "geometry/atlas/blended_surface.h"
#include "geometry/bezier/bezier_geometry.h"
#include "geometry/molecule/molecule.h"
#include "io/model/bezier_reader.h"
#include "session/session.h"

namespace {

using namespace carreau;

/// Callbacks of a C host that call another evaluator.
Cad& asked(void* user) { return *static_cast<Cad*>(user); }
unsigned wanted(std::int32_t order) {
  return want_position | (order > 0 ? want_first : 0U) | (order > 1 ? want_second : 0U);
}
void store(const Vec3& v, double* to) {
  for (int k = 0; k < 3; ++k) to[k] = v[k];
}

std::int32_t surface(std::int32_t face, double u, double v, std::int32_t order, double* s, double* su, double* sv,
                     double* suu, double* suv, double* svv, void* user) {
  const SurfaceJet jet = surface_at(asked(user), face, wanted(order), {u, v});
  store(jet.s, s);
  if (order > 0) store(jet.su, su), store(jet.sv, sv);
  if (order > 1) store(jet.suu, suu), store(jet.suv, suv), store(jet.svv, svv);
  return 0;
}
std::int32_t interval(std::int32_t face, std::int32_t ic, double* a, double* b, void* user) {
  const Interval range = asked(user).curve_interval(face, ic);
  return *a = range.a, *b = range.b, 0;
}
std::int32_t curve(std::int32_t face, std::int32_t ic, double t, std::int32_t order, double* c, double* ct, double* ctt,
                   void* user) {
  const CurveJet jet = asked(user).curve(face, ic, wanted(order), t);
  for (int k = 0; k < 2; ++k) c[k] = jet.c[k], ct[k] = jet.ct[k], ctt[k] = jet.ctt[k];
  return 0;
}

double clock_now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double evaluation(Cad& cad, const Model& model, unsigned want) {
  constexpr std::size_t batch = 1000;
  constexpr int batches = 1000;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> parameter(0.1, 0.9);
  std::vector<Vec2> uv(batch);
  for (Vec2& p : uv) p = {parameter(random), parameter(random)};
  std::vector<SurfaceJet> jets(batch);
  const double start = clock_now();
  for (int k = 0; k < batches; ++k)
    cad.surface(model.faces[static_cast<std::size_t>(k) % model.faces.size()].ref, want, uv, jets);
  return clock_now() - start;
}

struct Meshed {
  double seconds = 0;
  FlatMesh mesh;
};

Meshed mesh(const std::shared_ptr<Cad>& cad, const Model& model, double size) {
  Monitor monitor;
  Session session(monitor);
  session.set_cad(cad);
  session.set_model(model);
  session.parameters().set("hphydef", size);
  session.parameters().set("threads", 1);
  const double start = clock_now();
  session.make_mesh();
  return {clock_now() - start, session.exported()};
}

void run(const std::string& name, const BuiltGeometry& built, double size, int repeat) {
  const HostTable table{.user = built.cad.get(), .reentrant = 1, .surface = surface, .curve_interval = interval, .curve = curve};
  const std::shared_ptr<Cad> roads[] = {built.cad, std::make_shared<HostCad>(table)};
  FlatMesh first;
  for (const auto& road : roads) {
    double orders[3] = {1e300, 1e300, 1e300}, meshing = 1e300;
    Meshed made;
    for (int i = 0; i < repeat; ++i) {
      for (int order = 0; order < 3; ++order)
        orders[order] = std::min(orders[order], evaluation(*road, built.model, wanted(order)));
      made = mesh(road, built.model, size);
      meshing = std::min(meshing, made.seconds);
    }
    const bool direct = road == roads[0];
    if (direct) first = made.mesh;
    std::printf(
        "{\"case\": \"%s\", \"road\": \"%s\", \"million_s0\": %.4f, \"million_s1\": %.4f, \"million_s2\": %.4f, \"meshing\": %.4f, "
        "\"triangles\": %zu, \"same_mesh\": %s}\n",
        name.c_str(), direct ? "built in" : "callbacks", orders[0], orders[1], orders[2], meshing,
        made.mesh.triangles.size(), made.mesh.vertices == first.vertices ? "true" : "false");
    std::fflush(stdout);
  }
}

/// Nanoseconds of a chart's evaluation, of its inverse, and of the blended surface with all derivatives (aim: a chart below 1000).
void run_chart(int repeat) {
  using namespace carreau::atlas;
  Triangulation s{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                  {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int k = 0; k < 3; ++k) s = subdivided(s);
  for (Vec3& p : s.vertices) p /= norm(p);
  const BlendedSurface surface{Covering(s)};
  const Annulus& a = surface.covering().charts()[0].annulus;
  constexpr int count = 200000;
  double best[4] = {1e9, 1e9, 1e9, 1e9}, sum = 0;
  for (int r = 0; r < repeat; ++r)
    for (int what = 0; what < 4; ++what) {
      const std::clock_t start = std::clock();
      for (int k = 0; k < count; ++k) {
        const double tau = (k % 97) / 97., phi = 1e-3 * k;
        const Pair<double> p = a.at(tau, phi);
        sum += p[0];
        if (what == 1) sum += a.find(p)->phi;
        if (what >= 2) sum += surface.at(0, value_of(p), what == 2 ? 2 : 1).s.x();
      }
      best[what] = std::min(best[what], 1e9 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / count);
    }
  std::printf("{\"case\": \"atlas\", \"chart_ns\": %.1f, \"inverse_ns\": %.1f, \"surface_ns\": %.1f, \"first_order_ns\": %.1f, \"sum\": %.3g}\n", best[0], best[1] - best[0], best[2] - best[0], best[3] - best[0], sum);
}

}  // namespace

int main(int argc, char** argv) {
  const int repeat = argc > 1 ? std::max(1, std::atoi(argv[1])) : 3;
  run("teapot", build_bezier({.patches = read_bezier(CARREAU_SOURCE_DIR "/fortran_examples/teapot/teapot.bpt"), .side_refs = {}}),
      0.05, repeat);
  run_chart(repeat);
  Monitor monitor;
  run("sphere", molecule::build_surface({.balls = {{{0, 0, 0}, 1}}}, {}, monitor), 0.02, repeat);
}
