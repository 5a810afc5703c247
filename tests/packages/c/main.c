/* SPDX-License-Identifier: BSD-3-Clause */
/* A customer's program: the unit square in space, meshed from memory with edges of length 0.1. */
#include <carreau.h>
#include <math.h>
#include <stdio.h>

static int32_t surface(int32_t face, double u, double v, int32_t order, double* S, double* Su, double* Sv, double* Suu,
                       double* Suv, double* Svv, void* user) {
  (void)face, (void)order, (void)user;
  S[0] = u, S[1] = v, S[2] = 2;
  Su[0] = 1, Su[1] = 0, Su[2] = 0;
  Sv[0] = 0, Sv[1] = 1, Sv[2] = 0;
  for (int i = 0; i < 3; ++i) Suu[i] = Suv[i] = Svv[i] = 0;
  return 0;
}

static int32_t interval(int32_t face, int32_t ic, double* a, double* b, void* user) {
  (void)face, (void)ic, (void)user;
  *a = 0, *b = 1;
  return 0;
}

/* The four sides, counterclockwise. */
static int32_t curve(int32_t face, int32_t ic, double t, int32_t order, double* C, double* Ct, double* Ctt,
                     void* user) {
  static const double from[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, step[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  (void)face, (void)order, (void)user;
  for (int i = 0; i < 2; ++i) {
    C[i] = from[ic - 1][i] + t * step[ic - 1][i];
    Ct[i] = step[ic - 1][i];
    Ctt[i] = 0;
  }
  return 0;
}

static carreau_status mesh_square(carreau_session* session, carreau_mesh** mesh) {
  carreau_cad cad = {0};
  cad.struct_size = sizeof cad;
  cad.surface_order = cad.curve_order = 2;
  cad.surface = surface, cad.curve_interval = interval, cad.curve = curve;
  carreau_status status = carreau_set_cad(session, &cad);
  if (status == CARREAU_OK) status = carreau_model_add_face(session, 1, 1);
  for (int32_t side = 1; side <= 4 && status == CARREAU_OK; ++side)
    status = carreau_model_add_curve(session, 1, CARREAU_BOUNDARY, side, side, side % 4 + 1);
  if (status == CARREAU_OK) status = carreau_set_real(session, "hphydef", 0.1);
  if (status == CARREAU_OK) status = carreau_mesh_generate(session);
  if (status == CARREAU_OK) status = carreau_session_mesh(session, mesh);
  return status;
}

int main(void) {
  carreau_session* session = NULL;
  carreau_mesh* mesh = NULL;
  if (carreau_session_create(&session) != CARREAU_OK) return 1;
  if (mesh_square(session, &mesh) != CARREAU_OK) return fprintf(stderr, "%s\n", carreau_last_error(session)), 1;
  carreau_quality q = {0};
  q.struct_size = sizeof q;
  if (carreau_mesh_quality(mesh, &q) != CARREAU_OK) return fprintf(stderr, "%s\n", carreau_mesh_last_error(mesh)), 1;
  printf("carreau %s: %lld vertices, %lld triangles, area %.15g\n", carreau_version(), (long long)q.vertices,
         (long long)q.triangles, q.area);
  carreau_session_free(session);
  /* Sides of length 1 with edges of 0.1; a plane square keeps its area; Euler's number of a disc is 1. */
  return q.open_edges == 40 && fabs(q.area - 1) < 1e-12 && q.vertices - q.edges + q.triangles == 1 ? 0 : 1;
}
