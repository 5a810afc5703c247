// SPDX-License-Identifier: BSD-3-Clause
// bench_distance A B ANGLE [THREADS]: how far the mesh A is from B, and B from A (vertices, middles of edges and triangles), and
// how far points of the sharp lines of B are from the sharp lines of A; then their numbers of sharp edges. A second line: bounds
// of the distances of all points, A from B and B from A, and seconds of processors a million triangles of A and of B that they
// take.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "geometry/discrete/sharp_lines.h"
#include "io/mesh_files.h"
#include "mesh/distance/surface_distance.h"
#include "mesh/triangle_search.h"

using namespace carreau;

namespace {

/// Edges as flat triangles.
std::vector<std::array<std::int32_t, 3>> lines_of(const discrete::Triangulation& mesh, double angle) {
  const discrete::SharpLines lines = find_sharp_lines(mesh, {.sharp_angle = angle, .references = false});
  std::vector<std::array<std::int32_t, 3>> edges;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    if (lines.sharp[e] != 0) edges.push_back({mesh.edges[e][0], mesh.edges[e][1], mesh.edges[e][1]});
  return edges;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4 && argc != 5) return std::puts("bench_distance A B ANGLE [THREADS]"), 2;
  const discrete::Triangulation a(read_mesh(argv[1])), b(read_mesh(argv[2]));
  Monitor silent;
  const double angle = std::atof(argv[3]);
  const auto of_a = lines_of(a, angle), of_b = lines_of(b, angle);
  std::printf("%.6g %.6g %.6g %zu %zu\n", largest_distance(a.vertices, a.triangles, b.vertices, b.triangles, silent),
              largest_distance(b.vertices, b.triangles, a.vertices, a.triangles, silent),
              of_b.empty()   ? 0
              : of_a.empty() ? 1e300
                             : largest_distance(b.vertices, of_b, a.vertices, of_a, silent),
              of_a.size(), of_b.size());
  const int threads = argc == 5 ? std::atoi(argv[4]) : 1;
  const auto tell = [&](const discrete::Triangulation& from, const discrete::Triangulation& to) {
    const std::clock_t start = std::clock();
    const DistanceBounds found =
        bound_distance({from.vertices, from.triangles}, {to.vertices, to.triangles}, {}, threads, silent);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    std::printf("%.6g %.6g ", found.lower, found.upper);
    return 1e6 * seconds / static_cast<double>(from.triangles.size());
  };
  const double there = tell(a, b), back = tell(b, a);
  std::printf("%.3g %.3g\n", there, back);
}
