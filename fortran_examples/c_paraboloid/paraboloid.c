/* SPDX-License-Identifier: BSD-3-Clause */
/* Paraboloid z = (u^2 + v^2) / 2 over a square (RT-0232 sec. 6.1) by the C interface. Geometry, model and mesh stay in
 * memory, without files. All sizes are the defaults. The program checks the mesh itself, and fails if it is wrong.
 */
#include <carreau.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* ---- Geometry: one face, whose parameter domain is the square [-2.5, 2.5]^2 ---- */

static int32_t surface(int32_t face, double u, double v, int32_t order, double* S, double* Su, double* Sv, double* Suu,
                       double* Suv, double* Svv, void* user) {
  (void)face, (void)user;
  S[0] = u, S[1] = v, S[2] = (u * u + v * v) / 2;
  if (order >= 1) {
    Su[0] = 1, Su[1] = 0, Su[2] = u;
    Sv[0] = 0, Sv[1] = 1, Sv[2] = v;
  }
  if (order >= 2) {
    Suu[0] = 0, Suu[1] = 0, Suu[2] = 1;
    Suv[0] = 0, Suv[1] = 0, Suv[2] = 0;
    Svv[0] = 0, Svv[1] = 0, Svv[2] = 1;
  }
  return 0; /* any other value: a failure */
}

static int32_t interval(int32_t face, int32_t ic, double* a, double* b, void* user) {
  (void)face, (void)ic, (void)user;
  return *a = 0, *b = 1, 0;
}

/* The sides of the square, counterclockwise: the domain is on their left. */
static int32_t side(int32_t face, int32_t ic, double t, int32_t order, double* C, double* Ct, double* Ctt, void* user) {
  static const double corners[5][2] = {{-2.5, -2.5}, {2.5, -2.5}, {2.5, 2.5}, {-2.5, 2.5}, {-2.5, -2.5}};
  const double *p = corners[ic - 1], *q = corners[ic];
  (void)face, (void)user;
  for (int i = 0; i < 2; ++i) {
    C[i] = p[i] + t * (q[i] - p[i]);
    if (order >= 1) Ct[i] = q[i] - p[i];
    if (order >= 2) Ctt[i] = 0;
  }
  return 0;
}

static carreau_status mesh_paraboloid(carreau_session* session) {
  const carreau_cad cad = {.struct_size = sizeof cad,
                           .surface_order = 2,
                           .curve_order = 2,
                           .surface = surface,
                           .curve_interval = interval,
                           .curve = side};
  carreau_status status = carreau_set_cad(session, &cad);
  if (status == CARREAU_OK) status = carreau_model_add_face(session, 1, 1);
  for (int32_t ic = 1; ic <= 4 && status == CARREAU_OK; ++ic) /* side ic joins the corners ic and ic + 1 */
    status = carreau_model_add_curve(session, 1, CARREAU_BOUNDARY, ic, ic, ic % 4 + 1);
  return status == CARREAU_OK ? carreau_mesh_generate(session) : status;
}

/* ---- Checks of the mesh ---- */

static int wrong = 0;
static void claim(int holds, const char* sentence) {
  if (!holds) wrong = 1, fprintf(stderr, "this does not hold: %s\n", sentence);
}

/* FNV-1a of numbers, whatever the order of bytes of the machine: equal meshes, equal fingerprints. */
static uint64_t fingerprint(uint64_t hash, uint64_t number) {
  for (int byte = 0; byte < 8; ++byte) hash = (hash ^ (number >> 8 * byte & 255)) * UINT64_C(1099511628211);
  return hash;
}

static void check(carreau_mesh* mesh, const carreau_quality* q) {
  const int64_t n = q->vertices, m = q->triangles;
  double* xyz = malloc((size_t)n * 3 * sizeof *xyz);
  double* uv = malloc((size_t)m * 6 * sizeof *uv);
  int32_t* triangles = malloc((size_t)m * 3 * sizeof *triangles);
  int on_surface = 1, turned = 1;
  uint64_t hash = UINT64_C(14695981039346656037);
  if (!xyz || !uv || !triangles || carreau_mesh_vertices(mesh, n, xyz) || carreau_mesh_triangles(mesh, m, triangles) ||
      carreau_mesh_corner_uv(mesh, m, uv)) {
    claim(0, "the arrays can be had");
  } else {
    for (int64_t i = 0; i < 3 * n; ++i) {
      const union {
        double x;
        uint64_t bits;
      } pun = {xyz[i]};
      hash = fingerprint(hash, pun.bits);
    }
    for (int64_t i = 0; i < 3 * m; ++i) { /* corner i has the vertex p and the parameters c */
      const double *p = xyz + 3 * triangles[i], *c = uv + 2 * i;
      hash = fingerprint(hash, (uint64_t)triangles[i]);
      on_surface &= p[0] == c[0] && p[1] == c[1] && p[2] == (c[0] * c[0] + c[1] * c[1]) / 2;
    }
    for (const double* c = uv; c < uv + 6 * m; c += 6)
      turned &= (c[2] - c[0]) * (c[5] - c[1]) - (c[4] - c[0]) * (c[3] - c[1]) > 0;
    claim(on_surface, "every vertex is S(u, v) of the parameters of its corners, to the last bit");
    claim(turned, "every triangle is counterclockwise in (u, v)");
    printf("fingerprint %016" PRIx64 "\n", hash);
  }
  free(xyz), free(uv), free(triangles);
  claim(q->open_edges == 216, "the border has 216 edges");
  claim(fabs((double)m / 4980 - 1) <= 0.06, "there are 4980 triangles, within 6 %");
  claim(n - q->edges + m == 1, "Euler's number of a disc is 1");
  claim(fabs(q->area / 54.8209336 - 1) <= 5e-4, "the area of the paraboloid is 54.8209, within 0.05 %");
  claim(q->q2_mean >= 0.989 && q->q2_p1 >= 0.92 && q->q2_min >= 0.6, "triangles have good shapes");
}

int main(void) {
  carreau_session* session = NULL;
  carreau_mesh* mesh = NULL;
  carreau_report report = {.struct_size = sizeof report};
  carreau_quality q = {.struct_size = sizeof q};
  if (carreau_session_create(&session) != CARREAU_OK) return 1;
  if (mesh_paraboloid(session) != CARREAU_OK || carreau_session_report(session, &report) != CARREAU_OK ||
      carreau_session_mesh(session, &mesh) != CARREAU_OK || carreau_mesh_quality(mesh, &q) != CARREAU_OK)
    return fprintf(stderr, "%s\n", carreau_last_error(session)), 1;
  printf("%" PRId64 " vertices, %" PRId64 " triangles, %" PRId64 " boundary edges, area %.6g\n", q.vertices,
         q.triangles, q.open_edges, q.area);
  printf("shape quality Q2: mean %.4f, first percentile %.3f, worst %.3f; %.1f %% of the vertices have degree 6\n",
         q.q2_mean, q.q2_p1, q.q2_min, 100 * q.degree6);
  printf("diag %.4g, %.4f s\n", report.diag, report.seconds_total);
  check(mesh, &q);
  carreau_session_free(session);
  return wrong;
}
