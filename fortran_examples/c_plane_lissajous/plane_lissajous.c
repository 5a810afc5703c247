/* SPDX-License-Identifier: BSD-3-Clause */
/* A loop by sizes at vertices (HDR sec. 1.2, fig. 1.11), without callbacks. The square of fig. 1.9 comes from arrays.
 * Each mesh after the first follows the sizes of that figure at the vertices of the previous mesh. A second loop does
 * this with the metrics of fig. 1.10. The third mesh confirms the second one. */
#include <carreau_geometry.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "../c_lissajous/lissajous_field.h"

enum { steps = 3 };

static int wrong = 0;
static void claim(int holds, const char* sentence) {
  if (!holds) wrong = 1, fprintf(stderr, "this does not hold: %s\n", sentence);
}

static carreau_status give_square(carreau_session* session) {
  const double far = side_length / 2, points[8] = {-far, -far, far, -far, far, far, -far, far};
  const int64_t starts[2] = {0, 5};
  const int32_t passed[5] = {0, 1, 2, 3, 0};
  const carreau_plane_domain square = {.struct_size = sizeof square,
                                       .point_count = 4,
                                       .curve_count = 1,
                                       .points = points,
                                       .curve_starts = starts,
                                       .curve_points = passed};
  return carreau_add_plane_domain(session, &square);
}

/* Prescribes the metrics of the field at the vertices of the session's mesh. */
static carreau_status prescribe(carreau_session* session, carreau_mesh* mesh, const struct field* field) {
  int64_t n = 0;
  carreau_status status = carreau_mesh_count(mesh, &n, NULL, NULL, NULL);
  double *xyz = malloc((size_t)n * 3 * sizeof *xyz), *metrics = malloc((size_t)n * 6 * sizeof *metrics);
  if (!xyz || !metrics) status = CARREAU_ERR_MEMORY;
  if (status == CARREAU_OK) status = carreau_mesh_vertices(mesh, n, xyz);
  for (int64_t i = 0; i < n && status == CARREAU_OK; ++i) {
    double along, across, w[2];
    sizes(field, xyz[3 * i], xyz[3 * i + 1], &along, &across, w);
    const double p = 1 / (along * along), q = 1 / (across * across);
    double* m = metrics + 6 * i;
    m[0] = p * w[0] * w[0] + q * w[1] * w[1], m[1] = (p - q) * w[0] * w[1];
    m[3] = p * w[1] * w[1] + q * w[0] * w[0];
    m[2] = m[4] = 0, m[5] = q; /* across the plane nothing is asked */
  }
  if (status == CARREAU_OK) status = carreau_set_vertex_metrics(session, n, metrics);
  free(xyz), free(metrics);
  return status;
}

/* Number of triangles of the last mesh. */
static int64_t loop(const struct field* field, const char* folder, const char* name) {
  carreau_session* session = NULL;
  carreau_mesh* mesh = NULL;
  int64_t triangles[steps + 1] = {0}, defects = 0;
  const char* text = NULL;
  if (carreau_session_create(&session) != CARREAU_OK) return claim(0, "there is a session"), 0;
  carreau_status status = give_square(session);
  if (!status) status = carreau_set_real(session, "hphydef", hmax);
  if (!status) status = carreau_set_real(session, "hphymin", hmin / 2);
  if (!status) status = carreau_set_real(session, "hphymax", 2 * hmax);
  for (int i = 0; i <= steps && !status; ++i) {
    if (i > 0) status = prescribe(session, mesh, field);
    if (!status) status = carreau_mesh_generate(session);
    if (!status) status = carreau_session_mesh(session, &mesh);
    if (!status) status = carreau_mesh_count(mesh, NULL, &triangles[i], NULL, NULL);
    if (!status) status = carreau_mesh_defects(mesh, 0, 10, &defects, &text);
    claim(defects == 0, "the mesh is sound");
    char path[400];
    snprintf(path, sizeof path, "%s/%s_%d.mesh", folder ? folder : ".", name, i);
    if (!status && folder) status = carreau_mesh_write(mesh, path);
  }
  if (status) claim(0, carreau_last_error(session));
  printf("%s: ", name);
  for (int i = 0; i <= steps; ++i) printf("M%d %" PRId64 "%s", i, triangles[i], i < steps ? ", " : " triangles\n");
  claim(llabs(triangles[3] - triangles[2]) <= 0.03 * (double)triangles[2], "M3 has as many triangles as M2 within 3 %");
  carreau_session_free(session);
  return triangles[steps];
}

/* Without arguments, checks only; otherwise the meshes are written to the folder that is named. */
int main(int argc, char** argv) {
  find_places();
  const struct field round = {1}, long_and_thin = {4};
  const char* folder = argc > 1 ? argv[1] : NULL;
  const double isotropic = (double)loop(&round, folder, "isotropic"),
               anisotropic = (double)loop(&long_and_thin, folder, "anisotropic");
  claim(fabs(isotropic / 38524 - 1) <= 0.15, "as many triangles as fig. 1.9, within 15 %");
  claim(fabs(anisotropic / 17060 - 1) <= 0.15, "as many triangles as fig. 1.10, within 15 %");
  return wrong;
}
