/* SPDX-License-Identifier: BSD-3-Clause */
/* A field in the place of the flow around the profile at Mach 0.8 and 1.25 degrees: shared by the examples. */
#ifndef NACA0012_FIELD_H
#define NACA0012_FIELD_H

#include <math.h>

static double step(double x) { return 0.5 * (1 + tanh(x)); }

/* Behind `at` the flow is slow; the shock leans back, and ends at `height`. */
static double shock(double x, double y, double at, double height) {
  return step((at + 0.15 * y - x) / 0.02) * step((x - 0.05) / 0.15) * step((height - y) / 0.15);
}

static double f(double x, double y) {
  const double above = step(y / 0.04), speed = 0.8 + 0.5 * above * shock(x, y, 0.62, 0.6);
  return speed + 0.25 * (1 - above) * shock(x, -y, 0.35, 0.3) - 0.6 * exp(-(x * x + y * y) / 0.01);
}

#endif
