/* SPDX-License-Identifier: BSD-3-Clause */
/* Torus of radii 2 and 0.7 by the C interface, from memory only. Two seams join the sides of one face, and cross in one
 * vertex. The mesh is closed. The program checks it from the arrays, and fails if it is wrong. A second mesh, of half the
 * size, shows that the error of the area is of second order. */
#include <carreau.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double two_pi = 6.283185307179586;

/* Radii reach the callbacks through `user`: a host needs no global variables. */
struct torus {
  double big, small;
};

static int32_t surface(int32_t face, double u, double v, int32_t order, double* S, double* Su, double* Sv, double* Suu,
                       double* Suv, double* Svv, void* user) {
  const struct torus* torus = user;
  const double cu = cos(u), su = sin(u), r = torus->small, x = r * cos(v), z = r * sin(v), w = torus->big + x;
  (void)face;
  S[0] = w * cu, S[1] = w * su, S[2] = z;
  if (order >= 1) {
    Su[0] = -w * su, Su[1] = w * cu, Su[2] = 0;
    Sv[0] = -z * cu, Sv[1] = -z * su, Sv[2] = x;
  }
  if (order >= 2) {
    Suu[0] = -w * cu, Suu[1] = -w * su, Suu[2] = 0;
    Suv[0] = z * su, Suv[1] = -z * cu, Suv[2] = 0;
    Svv[0] = -x * cu, Svv[1] = -x * su, Svv[2] = -z;
  }
  return 0;
}

static int32_t interval(int32_t face, int32_t ic, double* a, double* b, void* user) {
  (void)face, (void)ic, (void)user;
  return *a = 0, *b = two_pi, 0;
}

/* 1: v = 0, 2: u = 2 pi, 3: v = 2 pi, 4: u = 0. Both sides of a seam run the same way. */
static int32_t side(int32_t face, int32_t ic, double t, int32_t order, double* C, double* Ct, double* Ctt, void* user) {
  const int along = ic == 1 || ic == 3 ? 0 : 1;
  (void)face, (void)user;
  C[along] = t, C[1 - along] = ic == 2 || ic == 3 ? two_pi : 0;
  if (order >= 1) Ct[along] = 1, Ct[1 - along] = 0;
  if (order >= 2) Ctt[0] = Ctt[1] = 0;
  return 0;
}

static carreau_status describe(carreau_session* session, struct torus* torus) {
  const carreau_cad cad = {.struct_size = sizeof cad,
                           .user = torus,
                           .surface_order = 2,
                           .curve_order = 2,
                           .surface = surface,
                           .curve_interval = interval,
                           .curve = side};
  carreau_status status = carreau_set_cad(session, &cad);
  if (status == CARREAU_OK) status = carreau_model_add_face(session, 1, 1);
  for (int32_t ic = 1; ic <= 4 && status == CARREAU_OK; ++ic) /* references 1 2 1 2: two seams; both ends are point 1 */
    status = carreau_model_add_curve(session, 1, CARREAU_BOUNDARY, (ic - 1) % 2 + 1, 1, 1);
  return status;
}

/* ---- Checks of the mesh ---- */

static int wrong = 0;
static void claim(int holds, const char* sentence) {
  if (!holds) wrong = 1, fprintf(stderr, "this does not hold: %s\n", sentence);
}

static int compare(const void* a, const void* b) {
  const int64_t x = *(const int64_t*)a, y = *(const int64_t*)b;
  return (x > y) - (x < y);
}

/* Checks each side of a triangle as one number. On a closed surface whose triangles are all turned alike, each occurs
 * once, and once more the other way round. Then the number of edges is half the number of sides. */
