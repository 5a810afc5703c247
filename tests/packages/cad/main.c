/* SPDX-License-Identifier: BSD-3-Clause */
/* A customer of libcarreau_cad: meshes a sphere of radius 1 (sphere.brep beside the program, or a path), and gets an error for
 * a file of another kind. */
#include <carreau_cad.h>
#include <math.h>
#include <stdio.h>

int main(int argc, char** argv) {
  const double area = 4 * 3.14159265358979323846;
  carreau_session* session = NULL;
  carreau_mesh* mesh = NULL;
  carreau_quality quality = {0};
  quality.struct_size = sizeof quality;
  if (argc != 2 || carreau_session_create(&session) != CARREAU_OK) return 1;
  if (carreau_cad_open(session, "none.step", NULL, NULL) != CARREAU_ERR_FILE) return 2;
  puts(carreau_last_error(session));
  if (carreau_cad_open(session, argv[1], NULL, NULL) != CARREAU_OK) return puts(carreau_last_error(session)), 3;
  carreau_set_real(session, "hphydef", 0.1);
  if (carreau_mesh_generate(session) != CARREAU_OK) return puts(carreau_last_error(session)), 4;
  if (carreau_session_mesh(session, &mesh) != CARREAU_OK || carreau_mesh_quality(mesh, &quality) != CARREAU_OK) return 5;
  printf("%ld triangles, area %.6f\n", (long)quality.triangles, quality.area);
  if (quality.open_edges != 0 || fabs(quality.area - area) > 0.01 * area) return 6;
  carreau_session_free(session);
  return 0;
}
