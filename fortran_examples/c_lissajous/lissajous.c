/* SPDX-License-Identifier: BSD-3-Clause */
/* Meshes of a square that are fine along a Lissajous curve (HDR sec. 1.1.2, fig. 1.9 and 1.10). The size at P is 0.3
 * times the distance of P from the curve, in all directions. The metric has this size across the curve and four times
 * as much along it. Both are bounded. Sizes and metrics come from callbacks. The program measures lengths of edges in the
 * metric, and compares the numbers of triangles with the fields. */
#include <carreau.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "lissajous_field.h"

/* ---- The domain: [-1.2, 1.2]^2 of the plane z = 0 ---- */

static int32_t plane(int32_t face, double u, double v, int32_t order, double* S, double* Su, double* Sv, double* Suu,
                     double* Suv, double* Svv, void* user) {
  (void)face, (void)user;
  S[0] = u, S[1] = v, S[2] = 0;
  if (order >= 1) Su[0] = Sv[1] = 1, Su[1] = Su[2] = Sv[0] = Sv[2] = 0;
  if (order >= 2)
    for (int k = 0; k < 3; ++k) Suu[k] = Suv[k] = Svv[k] = 0;
  return 0;
}

static int32_t interval(int32_t face, int32_t ic, double* a, double* b, void* user) {
  (void)face, (void)ic, (void)user;
  return *a = -side_length / 2, *b = side_length / 2, 0;
}

static int32_t side(int32_t face, int32_t ic, double t, int32_t order, double* C, double* Ct, double* Ctt, void* user) {
  const double sign = ic <= 2 ? 1 : -1, far = side_length / 2;
  const int along = ic % 2 == 1 ? 0 : 1;
  (void)face, (void)user;
  C[along] = sign * t, C[1 - along] = ic == 2 || ic == 3 ? far : -far;
  if (order >= 1) Ct[along] = sign, Ct[1 - along] = 0;
  if (order >= 2) Ctt[0] = Ctt[1] = 0;
  return 0;
}

static int32_t metric(int32_t face, double u, double v, int32_t* kind, double* value, void* user) {
  double direction[2];
  (void)face;
  *kind = CARREAU_METRIC_TANGENT;
  sizes(user, u, v, &value[0], &value[1], direction);
  value[2] = direction[0], value[3] = direction[1], value[4] = 0;
  return 0;
}

/* ---- Checks of the meshes ---- */

static int wrong = 0;
static void claim(int holds, const char* sentence) {
  if (!holds) wrong = 1, fprintf(stderr, "this does not hold: %s\n", sentence);
}

/* Triangles of unit edges: the integral of 1 / (h1 h2) over sqrt(3) / 4. */
static double expected(const struct field* field) {
  const int n = 600;
  double sum = 0, along, across, direction[2];
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      sizes(field, side_length * ((i + 0.5) / n - 0.5), side_length * ((j + 0.5) / n - 0.5), &along, &across,
            direction);
      sum += 1 / (along * across);
    }
  return sum * side_length * side_length / n / n / (sqrt(3) / 4);
}

/* Length of a segment in the metric, by four midpoints. */
static double metric_length(const struct field* field, const double* a, const double* b) {
  double sum = 0, along, across, w[2];
  for (int i = 0; i < 4; ++i) {
    const double s = (i + 0.5) / 4, dx = b[0] - a[0], dy = b[1] - a[1];
    sizes(field, a[0] + s * dx, a[1] + s * dy, &along, &across, w);
    sum += hypot((dx * w[0] + dy * w[1]) / along, (dy * w[0] - dx * w[1]) / across) / 4;
  }
  return sum;
}

