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
