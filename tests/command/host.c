/* SPDX-License-Identifier: BSD-3-Clause */
/* The paraboloid of RT-0232 sec. 6.1 as a shared library: the least that is needed, under plain names. */
#include <math.h>
#include <stdint.h>

static const double corner[5][2] = {{-2.5, -2.5}, {2.5, -2.5}, {2.5, 2.5}, {-2.5, 2.5}, {-2.5, -2.5}};

/* Face 2 is face 1 with a hole in its parametrisation: it cannot be meshed. */
void surf0(const int32_t* refs, const double* uv, double* S) {
  S[0] = uv[0], S[1] = uv[1], S[2] = (uv[0] * uv[0] + uv[1] * uv[1]) / 2;
  if (*refs == 2 && uv[0] * uv[0] + uv[1] * uv[1] < 1) S[0] = NAN;
}
void curv_int(const int32_t* refs, const int32_t* ic, double* a, double* b) { *a = 0 * *refs, *b = 1 + 0 * *ic; }
void curv0(const int32_t* refs, const int32_t* ic, const double* t, double* C) {
  const double* p = corner[*ic - (*refs > 0)];
  for (int i = 0; i < 2; ++i) C[i] = p[i] + *t * (p[2 + i] - p[i]);
}
