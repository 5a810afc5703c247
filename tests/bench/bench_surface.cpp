// SPDX-License-Identifier: BSD-3-Clause
// Surface meshing of analytic cases: one line of JSON a case.
// Usage: bench_surface [CASE [SIZE [REPEAT [OUT|- [PARAMETER VALUE]...]]]]
// Times are processor times, so that a busy machine does not count; best of all repeats, as is the time on the
// wall. CASE: paraboloid, hemisphere, torus, teapot; all of them at their standard sizes without arguments. Square,
// sphere and whole_torus are one face each, closed ones with seams and poles.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <utility>

#include "common/analytic_cad.h"
#include "io/mesh_files.h"
#include "session/session.h"

namespace {

using namespace carreau;

constexpr double pi = std::numbers::pi;

testing::AnalyticCad one_face(std::function<SurfaceJet(Vec2)> at, Vec2 low, Vec2 high) {
  testing::AnalyticCad cad;
  cad.faces[1] = {std::move(at), testing::rectangle(low, high)};
  return cad;
}
SurfaceJet plane_jet(Vec2 p) { return {{p.x(), p.y(), 0}, {1, 0, 0}, {0, 1, 0}, {}, {}, {}}; }
SurfaceJet sphere_jet(Vec2 p) {
  const double cu = std::cos(p.x()), su = std::sin(p.x()), cv = std::cos(p.y()), sv = std::sin(p.y());
  return {{cu * cv, su * cv, sv},  {-su * cv, cu * cv, 0}, {-cu * sv, -su * sv, cv},
          {-cu * cv, -su * cv, 0}, {su * sv, -cu * sv, 0}, {-cu * cv, -su * cv, -sv}};
}

std::shared_ptr<testing::AnalyticCad> cad_of(const std::string& name) {
  if (name == "paraboloid") return std::make_shared<testing::AnalyticCad>(testing::paraboloid());
  if (name == "hemisphere") return std::make_shared<testing::AnalyticCad>(testing::hemisphere());
  if (name == "torus") return std::make_shared<testing::AnalyticCad>(testing::torus_patch());
  if (name == "square") return std::make_shared<testing::AnalyticCad>(one_face(plane_jet, {0, 0}, {1, 1}));
  if (name == "sphere")
    return std::make_shared<testing::AnalyticCad>(one_face(sphere_jet, {0, -pi / 2}, {2 * pi, pi / 2}));
  if (name == "whole_torus")
    return std::make_shared<testing::AnalyticCad>(
        one_face([](Vec2 p) { return testing::torus_jet(p, 1, 0.4); }, {0, 0}, {2 * pi, 2 * pi}));
  if (name == "teapot") return std::make_shared<testing::AnalyticCad>(testing::teapot());
  return nullptr;
}

/// Parameters and their values by turns.
using Settings = std::span<char* const>;

int run(const std::string& name, double size, int repeat, const char* out, Settings settings) {
  double best = 1e300, min_wall = 1e300, min_cpu = 1e300, min_plane = 1e300;
  for (int i = 0; i < repeat; ++i) {
    const auto cad = cad_of(name);
    if (!cad) return std::fprintf(stderr, "unknown case %s\n", name.c_str()), 2;
    Monitor monitor;
    Session session(monitor);
    session.set_cad(cad);
    session.set_model(testing::unglued(*cad));
    session.parameters().set("hphydef", size);
    session.parameters().set("hphymin", size / 10);
    session.parameters().set("hphymax", size * 10);
    for (std::size_t k = 0; k + 1 < settings.size(); k += 2)
      session.parameters().set(settings[k], std::atoi(settings[k + 1]));
    const auto wall_start = std::chrono::steady_clock::now();
    const std::clock_t start = std::clock();
    session.make_mesh();
    const double cpu = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_start).count();
    const CompositeReport& r = session.report();
    const double meshing = r.seconds_sampling + r.seconds_plane + r.seconds_lift;
    best = std::min(best, meshing * cpu / wall);
    min_wall = std::min(min_wall, wall), min_cpu = std::min(min_cpu, cpu);
    min_plane = std::min(min_plane, r.seconds_plane);
    if (i + 1 < repeat) continue;
    const FlatMesh mesh = session.exported();
    const QualitySummary q = summarise_quality(mesh);
    std::size_t in_range = 0, edges = 0;
    double mean = 0;
    for (const auto& t : mesh.triangles)
      for (int k = 0; k < 3; ++k) {
        const double l = norm(mesh.vertices[t[k]] - mesh.vertices[t[(k + 1) % 3]]) / size;
        mean += l;
        ++edges;
        in_range += l >= 0.70710678 && l <= 1.41421356;
      }
    std::printf(
        "{\"case\": \"%s\", \"size\": %.9g, \"triangles\": %zu, \"seconds\": %.6f, \"triangles_per_second\": %.0f, "
        "\"q2_mean\": %.5f, \"q2_p1\": %.4f, \"q2_min\": %.4f, \"degree6\": %.4f, \"length_mean\": %.5f, "
        "\"length_in_range\": %.6f, "
        "\"area\": %.6f, \"calls_per_vertex\": %.3f, \"defects\": %zu, \"curves_s\": %.4f, \"sampling_s\": %.4f, "
        "\"plane_s\": %.4f, \"lift_s\": %.4f, \"wall_s\": %.4f, \"processor_s\": %.4f}\n",
        name.c_str(), size, q.triangles, best, static_cast<double>(q.triangles) / best, q.q2.mean, q.q2.p1, q.q2.min,
        q.degree6, mean / static_cast<double>(edges), static_cast<double>(in_range) / static_cast<double>(edges),
        q.area, static_cast<double>(r.calls.surface()) / static_cast<double>(q.vertices),
        find_defects(session.mesh()).size(), r.seconds_curves, r.seconds_sampling, min_plane, r.seconds_lift,
        min_wall, min_cpu);
    std::fflush(stdout);
    if (out != nullptr) session.write(out);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc > 2)
      return run(argv[1], std::atof(argv[2]), argc > 3 ? std::atoi(argv[3]) : 3,
                 argc > 4 && std::strcmp(argv[4], "-") != 0 ? argv[4] : nullptr,
                 argc > 5 ? Settings(argv + 5, argv + argc) : Settings());
    const struct {
      const char* name;
      double size;
    } cases[] = {{"paraboloid", 0.15462}, {"paraboloid", 0.03558}, {"paraboloid", 0.011252},
                 {"hemisphere", 0.0121},  {"hemisphere", 0.00381}, {"torus", 0.0145},
                 {"torus", 0.0046},       {"teapot", 0.1},         {"teapot", 0.035}};
    for (const auto& c : cases)
      if ((argc < 2 || argv[1] == std::string(c.name)) && run(c.name, c.size, 3, nullptr, {}) != 0) return 1;
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
