// SPDX-License-Identifier: BSD-3-Clause
// Cost of fields: nanoseconds a triangle of the plane mesher and of the control space for size fields and anisotropic
// fields of ratio 10, and both together against a mesh of uniform size in space with about as many triangles, all in
// one run and in turns. Usage: bench_fields [ROUNDS [CASE]].
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "metric_cases.h"
#include "plane/plane_mesher.h"
#include "plane_cases.h"

namespace {

using namespace carreau;
using namespace carreau::testing;

struct FieldCase {
  std::string name;
  PlaneDomain domain;
  std::function<ControlSpace()> space;
  double triangles = 0, sampling = 1e300, meshing = 1e300;  // seconds: the best of all rounds
  [[nodiscard]] double cost() const { return 1e9 * (sampling + meshing) / triangles; }
};

FieldCase of_sizes(const std::string& name, const PlaneCase& c) {
  return {name, c.domain, [c] { return control_space(c, ControlSpaceOptions{}.tolerance); }};
}
FieldCase of_metric(const std::string& name, const MetricCase& c) {
  return {name, c.domain, [c] { return control_space(c); }};
}

// Time of the processor: other work on the machine does not count.
double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void run(FieldCase& c) {
  Monitor monitor;
  double start = now();
  const ControlSpace space = c.space();
  c.sampling = std::min(c.sampling, now() - start);
  start = now();
  const PlaneMesh mesh = mesh_plane(c.domain, space, {}, monitor);
  c.meshing = std::min(c.meshing, now() - start);
  c.triangles = static_cast<double>(mesh.triangles.size());
}

// The first case of a group is the uniform one.
void compare(std::vector<FieldCase> group, int rounds, const std::string& only) {
  if (!only.empty())
    std::erase_if(group, [&](const FieldCase& c) { return c.name != only && c.name != group.front().name; });
  for (int k = 0; k < rounds; ++k)
    for (FieldCase& c : group) run(c);
  for (const FieldCase& c : group)
    std::printf("%-24s %8.0f triangles %8.1f ns meshing %8.1f ns control space: %.2f times uniform\n", c.name.c_str(),
                c.triangles, 1e9 * c.meshing / c.triangles, 1e9 * c.sampling / c.triangles,
                c.cost() / group.front().cost());
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 7;
  const std::string only = argc > 2 ? argv[2] : "";
  compare({of_sizes("uniform 20 k", paraboloid(0.082)), of_sizes("sizes 20 k", size_field(1)),
           of_metric("line 20 k", layer_on_line(0.00122, 10)), of_metric("circle 20 k", layer_on_circle(0.00255, 10)),
           of_metric("spiral 20 k", layer_on_spiral(0.00155, 10)), of_metric("sine 20 k", layer_on_sine(0.00635, 10))},
          rounds, only);
  compare(
      {of_sizes("uniform 100 k", paraboloid(0.0358)), of_sizes("sizes 100 k", size_field(0.42)),
       of_metric("line 100 k", layer_on_line(0.00049, 10)), of_metric("circle 100 k", layer_on_circle(0.00101, 10)),
       of_metric("spiral 100 k", layer_on_spiral(0.00052, 10)), of_metric("sine 100 k", layer_on_sine(0.00257, 10))},
      rounds, only);
  return 0;
}
