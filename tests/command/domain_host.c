/* SPDX-License-Identifier: BSD-3-Clause */
/* Faces without second derivatives that abort outside of their domains: 1 a hemisphere over a disc, 2 z = 1 / r over a ring,
   3 a paraboloid over a crescent with corners of 35 degrees, 4 half of a cylinder over a rectangle, 5 a hyperboloid over a ring, whose slope is
   infinite on the inner circle. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846, corner = 1.26610367277949912; /* acos(.3) */

static void stay_inside(int face, const double* p) {
  const double r2 = p[0] * p[0] + p[1] * p[1], s2 = (p[0] - 0.6) * (p[0] - 0.6) + p[1] * p[1], rounding = 1e-12;
  if (face == 4 ? fabs(p[0]) > 1 + rounding || fabs(p[1]) > 1 + rounding : r2 > 1 + rounding) abort();
  if ((face == 2 && r2 < 0.25 - rounding) || (face == 3 && s2 < 1 - rounding)) abort();
}
void surf0(const int32_t* refs, const double* uv, double* S) {
  const double u = uv[0], v = uv[1], r2 = u * u + v * v;
  stay_inside(*refs, uv);
  S[0] = u, S[1] = v;
  S[2] = *refs == 1 ? sqrt(fmax(0, 1 - r2)) : *refs == 2 ? 1 / sqrt(r2) : *refs == 3 ? r2 / 2 : sqrt(fmax(0, *refs == 4 ? 1 - u * u : r2 - 0.25));
}
#ifdef FIRST /* of the paraboloid alone */
void surf1(const int32_t* refs, const double* uv, double* Su, double* Sv) {
  stay_inside(*refs, uv);
  Su[0] = 1, Su[1] = 0, Su[2] = uv[0];
  Sv[0] = 0, Sv[1] = 1, Sv[2] = uv[1];
}
#endif
void curv_int(const int32_t* refs, const int32_t* ic, double* a, double* b) {
  *a = *refs == 3 ? *ic == 1 ? corner : -corner : 0;
  *b = *refs == 4 ? 1 : *refs == 3 && *ic == 2 ? corner : 2 * pi - *a;
}
void curv0(const int32_t* refs, const int32_t* ic, const double* t, double* C) {
  if (*refs == 4) {
    C[0] = *ic == 1 ? 2 * *t - 1 : *ic == 2 ? 1 : *ic == 3 ? 1 - 2 * *t : -1;
    C[1] = *ic == 1 ? -1 : *ic == 2 ? 2 * *t - 1 : *ic == 3 ? 1 : 1 - 2 * *t;
  } else if (*ic == 2 && *refs == 3) {
    C[0] = 0.6 - cos(*t), C[1] = sin(*t); /* from the lower corner to the upper one */
  } else {
    const double r = *ic == 2 ? 0.5 : 1;
    C[0] = r * cos(*t), C[1] = (*ic == 2 ? -r : r) * sin(*t);
  }
}
