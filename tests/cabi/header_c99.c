/* SPDX-License-Identifier: BSD-3-Clause */
/* carreau.h is C99: compiled with -std=c99 -pedantic -Werror. A host of one page that meshes the manual's paraboloid
 * from memory. Exits with 0 when the mesh has the 216 boundary edges that its sizes prescribe (RT-0232 sec. 6.1). */
#include <stdio.h>
#include <stdlib.h>

#include "carreau.h"

static int32_t surface(int32_t face, double u, double v, int32_t order, double* S, double* Su, double* Sv, double* Suu,
                       double* Suv, double* Svv, void* user) {
  (void)face, (void)user;
  S[0] = u, S[1] = v, S[2] = (u * u + v * v) / 2;
  if (order >= 1) Su[0] = 1, Su[1] = 0, Su[2] = u, Sv[0] = 0, Sv[1] = 1, Sv[2] = v;
  if (order >= 2) Suu[0] = Suu[1] = Suv[0] = Suv[1] = Suv[2] = Svv[0] = Svv[1] = 0, Suu[2] = Svv[2] = 1;
  return 0;
}

static int32_t interval(int32_t face, int32_t ic, double* a, double* b, void* user) {
  (void)face, (void)ic, (void)user;
  *a = 0, *b = 1;
  return 0;
}

static int32_t curve(int32_t face, int32_t ic, double t, int32_t order, double* C, double* Ct, double* Ctt,
                     void* user) {
  static const double corner[5][2] = {{-2.5, -2.5}, {2.5, -2.5}, {2.5, 2.5}, {-2.5, 2.5}, {-2.5, -2.5}};
  const double *p = corner[ic - 1], *q = corner[ic];
  int i;
  (void)face, (void)user;
  for (i = 0; i < 2; ++i) {
    C[i] = p[i] + t * (q[i] - p[i]);
    if (order >= 1) Ct[i] = q[i] - p[i];
    if (order >= 2) Ctt[i] = 0;
  }
  return 0;
}

int main(void) {
  carreau_cad cad = {0};
  carreau_session* session = NULL;
  carreau_mesh* mesh = NULL;
  carreau_quality quality = {0};
  int64_t edges = 0;
  int32_t ic;
  cad.struct_size = sizeof cad;
  cad.surface_order = cad.curve_order = 2;
  cad.surface = surface;
  cad.curve_interval = interval;
  cad.curve = curve;
  quality.struct_size = sizeof quality;
  if (carreau_session_create(&session) != CARREAU_OK) return EXIT_FAILURE;
  carreau_set_cad(session, &cad);
  carreau_model_add_face(session, 1, 1);
  for (ic = 1; ic <= 4; ++ic) carreau_model_add_curve(session, 1, CARREAU_BOUNDARY, 0, 0, 0);
  if (carreau_mesh_generate(session) != CARREAU_OK || carreau_session_mesh(session, &mesh) != CARREAU_OK ||
      carreau_mesh_count(mesh, NULL, NULL, &edges, NULL) != CARREAU_OK ||
      carreau_mesh_quality(mesh, &quality) != CARREAU_OK) {
    fprintf(stderr, "%s\n", carreau_last_error(session));
    carreau_session_free(session);
    return EXIT_FAILURE;
  }
  printf("%lld vertices, %lld triangles, %lld boundary edges, quality %g\n", (long long)quality.vertices,
         (long long)quality.triangles, (long long)edges, quality.q2_mean);
  carreau_session_free(session);
  return edges == 216 && quality.open_edges == 216 ? EXIT_SUCCESS : EXIT_FAILURE;
}
