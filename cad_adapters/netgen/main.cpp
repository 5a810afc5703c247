// SPDX-License-Identifier: BSD-3-Clause
// carreau_netgen SURFACE.vol FILLED.vol LARGEST_SIZE [GROWTH SIZES]: fills the domains of a surface by Netgen's library (nglib, LGPL). SIZES has
// lines "x y z size". `carreau volume --engine netgen` runs it.
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>

namespace nglib {
#include <nglib.h>
}

int main(int argc, char** argv) {
  if (argc != 4 && argc != 6) return std::fputs("usage: carreau_netgen SURFACE.vol FILLED.vol LARGEST_SIZE [GROWTH SIZES]\n", stderr), 2;
  try {
    nglib::Ng_Init();
    nglib::Ng_Mesh* const mesh = nglib::Ng_LoadMesh(argv[1]);
    if (mesh == nullptr) return std::fprintf(stderr, "%s cannot be read\n", argv[1]), 1;
    nglib::Ng_Meshing_Parameters parameters;
    parameters.maxh = std::strtod(argv[3], nullptr);
    nglib::Ng_RestrictMeshSizeGlobal(mesh, parameters.maxh);
    if (argc == 6) {
      parameters.grading = std::strtod(argv[4], nullptr);
      std::ifstream sizes(argv[5]);
      if (!sizes) return std::fprintf(stderr, "%s cannot be read\n", argv[5]), 1;
      double place[3], size = 0;
      while (sizes >> place[0] >> place[1] >> place[2] >> size) nglib::Ng_RestrictMeshSizePoint(mesh, place, size);
    }
    const nglib::Ng_Result result = nglib::Ng_GenerateVolumeMesh(mesh, &parameters);
    if (result != nglib::NG_OK) return std::fprintf(stderr, "Netgen reports error %d\n", static_cast<int>(result)), 1;
    nglib::Ng_SaveMesh(mesh, argv[2]);
    std::fflush(nullptr);
    std::_Exit(0);  // destructors of Debian's nglib 6.2.1905 free an invalid pointer
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 1;
  }
  return 0;
}
