/* SPDX-License-Identifier: BSD-3-Clause */
/* Sizes that are fine along a Lissajous curve (HDR sec. 1.1.2): shared by the examples. */
#ifndef LISSAJOUS_FIELD_H
#define LISSAJOUS_FIELD_H

#include <math.h>

/* The figure does not name the curve: this one has as many triangles in its isotropic mesh, with hmin chosen so. */
static const double two_pi = 6.283185307179586, side_length = 2.4, hmin = 0.0104, hmax = 0.12;

/* ---- The curve x = sin 2t, y = sin 3t, and the fields around it ---- */

static void point_at(double t, double* p, double* d, double* dd) {
  p[0] = sin(2 * t), p[1] = sin(3 * t);
  d[0] = 2 * cos(2 * t), d[1] = 3 * cos(3 * t);
  dd[0] = -4 * p[0], dd[1] = -9 * p[1];
}

enum { places = 400 };
static double place[places][2]; /* on the curve */

/* Distance from the curve, and its direction at the nearest point: the best of 400 places, then Newton's steps. */
static double distance(double x, double y, double* direction) {
  double best = HUGE_VAL, t = 0, p[2], d[2], dd[2];
  for (int i = 0; i < places; ++i) {
    const double dx = place[i][0] - x, dy = place[i][1] - y;
    if (dx * dx + dy * dy < best) best = dx * dx + dy * dy, t = i * two_pi / places;
  }
  for (int i = 0; i < 4; ++i) {
    point_at(t, p, d, dd);
    const double slope = (p[0] - x) * d[0] + (p[1] - y) * d[1];
    const double bend = d[0] * d[0] + d[1] * d[1] + (p[0] - x) * dd[0] + (p[1] - y) * dd[1];
    if (bend <= 0) break;
    t -= fmax(-0.008, fmin(0.008, slope / bend));
  }
  point_at(t, p, d, dd);
  const double length = hypot(d[0], d[1]);
  direction[0] = d[0] / length, direction[1] = d[1] / length;
  return fmin(sqrt(best), hypot(p[0] - x, p[1] - y));
}

static double bounded(double h) { return fmin(fmax(h, hmin), hmax); }

struct field {
  double elongation; /* size along the curve over that across it, before they are bounded */
};

static void sizes(const struct field* field, double x, double y, double* along, double* across, double* direction) {
  const double d = distance(x, y, direction);
  *across = bounded(0.3 * d);
  *along = bounded(field->elongation * 0.3 * d);
}

/* To be called once. */
static void find_places(void) {
  for (int i = 0; i < places; ++i)
    place[i][0] = sin(2 * i * two_pi / places), place[i][1] = sin(3 * i * two_pi / places);
}

#endif
