// SPDX-License-Identifier: BSD-3-Clause
// Random plane graphs: segments that cross, points twice, tiny angles, holes, open polylines, arcs and splines.
#include <algorithm>
#include <cstdint>
#include <numbers>
#include <vector>

#include "geometry_fuzz.h"
#include "session_handle.h"

namespace geometry_fuzz {
namespace {

struct Graph {
  std::vector<double> points;
  std::vector<std::int64_t> starts{0};
  std::vector<std::int32_t> along;
  std::vector<std::int32_t> smooth;
  std::vector<double> seeds;
  std::vector<std::int32_t> seed_refs;

  std::int32_t add(double x, double y) {
    points.push_back(x), points.push_back(y);
    return static_cast<std::int32_t>(points.size() / 2) - 1;
  }
  void end_curve(std::int32_t kind) {
    starts.push_back(static_cast<std::int64_t>(along.size()));
    smooth.push_back(kind);
  }
};

/// A closed polygon around a place. If it need not be valid, its corners may be out of order, twice, or a segment is missing.
void add_loop(Random& random, double x, double y, double radius, bool valid, Graph& graph) {
  const int n = 3 + random.below(12);
  const double wobble = random.chance(0.4) ? 0 : random.uniform(0, valid ? 0.6 : 0.95),
               stretch = valid || random.chance(0.8) ? 1 : random.power(-6, 0);
  const bool turned = random.chance(0.2), lattice = !valid && random.chance(0.2);
  std::vector<std::int32_t> loop;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * std::numbers::pi * i / n * (turned ? -1 : 1), r = radius * (1 - wobble * random.uniform());
    double px = x + r * std::cos(a), py = y + stretch * r * std::sin(a);
    if (lattice) px = std::round(8 * px) / 8, py = std::round(8 * py) / 8;
    loop.push_back(graph.add(px, py));
  }
  if (!valid && random.chance(0.15)) std::swap(loop[0], loop[static_cast<std::size_t>(random.below(n))]);
  if (!valid && random.chance(0.1)) loop.push_back(loop[static_cast<std::size_t>(random.below(n))]);
  const bool one_curve = random.chance(0.6);
  const std::int32_t kind = random.chance(valid ? 0.95 : 0.75) ? CARREAU_SEGMENTS : random.chance(0.5) ? CARREAU_SPLINE : CARREAU_ARCS;
  loop.push_back(loop.front());
  if (one_curve) {
    graph.along.insert(graph.along.end(), loop.begin(), loop.end());
    graph.end_curve(kind);
    return;
  }
  for (std::size_t i = 0; i + 1 < loop.size(); ++i) {
    if (!valid && random.chance(0.03)) continue;  // a gap
    graph.along.push_back(loop[i]), graph.along.push_back(loop[i + 1]);
    graph.end_curve(CARREAU_SEGMENTS);
  }
}

/// A polyline that begins at a point of the graph or anywhere.
void add_open(Random& random, Graph& graph) {
  const auto points = static_cast<int>(graph.points.size() / 2);
  for (int n = 2 + random.below(4); n > 0; --n) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
    graph.along.push_back(random.chance(0.4) ? random.below(points) : graph.add(x, y));
  }
  graph.end_curve(random.chance(0.9) ? CARREAU_SEGMENTS : CARREAU_SPLINE);
}

}  // namespace

Outcome run_plane(std::uint64_t seed) {
  Random random(seed);
  Graph graph;
  const bool valid = random.chance(0.7);
  add_loop(random, 0, 0, 1, valid, graph);
  for (int n = random.below(3); n > 0; --n) {
    const double reach = valid ? 0.03 : 0.7, x = random.uniform(-reach, reach), y = random.uniform(-reach, reach);
    const double radius = random.power(-3, valid ? -1.5 : 0);
    add_loop(random, x + (valid ? 0.1 * n - 0.15 : 0), y, radius, valid, graph);
  }
  for (int n = valid || random.chance(0.5) ? 0 : random.below(4); n > 0; --n) add_open(random, graph);
  for (int n = random.chance(0.7) ? 0 : random.below(3); n > 0; --n) {
    graph.seeds.push_back(random.uniform(-1, 1)), graph.seeds.push_back(random.uniform(-1, 1));
    graph.seed_refs.push_back(random.chance(0.5) ? -1 : 1 + random.below(3));
  }
  const auto count = graph.points.size() / 2;
  if (!valid && random.chance(0.1)) {  // two points at one place, or nearly
    const std::size_t a = static_cast<std::size_t>(random.below(static_cast<int>(count))),
                      b = static_cast<std::size_t>(random.below(static_cast<int>(count)));
    for (std::size_t k = 0; k < 2; ++k)
      graph.points[2 * a + k] = graph.points[2 * b + k] + (random.chance(0.5) ? 0 : random.power(-16, -3));
  }
  const double scale = random.chance(0.7) ? 1 : random.power(-9, 9), away = random.chance(0.8) ? 0 : random.power(0, 5);
  for (double& x : graph.points) x = scale * (x + away);
  for (double& x : graph.seeds) x = scale * (x + away);
  std::vector<double> sizes(count, 0);
  for (double& h : sizes)
    if (random.chance(0.3)) h = scale * random.power(-2, 0);
  carreau_plane_domain domain = sized<carreau_plane_domain>();
  domain.rest = random.chance(0.7) ? CARREAU_REST_PARITY : random.below(3);
  domain.point_count = static_cast<std::int64_t>(count), domain.points = graph.points.data();
  domain.curve_count = static_cast<std::int64_t>(graph.smooth.size());
  domain.curve_starts = graph.starts.data(), domain.curve_points = graph.along.data();
  domain.smooth = graph.smooth.data();
  domain.seed_count = static_cast<std::int64_t>(graph.seed_refs.size());
  domain.seeds = graph.seeds.data(), domain.seed_refs = graph.seed_refs.data();
  const bool sized_points = random.chance(0.2);
  if (sized_points) domain.sizes = sizes.data();
  const SessionHandle session;
  const carreau_status status = carreau_add_plane_domain(session, &domain);
  if (status != CARREAU_OK) return {Result::rejected, fault_of(session, status, "carreau_add_plane_domain")};
  set_parameters(session, 2 * scale, random);
  if (sized_points) carreau_set_integer(session, "hphy_flag", 2), carreau_set_real(session, "hphymin", 0.01 * scale);
  return mesh_and_check(session, false, random);
}

}  // namespace geometry_fuzz
