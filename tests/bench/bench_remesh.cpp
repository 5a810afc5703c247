// SPDX-License-Identifier: BSD-3-Clause
// Milliseconds a remeshing of a pressed disc against the number of its triangles: bench_remesh [runs]. Columns: without
// fields; with damage, velocities and six values in triangles; with the error estimate of a nodal field besides.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <vector>

#include "variable/remesh.h"

namespace {

using namespace carreau;
using namespace carreau::variable;

// Time of the processor: other work on the machine does not count.
double now() { return 1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// A fan about the centre: the first remeshing makes a mesh of it.
RemeshInput disc(double h) {
  RemeshInput input;
  const int n = static_cast<int>(2 * std::numbers::pi / h);
  for (int i = 0; i < n; ++i)
    input.piece.vertices.emplace_back(std::cos(2 * std::numbers::pi * i / n), std::sin(2 * std::numbers::pi * i / n));
  input.piece.vertices.emplace_back(0, 0);
  for (int i = 0; i < n; ++i) input.piece.triangles.push_back({i, (i + 1) % n, n});
  input.h_min = h / 4, input.h_max = h;
  input.step = h / 20;
  Monitor monitor;
  input.piece = remesh(input, monitor).piece;
  input.tools = {Tool{{{9, -1}, {-9, -1}}, {}, false}, Tool{{{-9, 1}, {9, 1}}, {}, false}};
  return input;
}

void add_state(RemeshInput& input) {
  for (std::size_t t = 0; t < input.piece.triangles.size(); ++t) {
    const Vec2 p = input.piece.vertices[static_cast<std::size_t>(input.piece.triangles[t][0])];
    input.damage.push_back(0.3 * std::exp(-50 * std::pow(p.x() - p.y(), 2)));
  }
  input.fields = {{"velocity", FieldKind::nodal, 2, std::vector<double>(2 * input.piece.vertices.size(), 1)},
                  {"density", FieldKind::element_conserved, 1, std::vector<double>(input.piece.triangles.size(), 1)},
                  {"stress", FieldKind::element_mean, 5, std::vector<double>(5 * input.piece.triangles.size(), 1)}};
}

void add_error(RemeshInput& input) {
  input.error_field = static_cast<int>(input.fields.size());
  RemeshField field{"temperature", FieldKind::nodal, 1, {}};
  for (const Vec2& p : input.piece.vertices) field.values.push_back(std::sin(3 * p.x()));
  input.estimator.tolerance = 1;  // sizes stay as they are
  input.fields.push_back(field);
}

double milliseconds(const RemeshInput& input, int runs, std::size_t& triangles) {
  std::vector<double> times;
  Monitor monitor;
  for (int run = 0; run < runs; ++run) {
    const double start = now();
    triangles = remesh(input, monitor).piece.triangles.size();
    times.push_back(now() - start);
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 15;
  std::printf("triangles  plain ms  with fields (triangles)  with estimate\n");
  for (const double h : {0.12, 0.085, 0.06, 0.0425, 0.03, 0.015, 0.0075}) {
    RemeshInput input = disc(h);
    std::size_t plain_count = 0, count = 0, estimate_count = 0;
    const double plain = milliseconds(input, runs, plain_count);
    add_state(input);
    const double fields = milliseconds(input, runs, count);
    add_error(input);
    const double estimate = milliseconds(input, runs, estimate_count);
    std::printf("%8zu  %8.2f  %8.2f (%zu)  %8.2f (%zu)\n", plain_count, plain, fields, count, estimate, estimate_count);
  }
  return 0;
}
