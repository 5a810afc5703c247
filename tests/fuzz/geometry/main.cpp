// SPDX-License-Identifier: BSD-3-Clause
#include "geometry_fuzz.h"

int main(int argc, char** argv) {
  using namespace geometry_fuzz;
  return main_of({{"triangles", run_triangles},
                  {"bezier", run_bezier},
                  {"plane", run_plane},
                  {"molecule", run_molecule},
                  {"grid", run_grid}},
                 argc, argv);
}