/* Number of triangles of the mesh, or -1. */
static int64_t mesh(carreau_session* session, struct field* field, const char* path) {
  const carreau_metric_callbacks callbacks = {.struct_size = sizeof callbacks, .user = field, .surface_metric = metric};
  carreau_mesh* result = NULL;
  int64_t n = 0, m = 0, defects = -1;
  const char* text = NULL;
  if (carreau_set_metric_callbacks(session, &callbacks) || carreau_mesh_generate(session) ||
      carreau_session_mesh(session, &result) || carreau_mesh_count(result, &n, &m, NULL, NULL) ||
      carreau_mesh_defects(result, 0, 10, &defects, &text))
    return claim(0, carreau_last_error(session)), -1;
  claim(defects == 0, "the mesh is sound");
  if (path) claim(carreau_mesh_write(result, path) == CARREAU_OK, "the mesh can be written");
  double* xyz = malloc((size_t)n * 3 * sizeof *xyz);
  int32_t* triangles = malloc((size_t)m * 3 * sizeof *triangles);
  if (!xyz || !triangles || carreau_mesh_vertices(result, n, xyz) || carreau_mesh_triangles(result, m, triangles))
    return claim(0, "the arrays can be had"), free(xyz), free(triangles), -1;
  double mean = 0, within = 0, count = 0, quality = 0;
  for (const int32_t* t = triangles; t < triangles + 3 * m; t += 3)
    for (int k = 0; k < 3; ++k) {
      const double length = metric_length(field, xyz + 3 * t[k], xyz + 3 * t[(k + 1) % 3]);
      mean += length, within += length >= sqrt(0.5) && length <= sqrt(2), ++count;
    }
  for (const int32_t* t = triangles; t < triangles + 3 * m;
       t += 3) { /* 4 sqrt(3) area / sum of squares, at its middle */
    const double *a = xyz + 3 * t[0], *b = xyz + 3 * t[1], *c = xyz + 3 * t[2];
    double along, across, w[2], squares = 0;
    sizes(field, (a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3, &along, &across, w);
    const double* corner[4] = {a, b, c, a};
    for (int k = 0; k < 3; ++k) {
      const double dx = corner[k + 1][0] - corner[k][0], dy = corner[k + 1][1] - corner[k][1];
      squares += pow((dx * w[0] + dy * w[1]) / along, 2) + pow((dy * w[0] - dx * w[1]) / across, 2);
    }
    const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    quality += 2 * sqrt(3) * twice / (along * across) / squares;
  }
  free(xyz), free(triangles);
  mean /= count, within /= count, quality /= (double)m;
  const double wanted = expected(field);
  printf("%" PRId64
         " triangles, %.0f of unit edges; lengths in the metric: mean %.4f, %.2f %% within [0.71, 1.41]; "
         "quality in the metric: mean %.4f\n",
         m, wanted, mean, 100 * within, quality);
  claim(fabs((double)m / wanted - 1) <= 0.15, "the number of triangles agrees with the field within 15 %");
  claim(within >= 0.97, "97 % of the lengths are within [0.71, 1.41]");
  claim(quality >= 0.93, "the mean quality in the metric is at least 0.93");
  return m;
}

/* Without arguments, checks only; otherwise the meshes are written to the folder that is named. */
int main(int argc, char** argv) {
  const carreau_cad cad = {.struct_size = sizeof cad,
                           .surface_order = 2,
                           .curve_order = 2,
                           .surface = plane,
                           .curve_interval = interval,
                           .curve = side};
  find_places();
  carreau_session* session = NULL;
  if (carreau_session_create(&session) != CARREAU_OK) return 1;
  int32_t status = carreau_set_cad(session, &cad);
  if (!status) status = carreau_model_add_face(session, 1, 1);
  for (int32_t ic = 1; ic <= 4 && !status; ++ic)
    status = carreau_model_add_curve(session, 1, CARREAU_BOUNDARY, ic, ic, ic % 4 + 1);
  if (!status) status = carreau_set_real(session, "hphymin", hmin / 2);
  if (!status) status = carreau_set_real(session, "hphymax", 2 * hmax);
  if (status) return fprintf(stderr, "%s\n", carreau_last_error(session)), 1;
  struct field round = {1}, long_and_thin = {4};
  char path[2][400];
  for (int i = 0; i < 2; ++i) snprintf(path[i], sizeof path[i], "%s/lissajous_%d.mesh", argc > 1 ? argv[1] : ".", i);
  const int64_t isotropic = mesh(session, &round, argc > 1 ? path[0] : NULL);
  const int64_t anisotropic = mesh(session, &long_and_thin, argc > 1 ? path[1] : NULL);
  printf("anisotropic / isotropic: %.3f (HDR: 17060 / 38524 = 0.443)\n", (double)anisotropic / (double)isotropic);
  claim(fabs((double)isotropic / 38524 - 1) <= 0.15, "as many triangles as fig. 1.9, within 15 %");
  claim(fabs((double)anisotropic / 17060 - 1) <= 0.15, "as many triangles as fig. 1.10, within 15 %");
  carreau_session_free(session);
  return wrong;
}
