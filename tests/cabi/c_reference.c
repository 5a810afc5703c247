/* SPDX-License-Identifier: BSD-3-Clause */
/* The paraboloid meshed in C, for the Fortran test to compare with. */
#include "hosts.h"

int64_t c_paraboloid(double hphydef, int64_t capacity, double* xyz, int32_t* triangles, int64_t* out_triangles) {
  carreau_session* session = NULL;
  carreau_mesh* mesh = NULL;
  int64_t n = -1;
  if (mesh_paraboloid(hphydef, &session) == CARREAU_OK && carreau_session_mesh(session, &mesh) == CARREAU_OK &&
      carreau_mesh_count(mesh, &n, out_triangles, NULL, NULL) == CARREAU_OK &&
      (carreau_mesh_vertices(mesh, capacity, xyz) != CARREAU_OK ||
       carreau_mesh_triangles(mesh, capacity, triangles) != CARREAU_OK))
    n = -1;
  carreau_session_free(session);
  return n;
}

/* The same with sizes at the corners of one tetrahedron around it. */
int64_t c_paraboloid_in_tetrahedron(const double* corners, const double* sizes, int64_t capacity, double* xyz) {
  const int32_t tetrahedron[4] = {0, 1, 2, 3};
  const carreau_background background = {.struct_size = sizeof background,
                                         .dimension = 3,
                                         .vertex_count = 4,
                                         .vertices = corners,
                                         .sizes = sizes,
                                         .tetrahedron_count = 1,
                                         .tetrahedra = tetrahedron};
  carreau_session* session = NULL;
  carreau_mesh* mesh = NULL;
  int64_t n = -1;
  if (mesh_paraboloid(0.5, &session) == CARREAU_OK && carreau_set_background(session, &background) == CARREAU_OK &&
      carreau_mesh_generate(session) == CARREAU_OK && carreau_session_mesh(session, &mesh) == CARREAU_OK &&
      carreau_mesh_count(mesh, &n, NULL, NULL, NULL) == CARREAU_OK &&
      carreau_mesh_vertices(mesh, capacity, xyz) != CARREAU_OK)
    n = -1;
  carreau_session_free(session);
  return n;
}

/* Its sizes apart as an image, without a mesh. */
int32_t c_paraboloid_image(const char* path) {
  const carreau_exr_options options = {.struct_size = sizeof options,
                                       .longest = 16,
                                       .channels = CARREAU_EXR_GOVERNS | CARREAU_EXR_MASK | CARREAU_EXR_POSITION,
                                       .multi_part = 1,
                                       .raw = 1};
  carreau_session* session = NULL;
  carreau_status status = mesh_paraboloid(0.5, &session);
  if (status == CARREAU_OK) status = carreau_write_exr(session, path, &options);
  carreau_session_free(session);
  return status;
}
