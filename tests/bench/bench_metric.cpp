// Triangles a second and metric quality in anisotropic fields: bench_metric CASE H RATIO [RUNS].
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
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

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: bench_metric line|circle|spiral|sine|constant|turning H RATIO [RUNS]\n");
    return 2;
  }
  const MetricCase c = make_case(argv[1], std::atof(argv[2]), std::atof(argv[3]));
  const int runs = argc > 4 ? std::max(1, std::atoi(argv[4])) : 3;
  const auto now = [] { return std::chrono::steady_clock::now(); };
  std::vector<double> seconds;
  double sampling = 0;
  PlaneMesh mesh;
  ControlSpace space;
  for (int run = 0; run < runs; ++run) {
    auto start = now();
    space = control_space(c);
    sampling = std::chrono::duration<double>(now() - start).count();
    Monitor monitor;
    start = now();
    mesh = mesh_plane(c.domain, space, {}, monitor);
    seconds.push_back(std::chrono::duration<double>(now() - start).count());
  }
  std::sort(seconds.begin(), seconds.end());
  const auto n = static_cast<double>(mesh.triangles.size());
  std::printf("%s h %s ratio %s: boundary %zu, expected %.0f, samples %zu\n  %s\n", argv[1], argv[2], argv[3],
              c.domain.edges.size(), space.measure(), space.samples(), to_string(measure(c, mesh)).c_str());
  std::printf("  %.0f triangles/s median of %d, %.0f with sampling\n", n / seconds[seconds.size() / 2], runs,
              n / (seconds[seconds.size() / 2] + sampling));
  const auto defects = find_plane_defects(c.domain, mesh);
  for (std::size_t i = 0; i < defects.size() && i < 5; ++i) std::printf("  DEFECT %s\n", defects[i].c_str());
  return defects.empty() ? 0 : 1;
}
