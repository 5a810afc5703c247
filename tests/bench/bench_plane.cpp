// SPDX-License-Identifier: BSD-3-Clause
// Triangles a second and quality of the plane mesher alone: bench_plane CASE H [runs] [algebraic] [threads N] [uncut].
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#include "plane/division/undivided.h"
#include "plane/plane_mesher.h"
#include "plane_cases.h"
#include "plane_checks.h"

namespace {

using namespace carreau;
using namespace carreau::testing;

PlaneCase make_case(const std::string& name, double h) {
  if (name == "square") return flat_square(h);
  if (name == "paraboloid" || name == "0") return paraboloid(h);
  if (name == "hemisphere" || name == "1") return hemisphere(h);
  if (name == "swirl" || name == "2") return swirl(h);
  if (name == "swirl7") return swirl(h, 7);
  if (name == "stretched" || name == "3") return stretched(h);
  if (name == "sizes" || name == "4") return size_field(h);
  if (name == "holes" || name == "5") return holes(h);
  if (name == "star" || name == "6") return star(h);
  if (name == "torus" || name == "7") return torus_patch(h);
  if (name == "internal") return internal_curves(h);
  if (name == "disc") return polar_disc(h);
  if (name == "cone") return polar_cone(h, 0.25);
  if (name == "sphere") return sphere_two_poles(h);
  std::fprintf(stderr, "bench_plane: no case %s\n", name.c_str());
  std::exit(2);
}

// Time of the processor: other work on the machine does not count.
double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
double clock_on_the_wall() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: bench_plane CASE H [RUNS] [algebraic] [threads N] [uncut]\n");
    return 2;
  }
  const PlaneCase c = make_case(argv[1], std::atof(argv[2]));
  const int runs = argc > 3 ? std::max(1, std::atoi(argv[3])) : 5;
  PlaneMesherOptions options;
  bool uncut = false;
  for (int k = 4; k < argc; ++k) {
    if (std::strcmp(argv[k], "algebraic") == 0) options.frontal = false;
    if (std::strcmp(argv[k], "uncut") == 0) uncut = true;
    if (std::strcmp(argv[k], "threads") == 0 && k + 1 < argc) options.executor.threads = std::max(1, std::atoi(argv[k + 1]));
  }
  Monitor monitor;
  std::vector<double> seconds, sampling, waited;
  PlaneMesh mesh;
  ControlSpace space;
  for (int run = 0; run < runs; ++run) {
    mesh = {};
    double start = now();
    space = control_space(c, ControlSpaceOptions{}.tolerance);
    sampling.push_back(now() - start);
    const double begin = clock_on_the_wall();
    start = now();
    if (uncut) {
      const plane::Field::Known known{.bends = options.frontal && plane::Field::may_bend(space),
                                      .triangles = space.measure()};
      mesh = plane::mesh_undivided(c.domain, space, known, options, monitor).mesh;
    } else {
      mesh = mesh_plane(c.domain, space, options, monitor);
    }
    seconds.push_back(now() - start);
    waited.push_back(clock_on_the_wall() - begin);
  }
  std::sort(seconds.begin(), seconds.end());
  const double n = static_cast<double>(mesh.triangles.size());
  std::printf("%s %s: boundary %zu, %s\n", argv[1], argv[2], c.domain.edges.size(),
              to_string(measure(c, mesh)).c_str());
  std::sort(sampling.begin(), sampling.end());
  const double meshing = seconds[seconds.size() / 2], space_time = sampling[sampling.size() / 2];
  std::printf("  %.0f triangles/s of processor, median of %d, %.0f best; %.0f with the control space (%zu samples)\n",
              n / meshing, runs, n / seconds[0], n / (meshing + space_time), space.samples());
  std::printf("  %.3f s of processor at best, %.3f s on the wall, %d threads%s\n", seconds[0],
              *std::min_element(waited.begin(), waited.end()), options.executor.threads, uncut ? ", uncut" : "");
  if (std::getenv("CHECK") != nullptr || n < 20000) {
    const auto defects = find_plane_defects(c.domain, mesh);
    for (std::size_t i = 0; i < defects.size() && i < 5; ++i) std::printf("  DEFECT %s\n", defects[i].c_str());
    if (!defects.empty()) return 1;
  }
  return 0;
}
