// SPDX-License-Identifier: BSD-3-Clause
// Triangles a second and metric quality in anisotropic fields: bench_metric CASE H RATIO [RUNS].
// For comparisons: "bench_metric CASE H RATIO RUNS FILE" writes the mesh as well and prints JSON; "bench_metric CASE H
// RATIO 0 FILE" measures a mesh that another program has made. FILE: the numbers of vertices and triangles, x y of each
// vertex, the vertices of each triangle from 0, counterclockwise.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

#include "metric_cases.h"
#include "plane/plane_mesher.h"
#include "plane_checks.h"

namespace {

using namespace carreau;
using namespace carreau::testing;

MetricCase make_case(const std::string& name, double h, double ratio) {
  if (name == "line") return layer_on_line(h, ratio);
  if (name == "circle") return layer_on_circle(h, ratio);
  if (name == "spiral") return layer_on_spiral(h, ratio);
  if (name == "sine") return layer_on_sine(h, ratio);
  if (name == "constant") return constant_stretch(h, ratio);
  if (name == "turning") return turning_stretch(h, ratio);
  std::fprintf(stderr, "bench_metric: no case %s\n", name.c_str());
  std::exit(2);
}

PlaneMesh read(const std::string& path) {
  std::ifstream in(path);
  std::size_t vertices = 0, triangles = 0;
  in >> vertices >> triangles;
  PlaneMesh mesh;
  mesh.vertices.resize(vertices);
  mesh.triangles.resize(triangles);
  for (Vec2& p : mesh.vertices) in >> p.x() >> p.y();
  for (auto& t : mesh.triangles) in >> t[0] >> t[1] >> t[2];
  if (in) return mesh;
  std::fprintf(stderr, "bench_metric: %s is not a mesh\n", path.c_str());
  std::exit(2);
}

void write(const PlaneMesh& mesh, const std::string& path) {
  std::ofstream out(path);
  out.precision(17);
  out << mesh.vertices.size() << ' ' << mesh.triangles.size() << '\n';
  for (const Vec2& p : mesh.vertices) out << p.x() << ' ' << p.y() << '\n';
  for (const auto& t : mesh.triangles) out << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
}

void print_json(const MetricQuality& q, double meshing, double sampling) {
  std::printf(
      "{\"triangles\": %zu, \"mean\": %.5f, \"p1\": %.4f, \"worst\": %.4f, \"length\": %.5f, \"fitting\": %.6f, "
      "\"meshing\": %.6f, \"sampling\": %.6f}\n",
      q.triangles, q.mean, q.p1, q.worst, q.mean_length, q.fitting, meshing, sampling);
}

// Time of the processor: other work on the machine does not count.
double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: bench_metric line|circle|spiral|sine|constant|turning H RATIO [RUNS [FILE]]\n");
    return 2;
  }
  const MetricCase c = make_case(argv[1], std::atof(argv[2]), std::atof(argv[3]));
  const char* file = argc > 5 ? argv[5] : nullptr;
  if (file != nullptr && std::atoi(argv[4]) == 0) {
    print_json(measure(c, read(file)), 0, 0);
    return 0;
  }
  const int runs = argc > 4 ? std::max(1, std::atoi(argv[4])) : 3;
  std::vector<double> seconds, sampling;
  PlaneMesh mesh;
  ControlSpace space;
  for (int run = 0; run < runs; ++run) {
    double start = now();
    space = control_space(c);
    sampling.push_back(now() - start);
    Monitor monitor;
    start = now();
    mesh = mesh_plane(c.domain, space, {}, monitor);
    seconds.push_back(now() - start);
  }
  std::sort(seconds.begin(), seconds.end());
  std::sort(sampling.begin(), sampling.end());
  const auto n = static_cast<double>(mesh.triangles.size());
  const double meshing = seconds[seconds.size() / 2], space_time = sampling[sampling.size() / 2];
  const auto defects = find_plane_defects(c.domain, mesh);
  if (file != nullptr) {
    write(mesh, file);
    print_json(measure(c, mesh), meshing, space_time);
  } else {
    std::printf("%s h %s ratio %s: boundary %zu, expected %.0f, samples %zu\n  %s\n", argv[1], argv[2], argv[3],
                c.domain.edges.size(), space.measure(), space.samples(), to_string(measure(c, mesh)).c_str());
    std::printf("  %.0f triangles/s of processor, median of %d; %.0f with the control space (%.0f ns a sample)\n",
                n / meshing, runs, n / (meshing + space_time), 1e9 * space_time / static_cast<double>(space.samples()));
  }
  for (std::size_t i = 0; i < defects.size() && i < 5; ++i) std::fprintf(stderr, "  DEFECT %s\n", defects[i].c_str());
  return defects.empty() ? 0 : 1;
}
