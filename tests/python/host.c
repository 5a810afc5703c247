/* SPDX-License-Identifier: BSD-3-Clause */
/* Surfaces in C, to be compared with the same formulas in Python: every operation is rounded as there. */
#include <math.h>
#include <stddef.h>
#include <stdint.h>

/* Part of the unit sphere by stereographic projection: + - * / only, which are the same in every language. */
int32_t sphere_surface(int32_t face, double u, double v, int32_t order, double* S, double* Su, double* Sv, double* Suu,
                       double* Suv, double* Svv, void* user) {
  (void)face, (void)order, (void)Su, (void)Sv, (void)Suu, (void)Suv, (void)Svv, (void)user;
  const double w = 1 + u * u + v * v;
  S[0] = 2 * u / w, S[1] = 2 * v / w, S[2] = (w - 2) / w;
  return 0;
}

int32_t torus_surface(int32_t face, double u, double v, int32_t order, double* S, double* Su, double* Sv, double* Suu,
                      double* Suv, double* Svv, void* user) {
  (void)face, (void)order, (void)Su, (void)Sv, (void)Suu, (void)Suv, (void)Svv, (void)user;
  const double r = 2 + cos(v);
  S[0] = r * cos(u), S[1] = r * sin(u), S[2] = sin(v);
  return 0;
}

/* As routines of cad_m: the paraboloid z = (u^2 + v^2) / 2 over the unit square. */
void surf0(const int32_t* refs, const double* uv, double* S) {
  (void)refs;
  S[0] = uv[0], S[1] = uv[1], S[2] = (uv[0] * uv[0] + uv[1] * uv[1]) / 2;
}
void curv_int(const int32_t* refs, const int32_t* ic, double* a, double* b) {
  (void)refs, (void)ic;
  *a = 0, *b = 1;
}
void curv0(const int32_t* refs, const int32_t* ic, const double* t, double* C) {
  static const double at[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
  (void)refs;
  for (int i = 0; i < 2; ++i) C[i] = (1 - *t) * at[*ic - 1][i] + *t * at[*ic][i];
}

int32_t torus_surface_batch(int32_t face, int64_t n, const double* uv, int32_t order, double* S, double* Su, double* Sv,
                            double* Suu, double* Suv, double* Svv, void* user) {
  for (int64_t i = 0; i < n; ++i)
    torus_surface(face, uv[2 * i], uv[2 * i + 1], order, S + 3 * i, Su, Sv, Suu, Suv, Svv, user);
  return 0;
}

int32_t unit_interval(int32_t face, int32_t ic, double* a, double* b, void* user) {
  (void)face, (void)ic, (void)user;
  *a = 0, *b = 1;
  return 0;
}

/* The sides of the box from `user`: u0, v0, u1, v1. */
int32_t box_side(int32_t face, int32_t ic, double t, int32_t order, double* C, double* Ct, double* Ctt, void* user) {
  (void)face;
  const double *b = user, w = b[2] - b[0], h = b[3] - b[1];
  const double start[4][2] = {{b[0], b[1]}, {b[2], b[1]}, {b[2], b[3]}, {b[0], b[3]}};
  const double step[4][2] = {{w, 0}, {0, h}, {-w, 0}, {0, -h}};
  for (int i = 0; i < 2; ++i) {
    C[i] = start[ic - 1][i] + t * step[ic - 1][i];
    if (order > 0) Ct[i] = step[ic - 1][i];
    if (order > 1) Ctt[i] = 0;
  }
  return 0;
}

/* The size 0.05 + |z| / 10 on the torus. */
int32_t torus_size(int32_t face, double u, double v, int32_t* kind, double* value, void* user) {
  (void)face, (void)u, (void)user;
  *kind = 1;
  *value = 0.05 + fabs(sin(v)) / 10;
  return 0;
}
