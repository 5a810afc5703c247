// SPDX-License-Identifier: BSD-3-Clause
// Quadrilaterals a second and their quality, in the plane alone: bench_quads CASE H [runs] [triangles] [PICTURE.svg].
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "plane_cases.h"
#include "plane/plane_mesher.h"
#include "surface/elements/quads/passes.h"
#include "surface/elements/quads/quad_shape.h"

namespace {

using namespace carreau;
using namespace carreau::testing;

PlaneCase plate(double h) {
  PlaneCase c{"plate", [](Vec2 p) -> Vec3 { return {p.x(), p.y(), 0}; }, [h](Vec2) { return h; }, {}, {-1, -1}, {2, 2}};
  const auto line = [](Vec2 a, Vec2 b) { return [a, b](double t) -> Vec2 { return lerp(a, b, t); }; };
  const int o = append_curve(c, line({0, 0}, {1e-9, 0}), PlaneEdgeKind::boundary, -1, -1);
  (void)o;
  c.domain = {};
  int v = -1;
  const std::vector<Vec2> corners{{0, 0}, {1, 0}, {1, 0.5}, {0.5, 1}, {0, 1}};
  c.domain.vertices.push_back(corners[0]);
  v = 0;
  v = append_curve(c, line(corners[0], corners[1]), PlaneEdgeKind::boundary, v, -1);
  v = append_curve(c, line(corners[1], corners[2]), PlaneEdgeKind::boundary, v, -1);
  v = append_curve(
      c,
      [](double t) -> Vec2 {
        const double a = std::numbers::pi * (1.5 - 0.5 * t);
        return {1 + 0.5 * std::cos(a), 1 + 0.5 * std::sin(a)};
      },
      PlaneEdgeKind::boundary, v, -1);
  v = append_curve(c, line(corners[3], corners[4]), PlaneEdgeKind::boundary, v, -1);
  append_curve(c, line(corners[4], corners[0]), PlaneEdgeKind::boundary, v, 0);
  return c;
}

PlaneCase make_case(const std::string& name, double h) {
  if (name == "plate") return plate(h);
  if (name == "square") return flat_square(h);
  if (name == "paraboloid") return paraboloid(h);
  if (name == "hemisphere") return hemisphere(h);
  if (name == "swirl") return swirl(h);
  if (name == "swirl7") return swirl(h, 7);
  if (name == "stretched") return stretched(h);
  if (name == "sizes") return size_field(h);
  if (name == "holes") return holes(h);
  if (name == "star") return star(h);
  if (name == "torus") return torus_patch(h);
  if (name == "internal") return internal_curves(h);
  if (name == "disc") return polar_disc(h);
  if (name == "cone") return polar_cone(h, 0.25);
  if (name == "sphere") return sphere_two_poles(h);
  std::fprintf(stderr, "bench_quads: no case %s\n", name.c_str());
  std::exit(2);
}

double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void report(const char* what, const PlaneCase& c, const QuadPatch& patch, double seconds) {
  double sum = 0, worst = 1, least = 1;
  std::size_t quads = 0, bad = 0, triangles = 0;
  for (const MixedCell& cell : patch.cells) {
    if (corners_of(cell) == 3) {
      ++triangles;
      continue;
    }
    std::array<Vec3, 4> p;
    for (int k = 0; k < 4; ++k) p[k] = c.surface(patch.uv[cell[k]]);
    const double q = quad_quality(p);
    ++quads, sum += q, worst = std::min(worst, q), least = std::min(least, scaled_jacobian(p));
    if (q < 0.5) ++bad;
  }
  std::vector<int> degree(patch.uv.size(), 0);
  for (const MixedCell& cell : patch.cells)
    for (int k = 0; k < corners_of(cell); ++k) ++degree[cell[k]];
  std::size_t irregular = 0, inside = 0;
  for (std::size_t v = 0; v < degree.size(); ++v)
    if (patch.fixed[v] == 0 && degree[v] > 0) ++inside, irregular += degree[v] != 4 ? 1 : 0;
  std::printf("%-9s %6zu quads %4zu triangles, Q %.3f worst %.3f, %4zu below .5, SJ %.3f, irregular %.1f%%, %.2f us a quad\n",
              what, quads, triangles, sum / static_cast<double>(quads), worst, bad, least,
              100. * static_cast<double>(irregular) / static_cast<double>(inside), 1e6 * seconds / static_cast<double>(quads));
}

void draw(const char* path, const QuadPatch& patch) {
  Vec2 low = patch.uv[0], high = low;
  for (const Vec2& p : patch.uv) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const double s = 1000 / std::max(high.x() - low.x(), high.y() - low.y());
  std::FILE* f = std::fopen(path, "w");
  std::fprintf(f, "<svg xmlns='http://www.w3.org/2000/svg' viewBox='-5 -5 1010 1010' width='1400'><rect x='-5' y='-5' width='1010' height='1010' fill='white'/><g stroke='black' stroke-width='.6'>\n");
  for (const MixedCell& cell : patch.cells) {
    std::fprintf(f, "<polygon fill='%s' points='", corners_of(cell) == 3 ? "#f88" : "#def");
    for (int k = 0; k < corners_of(cell); ++k)
      std::fprintf(f, "%.2f,%.2f ", (patch.uv[cell[k]].x() - low.x()) * s, (high.y() - patch.uv[cell[k]].y()) * s);
    std::fprintf(f, "'/>\n");
  }
  std::fprintf(f, "</g></svg>\n");
  std::fclose(f);
}

QuadPatch patch_of(const PlaneCase& c, const PlaneMesh& mesh) {
  QuadPatch patch{mesh.vertices, std::vector<char>(mesh.vertices.size(), 0), {}};
  std::fill_n(patch.fixed.begin(), c.domain.vertices.size(), char{1});
  for (const auto& t : mesh.triangles) patch.cells.push_back({t[0], t[1], t[2], -1});
  return patch;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const PlaneCase c = make_case(argv[1], std::atof(argv[2]));
  PlaneMesherOptions options;
  options.squares = !(argc > 4 && std::strcmp(argv[4], "triangles") == 0);
  Monitor monitor;
  const ControlSpace space = control_space(c, ControlSpaceOptions{}.tolerance);
  double start = now();
  const PlaneMesh mesh = mesh_plane(c.domain, space, options, monitor);
  double seconds = now() - start;
  std::printf("%s %s: %zu triangles, expected %.0f; %.2f us a quad\n", argv[1], argv[2], mesh.triangles.size(),
              space.measure(), 2e6 * seconds / static_cast<double>(mesh.triangles.size()));
  QuadPatch patch = patch_of(c, mesh);
  const FaceCharts charts(space);
  PlaneQuads quads(patch, charts);
  std::set<std::pair<int, int>> imposed;
  for (const PlaneEdge& e : c.domain.edges) imposed.insert({std::min(e.a, e.b), std::max(e.a, e.b)});
  const PairRules rules{[&](int a, int b) { return imposed.count({std::min(a, b), std::max(a, b)}) != 0; },
                        [&](int v) { return c.surface(patch.uv[v]); }, 0.5, 0};
  const auto step = [&](const char* what, auto&& work) {
    start = now();
    work();
    report(what, c, patch, now() - start);
  };
  step("paired", [&] { pair_triangles(quads, rules, monitor); });
  step("cleaned", [&] { clean_up(quads, rules.is_imposed, monitor); });
  step("walked", [&] { join_triangles(quads, rules.is_imposed, monitor); });
  step("cleaned", [&] { clean_up(quads, rules.is_imposed, monitor); });
  step("smoothed", [&] { smooth_quads(quads, {}, monitor); });
  step("worst", [&] { improve_worst_quads(quads, 0.6, monitor); });
  if (argc > 5) draw(argv[5], patch);
  return 0;
}
