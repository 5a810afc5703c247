/* SPDX-License-Identifier: BSD-3-Clause */
/* A geometry that ends its program, or tries to, in its FAULT-th way. */
#include <stdlib.h>

static int calls;

static int deeper(volatile int n) {
  volatile char much[4096];
  much[0] = (char)n;
  return n < 0 ? 0 : deeper(n + 1) + much[0];
}

void surf0(const int* refs, const double uv[2], double S[3]) {
  static int* volatile nowhere;
  (void)refs;
  S[0] = uv[0], S[1] = uv[1], S[2] = 0;
  if (++calls < 200) return; /* the mesh has begun */
  if (FAULT == 1) *nowhere = 1;
  if (FAULT == 2) abort();
  if (FAULT == 3) exit(0);
  if (FAULT == 4) S[2] = deeper(1);
}
void curv_int(const int* refs, const int* ic, double* a, double* b) {
  (void)refs;
  *a = *ic - 1, *b = *ic;
}
void curv0(const int* refs, const int* ic, const double* t, double C[2]) {
  const double s = *t - (*ic - 1);
  (void)refs;
  C[0] = *ic == 1 ? s : *ic == 2 ? 1 : *ic == 3 ? 1 - s : 0;
  C[1] = *ic == 1 ? 0 : *ic == 2 ? s : *ic == 3 ? 1 : 1 - s;
}
