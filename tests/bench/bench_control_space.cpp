// SPDX-License-Identifier: BSD-3-Clause
// Cost and accuracy of a control space: samples and build time for each vertex of the mesh to come,
// time of at(), errors of lengths. Usage: bench_control_space [factor on sizes, default 1]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <random>

#include "cpp/control_space/control_space_fields.h"
#include "metric/metric2_algebra.h"
#include "predicates/polygon_locator.h"

namespace {

using carreau::ControlSpace;
using carreau::Metric2;
using carreau::Vec2;
using carreau::fields::Field;

// Time of the processor: other work on the machine does not count.
double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

ControlSpace build(const Field& field) {
  carreau::Monitor monitor;
  return ControlSpace::build(
      field.domain,
      [&](std::span<const Vec2> uv, std::span<Metric2> metric) {
        for (std::size_t i = 0; i < uv.size(); ++i) metric[i] = field.metric(uv[i]);
      },
      {}, monitor);
}

// Nanoseconds a call, the best of five runs over all points.
double time_of_at(const ControlSpace& space, const std::vector<Vec2>& points) {
  double best = 1e9, sum = 0;
  for (int run = 0; run < 5; ++run) {
    const double start = now();
    for (const Vec2& p : points) sum += space.at(p).a;
    best = std::min(best, now() - start);
  }
  if (sum == 0.5) std::puts("");  // the sum is used
  return best / static_cast<double>(points.size()) * 1e9;
}

void report(const Field& field) {
  double best = 1e9;
  for (int run = 0; run < 5; ++run) {
    const double start = now();
    (void)build(field);
    best = std::min(best, now() - start);
  }
  const ControlSpace space = build(field);
  const carreau::PolygonLocator locator(field.domain.vertices, field.domain.edges);
  Vec2 low = field.domain.vertices[0], high = low;
  for (const Vec2& p : field.domain.vertices) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec2> points;
  while (points.size() < 40'000) {
    const Vec2 p{low.x() + unit(engine) * (high.x() - low.x()), low.y() + unit(engine) * (high.y() - low.y())};
    if (locator.contains(p)) points.push_back(p);
  }
  std::vector<double> error;
  for (const Vec2& p : points) error.push_back(carreau::length_error(space.at(p), field.metric(p)));
  std::sort(error.begin(), error.end());
  double mean = 0;
  for (const double e : error) mean += e / static_cast<double>(error.size());
  const double at_random = time_of_at(space, points);
  // Successive queries of a mesher are near each other.
  const auto row = [&](Vec2 p) { return std::floor((p.y() - low.y()) / (high.y() - low.y()) * 100); };
  std::sort(points.begin(), points.end(),
            [&](Vec2 p, Vec2 q) { return row(p) != row(q) ? row(p) < row(q) : p.x() < q.x(); });
  const double vertices = 0.5 * space.measure();
  std::printf("%-30s %8.0f %7.3f %8.3f %6.0f %9.1e %9.1e %9.1e %5.1f %5.1f %8zu\n", field.name.c_str(), vertices,
              static_cast<double>(space.samples()) / vertices, best * 1e3, best / vertices * 1e9, mean,
              error[error.size() * 99 / 100], error.back(), time_of_at(space, points), at_random, space.bytes() / 1000);
}

}  // namespace

int main(int argc, char** argv) {
  namespace fields = carreau::fields;
  const double f = argc > 1 ? std::atof(argv[1]) : 1;
  std::printf("%-30s %8s %7s %8s %6s %9s %9s %9s %5s %5s %8s\n", "field", "vertices", "samples", "build", "", "error",
              "", "", "at", "", "memory");
  std::printf("%-30s %8s %7s %8s %6s %9s %9s %9s %5s %5s %8s\n", "", "", "/vertex", "ms", "ns/v", "mean", "p99",
              "worst", "ns", "random", "kB");
  for (const Field& field :
       {fields::paraboloid(0.1546 * f), fields::paraboloid_on_disc(0.13 * f), fields::paraboloid_on_l_shape(0.12 * f),
        fields::wavy_plate_with_holes(0.04 * f), fields::hemisphere(0.05 * f), fields::torus(0.18 * f),
        fields::ellipsoid_by_curvature(4 * f * fields::pi / 180), fields::sphere_with_pole(0.055 * f),
        fields::sphere_by_projection(0.05 * f), fields::swirl(3, 0.045 * f), fields::swirl(7, 0.045 * f),
        fields::ring(0.1 * f), fields::thousandfold_sizes()})
    report(field);
}