static void check_sides(int64_t n, int64_t m, const int32_t* triangles) {
  int64_t* sides = malloc((size_t)m * 3 * sizeof *sides);
  int once = 1, paired = 1;
  if (!sides) {
    claim(0, "there is memory");
    return;
  }
  for (int64_t i = 0; i < 3 * m; ++i) sides[i] = triangles[i] * n + triangles[i % 3 == 2 ? i - 2 : i + 1];
  qsort(sides, (size_t)m * 3, sizeof *sides, compare);
  for (int64_t i = 0; i < 3 * m; ++i) {
    const int64_t back = sides[i] % n * n + sides[i] / n;
    once &= i == 0 || sides[i] != sides[i - 1];
    paired &= bsearch(&back, sides, (size_t)m * 3, sizeof *sides, compare) != NULL;
  }
  free(sides);
  claim(once, "no edge has more than two triangles, and neighbours are turned alike");
  claim(paired, "no edge is free");
  claim(2 * n - 3 * m + 2 * m == 0, "Euler's number of a torus is 0");
}

/* A mesh of edges of length h: its error of area, relative. */
static double mesh_torus(carreau_session* session, const struct torus* torus, double h) {
  const double R = torus->big, r = torus->small;
  double area = 0, farthest = 0;
  int64_t n = 0, m = 0;
  carreau_mesh* mesh = NULL;
  carreau_report report = {.struct_size = sizeof report};
  carreau_quality q = {.struct_size = sizeof q};
  if (carreau_set_real(session, "hphydef", h) || carreau_mesh_generate(session) ||
      carreau_session_mesh(session, &mesh) || carreau_session_report(session, &report) ||
      carreau_mesh_count(mesh, &n, &m, NULL, NULL) || carreau_mesh_quality(mesh, &q))
    return claim(0, carreau_last_error(session)), NAN;
  double* xyz = malloc((size_t)n * 3 * sizeof *xyz);
  int32_t* triangles = malloc((size_t)m * 3 * sizeof *triangles);
  if (!xyz || !triangles || carreau_mesh_vertices(mesh, n, xyz) || carreau_mesh_triangles(mesh, m, triangles))
    return claim(0, "the arrays can be had"), free(xyz), free(triangles), NAN;
  for (const double* p = xyz; p < xyz + 3 * n; p += 3)
    farthest = fmax(farthest, fabs(hypot(hypot(p[0], p[1]) - R, p[2]) - r));
  for (const int32_t* t = triangles; t < triangles + 3 * m; t += 3) {
    const double *a = xyz + 3 * t[0], *b = xyz + 3 * t[1], *c = xyz + 3 * t[2];
    const double p[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, s[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    area += hypot(hypot(p[1] * s[2] - p[2] * s[1], p[2] * s[0] - p[0] * s[2]), p[0] * s[1] - p[1] * s[0]) / 2;
  }
  check_sides(n, m, triangles);
  free(xyz), free(triangles);
  const double error = area / (two_pi * R * two_pi * r) - 1;
  printf("h %g: %" PRId64 " vertices, %" PRId64 " triangles, area %.6f (%+.2e), %.4f s\n", h, n, m, area, error,
         report.seconds_total);
  printf("shape quality Q2: mean %.4f, first percentile %.3f, worst %.3f\n", q.q2_mean, q.q2_p1, q.q2_min);
  claim(farthest <= 1e-14 * R, "every vertex is on the torus");
  claim(q.q2_mean >= 0.985 && q.q2_p1 >= 0.9 && q.q2_min >= 0.6, "triangles have good shapes");
  claim(fabs(error) <= h * h / (4 * r * r), "the area agrees with the torus within h^2 / 4 r^2");
  return error;
}

int main(void) {
  struct torus torus = {2, 0.7};
  carreau_session* session = NULL;
  if (carreau_session_create(&session) != CARREAU_OK) return 1;
  if (describe(session, &torus) != CARREAU_OK) return fprintf(stderr, "%s\n", carreau_last_error(session)), 1;
  const double coarse = mesh_torus(session, &torus, 0.15), fine = mesh_torus(session, &torus, 0.075);
  printf("half the size, error of the area divided by %.2f\n", coarse / fine);
  claim(coarse / fine > 3.5 && coarse / fine < 4.5, "half the size, a quarter of the error");
  carreau_session_free(session);
  return wrong;
}
