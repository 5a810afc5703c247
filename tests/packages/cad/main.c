/* A customer of libcarreau_cad: a BREP file that it writes itself, the plane face of a triangle. */
#include <carreau_cad.h>
#include <math.h>
#include <stdio.h>

/* A square of side 2 in the plane z = 0. */
static const char* const square =
    "DBRep_DrawableShape\n\nCASCADE Topology V1, (c) Matra-Datavision\nLocations 0\nCurve2ds 0\nCurves 0\nPolygon3D 0\n"
    "PolygonOnTriangulations 0\nSurfaces 1\n1 0 0 0 0 0 1 1 0 0 0 1 0 \nTriangulations 0\n\nTShapes 0\n\n";

int main(void) {
  carreau_session* session = NULL;
  FILE* file = fopen("none.brep", "w");
  int32_t status;
  if (file == NULL || fputs(square, file) < 0 || fclose(file) != 0) return 1;
  if (carreau_session_create(&session) != CARREAU_OK) return 2;
  status = carreau_cad_open(session, "none.brep", NULL, NULL);
  puts(carreau_last_error(session));
  if (status != CARREAU_ERR_FILE || carreau_last_error(session)[0] == 0) return 3;
  carreau_session_free(session);
  return 0;
}
