// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/grid/differences.h"

namespace carreau::grid {

Vec3 parabola_derivative(const Sample& a, const Sample& b, const Sample& c, double at) {
  const Vec3 ab = (b.p - a.p) / (b.x - a.x), bc = (c.p - b.p) / (c.x - b.x);
  const Vec3 bend = (bc - ab) / (c.x - a.x);  // half the second derivative
  return ab + (2 * at - a.x - b.x) * bend;
}

namespace {

/// Derivatives of points [first, last) of the line, all of them present.
void differentiate_run(std::span<const Sample> run, std::span<Vec3> out) {
  const std::size_t n = run.size();
  if (n < 2) return;
  if (n == 2) {
    out[0] = out[1] = (run[1].p - run[0].p) / (run[1].x - run[0].x);
    return;
  }
  out[0] = parabola_derivative(run[0], run[1], run[2], run[0].x);
  for (std::size_t k = 1; k + 1 < n; ++k) out[k] = parabola_derivative(run[k - 1], run[k], run[k + 1], run[k].x);
  out[n - 1] = parabola_derivative(run[n - 3], run[n - 2], run[n - 1], run[n - 1].x);
}

}  // namespace

std::vector<Vec3> line_derivatives(std::span<const Sample> line, std::span<const char> there, bool closed) {
  const std::size_t n = line.size();
  std::vector<Vec3> out(n);
  for (std::size_t k = 0; k < n;) {
    std::size_t end = k;
    while (end < n && there[end] != 0) ++end;
    differentiate_run(line.subspan(k, end - k), std::span(out).subspan(k, end - k));
    k = end + 1;
  }
  if (closed && n > 3 && there[0] != 0 && there[1] != 0 && there[n - 2] != 0) {
    const Sample before{line[0].x - (line[n - 1].x - line[n - 2].x), line[n - 2].p};
    out[0] = out[n - 1] = parabola_derivative(before, line[0], line[1], line[0].x);
  }
  return out;
}

}  // namespace carreau::grid
